#include "json/json_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace tweenfall {

namespace {

using Kind = JsonValue::Kind;

struct Stop {};  // thrown at a syntax error, after it was noted

// The members of one object by name. Most objects are so small that looking through them is fastest.
class MemberNames {
 public:
  explicit MemberNames(std::vector<JsonMember>& members) : members_(members) {}

  // The member of this name that is there already; null when none is.
  JsonMember* find(const std::string& name) {
    constexpr std::size_t most_looked_through = 16;
    if (members_.size() <= most_looked_through) {
      for (JsonMember& member : members_)
        if (member.name == name) return &member;
      return nullptr;
    }
    for (; indexed_ < members_.size(); ++indexed_) index_.emplace(members_[indexed_].name, indexed_);
    const auto found = index_.find(name);
    return found == index_.end() ? nullptr : &members_[found->second];
  }

 private:
  std::vector<JsonMember>& members_;
  std::unordered_map<std::string, std::size_t> index_;
  std::size_t indexed_ = 0;
};

class Parser {
 public:
  Parser(std::string_view text, std::vector<JsonFault>& faults, const JsonRules& rules)
      : text_(text), faults_(faults), rules_(rules) {}

  JsonValue whole() {
    if (text_.substr(0, 3) == "\xef\xbb\xbf") at_ = 3;
    skip_space();
    if (at_ == text_.size()) stop("the text is empty; a document is an object, starting with '{'");
    JsonValue value = read_value(0);
    skip_space();
    if (at_ < text_.size()) stop("expected the end of the text after the document, found " + here());
    return value;
  }

 private:
  [[noreturn]] void stop(std::string message) {
    note(at_, 1, std::move(message));
    throw Stop{};
  }

  void note(std::size_t offset, std::size_t length, std::string message) {
    faults_.push_back({offset, std::max<std::size_t>(length, 1), std::move(message)});
  }

  [[nodiscard]] bool done() const { return at_ >= text_.size(); }
  [[nodiscard]] char next() const { return done() ? '\0' : text_[at_]; }

  [[nodiscard]] std::string here() const {
    if (done()) return "the end of the text";
    const unsigned char c = static_cast<unsigned char>(text_[at_]);
    if (c < 0x20 || c == 0x7f || c >= 0x80) {
      static constexpr char digits[] = "0123456789abcdef";
      return std::string("the byte 0x") + digits[c >> 4] + digits[c & 15];
    }
    return std::string("'") + static_cast<char>(c) + "'";
  }

  void skip_space() {
    while (!done()) {
      const char c = text_[at_];
      const std::string_view mark = rules_.comments ? text_.substr(at_, 2) : std::string_view();
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        ++at_;
      } else if (mark == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (mark == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) stop("this comment has no end; expected \"*/\"");
        at_ = end + 2;
      } else {
        break;
      }
    }
  }

  JsonValue read_value(std::size_t depth) {
    JsonValue value;
    value.offset = at_;
    const char c = next();
    if (c == '{' || c == '[') {
      if (depth >= deepest_nesting)
        stop("nested more than " + std::to_string(deepest_nesting) + " deep; no document needs that");
      if (c == '{')
        read_object(value, depth);
      else
        read_list(value, depth);
    } else if (c == '"') {
      value.kind = Kind::text;
      value.text = read_text();
    } else if ((c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.') {
      read_number(value);
    } else if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) {
      read_word(value);
    } else {
      stop("expected a value, found " + here());
    }
    value.length = at_ - value.offset;
    return value;
  }

  void read_object(JsonValue& value, std::size_t depth) {
    value.kind = Kind::object;
    MemberNames names(value.members);
    ++at_;
    skip_space();
    if (next() == '}') {
      ++at_;
      return;
    }
    while (true) {
      if (next() != '"') stop("expected a name in quotes" + std::string(done() ? " or '}'" : "") + ", found " + here());
      JsonMember member;
      member.name_offset = at_;
      member.name = read_text();
      member.name_length = at_ - member.name_offset;
      skip_space();
      if (next() != ':') stop("expected ':' after " + in_quotes(member.name) + ", found " + here());
      ++at_;
      skip_space();
      member.value = read_value(depth + 1);
      JsonMember* const first = names.find(member.name);
      if (!first)
        value.members.push_back(std::move(member));
      else if (rules_.names_twice)
        *first = std::move(member);
      else
        note(member.name_offset, member.name_length,
             in_quotes(member.name) + " is given twice in one object; keep one of them");
      skip_space();
      if (next() == '}') break;
      if (next() != ',') stop("expected ',' or '}' after the value, found " + here());
      ++at_;
      skip_space();
      if (next() == '}') stop("expected a name in quotes after ',', found '}'; leave the last ',' out");
    }
    ++at_;
  }

