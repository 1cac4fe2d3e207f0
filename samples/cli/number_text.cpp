#include "number_text.h"

#include <charconv>
#include <cmath>

namespace tweenfall::cli {

std::string exact(double number) {
  if (!std::isfinite(number)) return "null";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

std::string brief(double number) {
  if (std::isinf(number)) return number > 0 ? "endless" : "-endless";
  if (std::abs(number) < 1e-12) return "0";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::general, 5).ptr;
  return {text, end};
}

std::string brief(const Vec3& vector) {
  return brief(vector.x()) + " " + brief(vector.y()) + " " + brief(vector.z());
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  std::string text = std::to_string(count) + " ";
  if (count == 1) return text.append(one);
  return many.empty() ? text.append(one) + "s" : text.append(many);
}

std::optional<double> parse_number(std::string_view text) noexcept {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace tweenfall::cli
