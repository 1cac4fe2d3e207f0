#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/functions.h>

#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::formulas {
namespace {

void check_duration(double duration, const char* what) {
  if (!(duration > 0) || !std::isfinite(duration))
    throw std::invalid_argument(std::string(what) + " needs a finite duration > 0 s; it is " +
                                spans::text_of(duration));
}

}  // namespace
}  // namespace tweenfall::formulas

namespace tweenfall {

Curve<Vec3> line(const Line& l) {
  formulas::check_duration(l.duration, "a line");
  if (!spans::all_finite(l.from) || !spans::all_finite(l.to))
    throw std::invalid_argument("a line needs finite ends; it leads from " + spans::text_of(l.from) + " to " +
                                spans::text_of(l.to));
  Span<Vec3> span{};
  span.duration = l.duration;
  span.degree = 1;
  span.coefficients[0] = l.from;
  span.coefficients[1] = l.to - l.from;
  span.end = l.to;
  return Curve<Vec3>(std::span<const Span<Vec3>>(&span, 1));
}

Curve<Vec3> arc(const Arc& a) {
  formulas::check_duration(a.duration, "an arc");
  if (!spans::all_finite(a.center) || !spans::all_finite(a.from) || !std::isfinite(a.angle))
    throw std::invalid_argument("an arc needs finite numbers; it has center " + spans::text_of(a.center) + ", from " +
                                spans::text_of(a.from) + ", angle " + spans::text_of(a.angle));
  const double size = a.axis.norm();
  if (!(size > 0) || !std::isfinite(size))
    throw std::invalid_argument("an arc's axis must be finite and not zero; it is " + spans::text_of(a.axis));
  const Vec3 axis = a.axis / size, arm = a.from - a.center;
  const Vec3 middle = a.center + arm.dot(axis) * axis;
  const Vec3 x = a.from - middle, y = axis.cross(x);
  const double rate = a.angle / a.duration;
  return Curve<Vec3>(
      [middle, x, y, rate](double t, Side) {
        const elementary::SinCos wave = elementary::sin_cos(rate * t);
        const Vec3 out = wave.cos * x + wave.sin * y;
        return Sample<Vec3>{middle + out, rate * (wave.cos * y - wave.sin * x), -(rate * rate) * out};
      },
      0, a.duration);
}

}  // namespace tweenfall
