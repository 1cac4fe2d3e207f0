#include "document/report/color_words.h"

#include <tweenfall/curves/color.h>

#include "document/report/foreign_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

// Source: CSS Color Module Level 4, 6.1; the best known ones.
constexpr std::array<std::pair<std::string_view, unsigned>, 27> named_colors = {{
    {"black", 0x000000},   {"silver", 0xc0c0c0}, {"gray", 0x808080},   {"grey", 0x808080},    {"white", 0xffffff},
    {"maroon", 0x800000},  {"red", 0xff0000},    {"purple", 0x800080}, {"fuchsia", 0xff00ff}, {"green", 0x008000},
    {"lime", 0x00ff00},    {"olive", 0x808000},  {"yellow", 0xffff00}, {"navy", 0x000080},    {"blue", 0x0000ff},
    {"teal", 0x008080},    {"aqua", 0x00ffff},   {"cyan", 0x00ffff},   {"magenta", 0xff00ff}, {"orange", 0xffa500},
    {"pink", 0xffc0cb},    {"brown", 0xa52a2a},  {"gold", 0xffd700},   {"violet", 0xee82ee},  {"indigo", 0x4b0082},
    {"crimson", 0xdc143c}, {"tomato", 0xff6347},
}};

std::string say_hex(const std::string& hex) {
  return "; say \"#" + hex + "\"";
}

std::string two_digits(double part) {
  constexpr std::string_view digits = "0123456789abcdef";
  const auto whole = static_cast<unsigned>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
  return {digits[whole / 16], digits[whole % 16]};
}

// From three or four parts from 0 to 1, or to 255 if there are larger ones; the fourth, the opacity, is from 0 to 1
// whenever possible. Empty for others.
std::string hex_of(std::vector<double> parts) {
  if (parts.size() != 3 && parts.size() != 4) return {};
  const double most = *std::max_element(parts.begin(), parts.begin() + 3);
  for (const double part : parts)
    if (!(part >= 0 && part <= 255)) return {};
  if (most > 1)
    for (std::size_t i = 0; i < 3; ++i) parts[i] /= 255;
  if (parts.size() == 4 && parts[3] > 1) parts[3] /= 255;
  std::string hex;
  for (const double part : parts) hex += two_digits(part);
  return say_hex(hex);
}

std::string hex_of(unsigned number) {
  return hex_of({(number >> 16 & 255) / 255.0, (number >> 8 & 255) / 255.0, (number & 255) / 255.0});
}

bool is_hex(std::string_view digits) {
  return (digits.size() == 3 || digits.size() == 6 || digits.size() == 8) &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

struct Numeral {
  double number;
  bool percent;
};

// The numbers of "rgb(255, 0, 0)", "hsl(120deg 100% 50% / 50%)"
std::vector<Numeral> numbers_in(std::string_view text) {
  std::vector<Numeral> numbers;
  for (std::size_t at = 0; at < text.size();) {
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (fault != std::errc()) {
      ++at;
      continue;
    }
    at = static_cast<std::size_t>(end - text.data());
    numbers.push_back({number, at < text.size() && text[at] == '%'});
  }
  return numbers;
}

// Red, green and blue to 255, how opaque to 1.
std::vector<double> parts_of_rgb(const std::vector<Numeral>& numbers) {
  std::vector<double> parts;
  parts.reserve(numbers.size());
  for (const auto& [number, percent] : numbers)
    parts.push_back(percent ? number * (parts.size() < 3 ? 2.55 : 0.01) : number);
  // What is 1 there is a 255th.
  if (parts.size() >= 3 && std::all_of(parts.begin(), parts.begin() + 3, [](double part) { return part <= 1; }))
    for (std::size_t i = 0; i < 3; ++i) parts[i] /= 255;
  return parts;
}

// All parts to 1, of an angle in degrees and two shares in hundredths.
std::vector<double> parts_of_hue(const std::vector<Numeral>& numbers, ColorSpace space) {
  if (numbers.size() != 3 && numbers.size() != 4) return {};
  constexpr double degree = 0.017453292519943295;
  const double opaque = numbers.size() < 4 ? 1 : numbers[3].number * (numbers[3].percent ? 0.01 : 1);
  const Vec4 hue(numbers[0].number * degree, numbers[1].number / 100, numbers[2].number / 100, opaque);
  const Vec4 rgb = to_space(from_space({hue, Vec4::Zero(), Vec4::Zero()}, space).value, ColorSpace::srgb);
  return {rgb.data(), rgb.data() + numbers.size()};
}

}  // namespace

std::string color_meant(std::string_view text) {
  constexpr std::size_t longest = 64;
  if (text.size() > longest) return {};
  const std::string small = small_letters(text);
  for (const auto& [name, number] : named_colors)
    if (small == name) return hex_of(number);
  const std::string_view digits = std::string_view(small).substr(small.rfind("0x", 0) == 0 ? 2 : 0);
  if (is_hex(digits)) return say_hex(std::string(digits));
  if (small.rfind("rgb", 0) == 0) return hex_of(parts_of_rgb(numbers_in(small)));
  if (small.rfind("hsl", 0) == 0) return hex_of(parts_of_hue(numbers_in(small), ColorSpace::hsl));
  if (small.rfind("hwb", 0) == 0) return hex_of(parts_of_hue(numbers_in(small), ColorSpace::hwb));
  for (const std::string_view space : {"oklab", "oklch", "lab", "lch", "hsv"})
    if (small.starts_with(std::string(space) + "("))
      return "; a color is written in sRGB, and \"" + std::string(space) +
             "\" is a \"space\" of a track, in which its colors are mixed";
  return {};
}

std::string color_meant(const json::Value& value) {
  if (value.is(Kind::number)) {
    const double number = value.number();
    return number >= 0 && number <= 0xffffff && number == std::floor(number) ? hex_of(static_cast<unsigned>(number))
                                                                             : std::string();
  }
  std::vector<double> parts;
  if (value.is(Kind::list)) {
    if (value.items().size() > 4) return {};
    for (const json::Value& part : value.items()) {
      if (!part.is(Kind::number)) return {};
      parts.push_back(part.number());
    }
  } else if (value.is(Kind::object)) {
    for (const std::string_view name : {"r", "g", "b", "a"}) {
      const json::Value part = value.find(name);
      if (part && part.is(Kind::number)) parts.push_back(part.number());
    }
  }
  return hex_of(std::move(parts));
}

}  // namespace tweenfall::document
