#include "recording/number_text.h"

#include <array>
#include <charconv>

namespace tweenfall {

std::string number_text(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

std::string short_text(double number, int decimals) {
  // The largest double has 309 digits before the point.
  std::array<char, 360> digits;
  const auto result =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, decimals);
  std::string text(digits.data(), result.ptr);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

void append_number(std::string& out, double number) {
  std::array<char, 32> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  out.append(digits.data(), result.ptr);
  // Many readers take "-0" for a whole number, which has no sign.
  if (number == 0 && digits[0] == '-') out += ".0";
}

void append_vector(std::string& out, const Vec3& vector) {
  for (int i = 0; i < 3; ++i) {
    out += i == 0 ? '[' : ',';
    append_number(out, vector[i]);
  }
  out += ']';
}

void append_rotation(std::string& out, const Quat& rotation) {
  for (int i = 0; i < 4; ++i) {
    out += i == 0 ? '[' : ',';
    append_number(out, rotation.coeffs()[i]);
  }
  out += ']';
}

void append_json_string(std::string& out, const std::string& text) {
  static constexpr char hex[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (code < 0x20 || c == '<' || code == 0x7f) {
      out += "\\u00";
      out += hex[code >> 4];
      out += hex[code & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace tweenfall