  void read_list(JsonValue& value, std::size_t depth) {
    value.kind = Kind::list;
    ++at_;
    skip_space();
    if (next() == ']') {
      ++at_;
      return;
    }
    while (true) {
      value.items.push_back(read_value(depth + 1));
      skip_space();
      if (next() == ']') break;
      if (next() != ',') stop("expected ',' or ']' after the value, found " + here());
      ++at_;
      skip_space();
      if (next() == ']') stop("expected a value after ',', found ']'; leave the last ',' out");
    }
    ++at_;
  }

  void read_number(JsonValue& value) {
    const std::size_t from = at_;
    const auto digits = [&] {
      const std::size_t first = at_;
      while (next() >= '0' && next() <= '9') ++at_;
      return at_ > first;
    };
    if (next() == '-') ++at_;
    if (text_.substr(at_, 8) == "Infinity" || text_.substr(at_, 3) == "inf") {
      while ((next() | 32) >= 'a' && (next() | 32) <= 'z') ++at_;
      note(from, at_ - from, std::string(text_.substr(from, at_ - from)) + " is not a number; numbers are finite");
      value.kind = Kind::faulty;
      return;
    }
    if (next() == '0') {
      ++at_;
      if (next() >= '0' && next() <= '9') stop("a number does not start with 0 before other digits");
    } else if (!digits()) {
      stop(text_[from] == '+'   ? "a number has no '+' before it"
           : text_[from] == '.' ? "a number needs a digit before '.'"
                                : "expected a digit after '-', found " + here());
    }
    if (next() == '.') {
      ++at_;
      if (!digits()) stop("expected a digit after '.', found " + here());
    }
    if (next() == 'e' || next() == 'E') {
      ++at_;
      if (next() == '+' || next() == '-') ++at_;
      if (!digits()) stop("expected a digit of the exponent, found " + here());
    }
    value.kind = Kind::number;
    const auto result = std::from_chars(text_.data() + from, text_.data() + at_, value.number);
    if (result.ec != std::errc{}) {
      // Too small to tell from 0 is 0; too large has no such reading.
      const std::string written(text_.substr(from, std::min<std::size_t>(at_ - from, 40)));
      if (is_tiny(text_.substr(from, at_ - from))) {
        value.number = text_[from] == '-' ? -0.0 : 0.0;
      } else {
        note(from, at_ - from, written + " is too large for a number; the largest is about 1.8e308");
        value.kind = Kind::faulty;
      }
    }
  }

  // Whether a number out of range is so for being small: its first digit that counts stands far behind the point.
  static bool is_tiny(std::string_view number) {
    if (number.front() == '-') number.remove_prefix(1);
    const std::size_t mark = number.find_first_of("eE");
    const std::string_view digits = number.substr(0, mark);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const std::size_t first = digits.find_first_of("123456789");
    if (first == std::string_view::npos) return true;
    double power = first < point ? static_cast<double>(point - first) : -static_cast<double>(first - point);
    if (mark != std::string_view::npos) {
      std::string_view exponent = number.substr(mark + 1);
      const bool negative = exponent.front() == '-';
      if (exponent.front() == '-' || exponent.front() == '+') exponent.remove_prefix(1);
      double size = 0;
      for (const char c : exponent) size = std::min(size * 10 + (c - '0'), 1e18);
      power += negative ? -size : size;
    }
    return power < 0;
  }

  void read_word(JsonValue& value) {
    const std::size_t from = at_;
    while ((next() | 32) >= 'a' && (next() | 32) <= 'z') ++at_;
    const std::string_view word = text_.substr(from, at_ - from);
    if (word == "true" || word == "false") {
      value.kind = Kind::boolean;
      value.boolean = word == "true";
    } else if (word == "null") {
      value.kind = Kind::null;
    } else if (word == "NaN" || word == "nan" || word == "Infinity" || word == "inf") {
      value.kind = Kind::faulty;
      note(from, at_ - from, std::string(word) + " is not a number; numbers are finite");
    } else {
      at_ = from;
      note(from, word.size(), "expected a value, found " + std::string(word.substr(0, 40)) + "; texts stand in quotes");
      throw Stop{};
    }
  }

