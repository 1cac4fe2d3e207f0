#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/settle.h>

#include <algorithm>
#include <cmath>

namespace tweenfall {

QuinticDecay::QuinticDecay(double offset, double rate, double blend_time, double floor, double acceleration) {
  if (offset == 0 && rate == 0) return;
  // The rule is stated for a positive offset; the other sign is its mirror image.
  const double sign = offset < 0 || (offset == 0 && rate < 0) ? -1 : 1;
  const double x = sign * offset, v = sign * rate;
  double t = blend_time;
  const double least = std::min(std::max(floor, -8 * v / acceleration), blend_time);
  if (v < 0) t = std::max(std::min(t, -5 * x / v), least);
  const double a = std::max(0.0, (-8 * v * t - 20 * x) / (t * t));
  duration = t;
  // Value, rate and acceleration are given at 0 and vanish at t.
  const double t2 = t * t, t3 = t2 * t;
  coefficients[0] = offset;
  coefficients[1] = rate;
  coefficients[2] = sign * a / 2;
  coefficients[3] = sign * -(3 * a * t2 + 12 * v * t + 20 * x) / (2 * t3);
  coefficients[4] = sign * (3 * a * t2 + 16 * v * t + 30 * x) / (2 * t3 * t);
  coefficients[5] = sign * -(a * t2 + 6 * v * t + 12 * x) / (2 * t3 * t2);
}

Sample<double> QuinticDecay::sample(double seconds) const noexcept {
  if (seconds >= duration) return {0, 0, 0};
  double value = coefficients[5], rate = 0, half_acceleration = 0;
  for (int i = 4; i >= 0; --i) {
    half_acceleration = half_acceleration * seconds + rate;
    rate = rate * seconds + value;
    value = value * seconds + coefficients[i];
  }
  return {value, rate, 2 * half_acceleration};
}

Sample<double> SpringDecay::sample(double seconds) const noexcept {
  constexpr double two_ln2 = 0x1.62e42fefa39efp+0;
  const double y = two_ln2 / half_life;
  const double slope = rate + y * offset;
  const double decay = elementary::exp(-y * seconds);
  const double line = offset + slope * seconds;
  return {line * decay, (slope - y * line) * decay, y * (y * line - 2 * slope) * decay};
}

}  // namespace tweenfall
