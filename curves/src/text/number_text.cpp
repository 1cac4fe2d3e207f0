#include <tweenfall/curves/number_text.h>

#include <array>
#include <charconv>
#include <cmath>

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

std::string brief_text(double number) {
  if (std::isinf(number)) return number > 0 ? "endless" : "-endless";
  if (std::abs(number) < 1e-12) return "0";
  std::array<char, 32> digits;
  const auto result =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 5);
  return {digits.data(), result.ptr};
}

std::string brief_text(const Vec3& vector) {
  return brief_text(vector.x()) + " " + brief_text(vector.y()) + " " + brief_text(vector.z());
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

std::optional<double> parse_number(std::string_view text) noexcept {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace tweenfall
