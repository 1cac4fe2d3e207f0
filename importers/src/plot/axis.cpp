#include "plot/axis.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::plotting {

namespace {

/// The power of ten at or below `size`, found by multiplication, so that every machine finds the same one.
double power_of_ten_below(double size) {
  double power = 1;
  while (power > size) power /= 10;
  while (power * 10 <= size) power *= 10;
  return power;
}

/// With at most `digits` digits after the first, without trailing zeros: "-1.25e300", "2.5".
std::string exponent_text(double number, int digits) {
  double power = 1;
  int exponent = 0;
  for (; power > std::abs(number) && number != 0; --exponent) power /= 10;
  for (; power * 10 <= std::abs(number); ++exponent) power *= 10;
  std::string mantissa = short_text(number / power, digits);
  // A mantissa rounded up to ten has one more digit.
  if (mantissa == "10" || mantissa == "-10") {
    mantissa.pop_back();
    ++exponent;
  }
  if (number == 0) return "0";
  return exponent == 0 ? mantissa : mantissa + "e" + std::to_string(exponent);
}

}  // namespace

std::vector<double> ticks(const Axis& axis, int count) {
  const double rough = (axis.high - axis.low) / std::max(1, count);
  // Below this the powers of ten are not exact enough, or zero.
  if (!(rough > 1e-290) || !std::isfinite(rough)) return {};
  const double power = power_of_ten_below(rough);
  constexpr double factors[] = {0.5, 1, 2, 5, 10};
  std::size_t number = 1;
  while (number + 1 < std::size(factors) && factors[number] * power < rough) ++number;
  std::vector<double> values;
  // One level alone does not tell how much anything is.
  for (;; --number) {
    const double step = factors[number] * power, first = std::ceil(axis.low / step - 1e-9);
    // Ticks that cannot be distinguished are useless.
    if (!(std::abs(first) < 1e15)) return {};
    values.clear();
    for (double k = first; k * step <= axis.high + 1e-9 * step && values.size() < 100; ++k) values.push_back(k * step);
    if (values.size() > 1 || number == 0) return values;
  }
}

std::vector<std::string> tick_texts(const std::vector<double>& ticks) {
  constexpr double longest = 1e6;
  constexpr int most_decimals = 5;
  double largest = 0;
  for (const double tick : ticks) largest = std::max(largest, std::abs(tick));
  const double step = ticks.size() < 2 ? largest : ticks[1] - ticks[0];
  int decimals = ticks.size() < 2 ? 3 : 0;
  for (double rest = step; rest > 0 && rest < 1 - 1e-9 && decimals <= most_decimals && ticks.size() > 1; rest *= 10)
    ++decimals;
  int digits = 0;
  if (step > 0 && largest > 0)
    for (double size = power_of_ten_below(largest * (1 + 1e-9)); size > step * (1 + 1e-9) && digits < 16; size /= 10)
      ++digits;
  std::vector<std::string> texts;
  texts.reserve(ticks.size());
  for (const double tick : ticks)
    texts.push_back(largest < longest && decimals <= most_decimals ? short_text(tick, decimals)
                                                                   : exponent_text(tick, std::max(digits, 1)));
  return texts;
}

void add_room(double& low, double& high) {
  const double size = std::max({1.0, std::abs(low), std::abs(high)});
  const double room = high - low > 1e-9 * size ? 0.06 * (high - low) : 0.5 * size;
  low -= room;
  high += room;
}

}  // namespace tweenfall::plotting