  std::uint32_t four_hex_digits() {
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const char c = next();
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0) stop("expected four hexadecimal digits after \\u, found " + here());
      code = code * 16 + static_cast<std::uint32_t>(digit);
    }
    return code;
  }

  static void append_utf8(std::string& out, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xc0 | (code >> 6));
      put(0x80 | (code & 63));
    } else if (code < 0x10000) {
      put(0xe0 | (code >> 12));
      put(0x80 | ((code >> 6) & 63));
      put(0x80 | (code & 63));
    } else {
      put(0xf0 | (code >> 18));
      put(0x80 | ((code >> 12) & 63));
      put(0x80 | ((code >> 6) & 63));
      put(0x80 | (code & 63));
    }
  }

  // One character of more than one byte, checked: no stray, overlong or surrogate sequences get in.
  void read_utf8(std::string& out) {
    const unsigned char lead = static_cast<unsigned char>(text_[at_]);
    const std::size_t size = lead >= 0xc2 && lead < 0xe0   ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
    bool good = size > 0 && at_ + size <= text_.size();
    std::uint32_t code = good ? lead & (0x7fu >> size) : 0;
    for (std::size_t i = 1; good && i < size; ++i) {
      const unsigned char c = static_cast<unsigned char>(text_[at_ + i]);
      good = (c & 0xc0) == 0x80;
      code = (code << 6) | (c & 63u);
    }
    if (size == 3) good = good && code >= 0x800 && (code < 0xd800 || code > 0xdfff);
    if (size == 4) good = good && code >= 0x10000 && code <= 0x10ffff;
    if (!good) stop("this text is not UTF-8: found " + here());
    out.append(text_.substr(at_, size));
    at_ += size;
  }

  void read_escape(std::string& out) {
    ++at_;
    const char c = next();
    static constexpr std::string_view names = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
    if (c == 'u') {
      ++at_;
      std::uint32_t code = four_hex_digits();
      if (code >= 0xdc00 && code <= 0xdfff) stop("the second half of a \\u pair stands alone");
      if (code >= 0xd800 && code <= 0xdbff) {
        if (text_.substr(at_, 2) != "\\u") stop("expected the second half of a \\u pair, found " + here());
        at_ += 2;
        const std::uint32_t low = four_hex_digits();
        if (low < 0xdc00 || low > 0xdfff) stop("expected the second half of a \\u pair");
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
      }
      append_utf8(out, code);
      return;
    }
    const std::size_t which = done() ? std::string_view::npos : names.find(c);
    if (which == std::string_view::npos) stop("no escape of this name; found " + here() + " after '\\'");
    out.push_back(meanings[which]);
    ++at_;
  }

  static bool is_plain(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte < 0x80 && c != '"' && c != '\\';
  }

  std::string read_text() {
    const std::size_t from = at_++;
    std::string out;
    while (true) {
      if (done()) {
        note(from, 1, "this text has no end; expected '\"'");
        throw Stop{};
      }
      const char c = text_[at_];
      if (c == '"') break;
      if (c == '\n') {
        note(from, 1, "this text has no end on its line; expected '\"'");
        throw Stop{};
      }
      if (static_cast<unsigned char>(c) < 0x20) stop("control characters are written with '\\'; found " + here());
      if (c == '\\') {
        read_escape(out);
      } else if (static_cast<unsigned char>(c) >= 0x80) {
        read_utf8(out);
      } else {
        const std::size_t plain = at_;
        while (!done() && is_plain(text_[at_])) ++at_;
        out.append(text_.substr(plain, at_ - plain));
      }
    }
    ++at_;
    return out;
  }

  std::string_view text_;
  std::vector<JsonFault>& faults_;
  const JsonRules& rules_;
  std::size_t at_ = 0;
};

}  // namespace

namespace {

JsonValue faulty() {
  JsonValue value;
  value.kind = Kind::faulty;
  return value;
}

}  // namespace

JsonValue parse_json(std::string_view text, std::vector<JsonFault>& faults, const JsonRules& rules) {
  if (text.size() > rules.largest) {
    faults.push_back({0, 1, "the text is larger than " + std::to_string(rules.largest >> 20) + " MiB"});
    return faulty();
  }
  try {
    return Parser(text, faults, rules).whole();
  } catch (const Stop&) {
    return faulty();
  }
}

TextPlace place_in(std::string_view text, std::size_t offset) {
  const std::size_t mark = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_end = before.rfind('\n');
  const std::size_t line_start = line_end == std::string_view::npos ? std::min(mark, before.size()) : line_end + 1;
  const std::string_view on_line = before.substr(line_start);
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return {1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<std::size_t>(std::count_if(on_line.begin(), on_line.end(), starts_character))};
}

}  // namespace tweenfall
