#include "math/elliptic.h"

#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <numbers>

namespace tweenfall::math {
namespace {

using std::numbers::pi;

}  // namespace
}  // namespace tweenfall::math

namespace tweenfall::math {

Elliptic::Elliptic(double parameter, double complement) noexcept : parameter_(parameter), complement_(complement) {
  steps_[0] = {1, std::sqrt(complement), std::sqrt(parameter)};
  // The next difference is a quarter of the square of this one.
  while (last_ < most_steps && steps_[static_cast<std::size_t>(last_)].c > 1e-9) {
    const Step s = steps_[static_cast<std::size_t>(last_)];
    steps_[static_cast<std::size_t>(++last_)] = {0.5 * (s.a + s.b), std::sqrt(s.a * s.b), 0.5 * (s.a - s.b)};
  }
}

double Elliptic::quarter_period() const noexcept {
  return 0.5 * math::pi / steps_[static_cast<std::size_t>(last_)].a;
}

double Elliptic::amplitude(double u) const noexcept {
  const double half_period = 2 * quarter_period();
  const double halves = std::floor(u / half_period + 0.5);
  double phi = std::ldexp(steps_[static_cast<std::size_t>(last_)].a * (u - halves * half_period), last_);
  for (int n = last_; n > 0; --n) {
    const Step& s = steps_[static_cast<std::size_t>(n)];
    const elementary::SinCos wave = elementary::sin_cos(phi);
    // asin(c sin(phi) / a), which computed directly would lose digits where its argument is close to 1.
    const double across = std::sqrt(s.a * s.a * wave.cos * wave.cos + s.b * s.b * wave.sin * wave.sin);
    phi = 0.5 * (phi + elementary::atan2(s.c * wave.sin, across));
  }
  return phi + halves * math::pi;
}

double Elliptic::argument(double amplitude) const noexcept {
  double phi = amplitude;
  for (int n = 0; n < last_; ++n) {
    const Step& s = steps_[static_cast<std::size_t>(n)];
    const double halves = std::floor(phi / math::pi + 0.5);
    const elementary::SinCos wave = elementary::sin_cos(phi - halves * math::pi);
    phi += elementary::atan2(s.b * wave.sin, s.a * wave.cos) + halves * math::pi;
  }
  return phi / std::ldexp(steps_[static_cast<std::size_t>(last_)].a, last_);
}

double Elliptic::delta(double cosine) const noexcept {
  return std::sqrt(complement_ + parameter_ * cosine * cosine);
}

}  // namespace tweenfall::math
