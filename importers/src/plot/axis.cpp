#include "plot/axis.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

std::vector<double> ticks(const Axis& axis, int count) {
  const double rough = (axis.high - axis.low) / std::max(1, count);
  // Powers of ten by multiplication, so that every machine finds the same ones.
  double power = 1;
  while (power > rough) power /= 10;
  while (power * 10 <= rough) power *= 10;
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  std::vector<double> values;
  const double first = std::ceil(axis.low / step - 1e-9);
  for (double k = first; k * step <= axis.high + 1e-9 * step && values.size() < 100; ++k) values.push_back(k * step);
  return values;
}

int tick_decimals(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return 3;
  int decimals = 0;
  for (double step = ticks[1] - ticks[0]; step < 1 - 1e-9 && decimals < 9; step *= 10) ++decimals;
  return decimals;
}

void add_room(double& low, double& high) {
  const double size = std::max({1.0, std::abs(low), std::abs(high)});
  const double room = high - low > 1e-9 * size ? 0.06 * (high - low) : 0.5 * size;
  low -= room;
  high += room;
}

}  // namespace tweenfall
