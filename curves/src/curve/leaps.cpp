#include <tweenfall/curves/leaps.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve/curve_data.h"

namespace tweenfall {

namespace spans {
namespace {

constexpr double no_leap = std::numeric_limits<double>::infinity();

/// Where a formula that leaps in between does so; infinity where it only goes there fast.
double leap_in(const NumberOverTime& formula, double from, double to) {
  const auto before = [&](double place) { return formula(place, Side::in).value; };
  const auto after = [&](double place) { return formula(place, Side::out).value; };
  const double whole = std::abs(before(to) - after(from));
  while (true) {
    const double middle = from + 0.5 * (to - from);
    if (!(middle > from && middle < to)) break;
    const double left = std::abs(before(middle) - after(from));
    const double right = std::abs(before(to) - after(middle));
    const double here = std::abs(after(middle) - before(middle));
    if (here >= std::max({left, right, 0.25 * whole})) return middle;
    (left >= right ? to : from) = middle;
  }
  for (const double place : {from, to})
    if (std::abs(after(place) - before(place)) > 0.25 * whole) return place;
  return std::abs(before(to) - after(from)) > 0.25 * whole ? to : no_leap;
}

}  // namespace
}  // namespace spans

bool leaps(const NumberOverTime& formula, double from, double to) {
  const Sample<double> before = formula(from, Side::out), after = formula(to, Side::in);
  const double change = std::abs(after.value - before.value);
  const double rate = std::max(std::abs(before.rate), std::abs(after.rate));
  const double rounding = 1e-12 * std::max(std::abs(before.value), std::abs(after.value));
  return std::isfinite(change) && std::isfinite(rate) && change > 4 * rate * (to - from) + rounding;
}

double next_leap(const NumberOverTime& formula, double from, double to) {
  constexpr int looks = 8;
  double begin = from;
  for (int i = 1; i <= looks && to > from; ++i) {
    const double end = i < looks ? from + (to - from) * i / looks : to;
    double leap = spans::no_leap;
    // Of several the first: what lies before the one that was found is looked at again.
    for (double last = end; leaps(formula, begin, last);) {
      const double found = spans::leap_in(formula, begin, last);
      if (!(found > from && found <= to && found < leap)) break;
      last = leap = found;
    }
    if (leap <= to) return leap;
    // One that falls on the look itself.
    const double here = formula(end, Side::in).value, there = formula(end, Side::out).value;
    if (here != there && std::isfinite(here) && std::isfinite(there)) return end;
    begin = end;
  }
  return spans::no_leap;
}

template <class T>
std::span<const NumberOverTime> leaping(const Curve<T>& curve) noexcept {
  return CurveAccess::leaping(curve);
}

template <class T>
Curve<T> with_leaping(const Curve<T>& curve, std::span<const NumberOverTime> parts) {
  return CurveAccess::with_leaping(curve, parts);
}

template std::span<const NumberOverTime> leaping<double>(const Curve<double>&) noexcept;
template std::span<const NumberOverTime> leaping<Vec2>(const Curve<Vec2>&) noexcept;
template std::span<const NumberOverTime> leaping<Vec3>(const Curve<Vec3>&) noexcept;
template std::span<const NumberOverTime> leaping<Vec4>(const Curve<Vec4>&) noexcept;
template std::span<const NumberOverTime> leaping<Color>(const Curve<Color>&) noexcept;
template std::span<const NumberOverTime> leaping<Quat>(const Curve<Quat>&) noexcept;
template Curve<double> with_leaping<double>(const Curve<double>&, std::span<const NumberOverTime>);
template Curve<Vec2> with_leaping<Vec2>(const Curve<Vec2>&, std::span<const NumberOverTime>);
template Curve<Vec3> with_leaping<Vec3>(const Curve<Vec3>&, std::span<const NumberOverTime>);
template Curve<Vec4> with_leaping<Vec4>(const Curve<Vec4>&, std::span<const NumberOverTime>);
template Curve<Color> with_leaping<Color>(const Curve<Color>&, std::span<const NumberOverTime>);
template Curve<Quat> with_leaping<Quat>(const Curve<Quat>&, std::span<const NumberOverTime>);

}  // namespace tweenfall
