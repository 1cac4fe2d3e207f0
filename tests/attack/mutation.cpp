#include "attack/mutation.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace tweenfall::attack {

using Json = nlohmann::ordered_json;

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

std::filesystem::path folder_of_process(long process) {
  return std::filesystem::temp_directory_path() / ("tweenfall-attack-" + std::to_string(process));
}

double odd_number(Random& random, bool hostile) {
  static constexpr double odd[] = {0,      -0.0,   1,     -1,         1e-300, 5e-324, 1e-17, 1e-9,  1e-6,
                                   1e-3,   0.5,    2,     3,          90,     180,    360,   720,   1e3,
                                   1e6,    1e9,    1e17,  1e30,       1e150,  1e300,  -1e-9, -0.5,  -90,
                                   -1e6,   -1e300, 1.0e7, 1.0 / 60.0, 1e308,  4096,   65536, 1e5,   2147483648.0,
                                   1.7e38, 3.5e38, 0.1,   1 / 240.0,  1e-4,   -2,     256,   -1e17, 4294967296.0};
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double not_numbers[] = {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
  if (hostile && below(random, 4) == 0) return not_numbers[below(random, std::size(not_numbers))];
  if (below(random, 3) == 0) return random.between(-4, 4);
  return odd[below(random, std::size(odd))];
}

namespace {

constexpr std::string_view of_numbers = "0123456789+-.eE";

/// Replaces a number written as text by another; does nothing if there is none.
void mutate_number(Random& random, std::string& bytes) {
  const std::size_t from = bytes.find_first_of("0123456789", below(random, bytes.size()));
  if (from == std::string::npos) return;
  const std::size_t before = bytes.find_last_not_of(of_numbers, from);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(bytes.find_first_not_of(of_numbers, begin), bytes.size());
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", odd_number(random, true));
  bytes.replace(begin, end - begin, text);
}

/// Replaces a binary number by another.
void mutate_bits(Random& random, std::string& bytes) {
  const double number = odd_number(random, true);
  const std::size_t at = below(random, bytes.size()) & ~std::size_t{3};
  const auto put = [&](auto value) {
    if (at + sizeof value <= bytes.size()) std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  if (below(random, 2))
    put(number);
  else
    put(static_cast<float>(number));
}

bool is_binary(const std::string& bytes) {
  return std::string_view(bytes).substr(0, 4096).find('\0') != std::string_view::npos;
}

}  // namespace

void mutate_bytes(Random& random, std::string& bytes) {
  const std::size_t changes = 1 + below(random, 3);
  for (std::size_t change = 0; change < changes && !bytes.empty(); ++change) {
    if (below(random, 3) == 0) {
      if (is_binary(bytes))
        mutate_bits(random, bytes);
      else
        mutate_number(random, bytes);
      continue;
    }
    if (below(random, 3)) {
      // Most changes keep the form: another digit, or another byte of a number.
      std::size_t digit = bytes.find_first_of("0123456789", below(random, bytes.size()));
      if (digit == std::string::npos) digit = below(random, bytes.size());
      bytes[digit] = static_cast<char>('0' + below(random, 10));
      continue;
    }
    const std::size_t at = below(random, bytes.size());
    const std::size_t length = std::min(1 + below(random, 1u << below(random, 10)), bytes.size() - at);
    switch (below(random, 8)) {
      case 0:
        bytes[at] = static_cast<char>(random.bits());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.insert(below(random, bytes.size()), bytes.substr(at, length));
        break;
      case 5:
        bytes.resize(at);
        break;
      case 6: {
        // A length or an offset of a binary file, or a digit of one that is text.
        static constexpr std::uint32_t odd[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000, 0xffff, 0x3fffffff};
        const std::uint32_t value = odd[below(random, std::size(odd))];
        for (std::size_t byte = 0; byte < 4 && at + byte < bytes.size(); ++byte) {
          bytes[at + byte] = static_cast<char>(value >> (8 * byte));
        }
        break;
      }
      default: {
        static constexpr const char* words[] = {"\"",   "{",           "}",  "[",       "]",  ",",    ":",
                                                "null", "1e999",       "-",  "\\u0000", "//", "\xff", "\xef\xbf\xbe",
                                                "0",    "99999999999", "\n", "\0"};
        bytes.insert(at, words[below(random, std::size(words))]);
      }
    }
  }
}

namespace {

/// All places of a document, starting with the whole.
void gather(Json& value, std::vector<Json*>& places) {
  places.push_back(&value);
  if (value.is_structured()) {
    for (auto& inner : value) gather(inner, places);
  }
}

Json odd_value(Random& random) {
  static const char* words[] = {"",
                                "+0.1",
                                "50%",
                                "12f",
                                "-3f",
                                "1e400%",
                                "free",
                                "keyed",
                                "hold",
                                "auto",
                                "ball",
                                "bezier(0,1e300,1,-1e300)",
                                "spring(0.3s,1e300)",
                                "steps(0)",
                                "repeat",
                                "pingpong",
                                "tcb(1,1,1)",
                                "*",
                                "../x.json",
                                "#12345",
                                "#fff",
                                "a.b.c",
                                "1/0",
                                "1/240",
                                "cubic-in-out",
                                "elastic-out(1,0.001)",
                                "linear(0, 1)",
                                "back-in(-1e300)"};
  switch (below(random, 9)) {
    case 0:
      return nullptr;
    case 1:
      return true;
    case 2:
      return words[below(random, std::size(words))];
    case 3:
      return Json::array();
    case 4:
      return Json::object();
    case 5:
      return Json::array({odd_number(random), odd_number(random), odd_number(random)});
    case 6:
      return static_cast<std::int64_t>(random.bits());
    default:
      return odd_number(random);
  }
}

void rename_a_member(Random& random, Json& object) {
  auto member = object.begin();
  std::advance(member, below(random, object.size()));
  std::string name = member.key();
  Json value = member.value();
  object.erase(member);
  if (name.empty() || below(random, 3) == 0) {
    name += "x";
  } else {
    name[below(random, name.size())] = static_cast<char>('a' + below(random, 26));
  }
  object[name] = std::move(value);
}

}  // namespace

void mutate_structure(Random& random, Json& document) {
  const std::size_t changes = 1 + below(random, 3);
  for (std::size_t change = 0; change < changes; ++change) {
    std::vector<Json*> places;
    gather(document, places);
    Json& place = *places[below(random, places.size())];
    const Json other = *places[below(random, places.size())];
    switch (below(random, 24)) {
      case 0:
        place = odd_value(random);
        break;
      case 1:
        place = other;
        break;
      case 2:
        if (place.is_object() && !place.empty()) rename_a_member(random, place);
        break;
      case 3:
        if (place.is_structured() && !place.empty()) {
          auto gone = place.begin();
          std::advance(gone, below(random, place.size()));
          place.erase(gone);
        }
        break;
      case 4:
        if (place.is_array() && !place.empty()) {
          const Json again = place[below(random, place.size())];
          for (std::size_t times = below(random, 40); times > 0; --times) place.push_back(again);
        }
        break;
      case 5:
        if (place.is_array()) place.push_back(odd_value(random));
        break;
      default:
        // Documents hold mostly numbers, and fail mostly by them.
        for (std::size_t tries = 0; tries < 20; ++tries) {
          Json& number = *places[below(random, places.size())];
          if (!number.is_number()) continue;
          number = below(random, 2) ? Json(odd_number(random)) : Json(number.get<double>() * odd_number(random));
          break;
        }
    }
  }
}

}  // namespace tweenfall::attack
