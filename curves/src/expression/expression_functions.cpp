#include "expression/expression_functions.h"

#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tweenfall::expressions {
namespace {

using std::numbers::pi;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Sign that `a` takes just beside this point, on the side given by `way`.
double tendency(const math::Jet& a, double way) noexcept {
  const double s = a.v != 0 ? a.v : a.d != 0 ? way * a.d : a.dd;
  return s > 0 ? 1 : s < 0 ? -1 : 0;
}

math::Jet negative(const math::Jet& a) noexcept {
  return {-a.v, -a.d, -a.dd};
}

math::Jet quotient(const math::Jet& a, const math::Jet& b) noexcept {
  const double q = a.v / b.v, d = (a.d - q * b.d) / b.v;
  return {q, d, (a.dd - 2 * d * b.d - q * b.dd) / b.v};
}

math::Jet floor_of(const math::Jet& a, double way) noexcept {
  const double f = std::floor(a.v);
  return math::constant(tendency(a - math::constant(f), way) < 0 ? f - 1 : f);
}

math::Jet lesser(const math::Jet& a, const math::Jet& b, double way) noexcept {
  return tendency(b - a, way) < 0 ? b : a;
}
math::Jet greater(const math::Jet& a, const math::Jet& b, double way) noexcept {
  return tendency(b - a, way) > 0 ? b : a;
}
math::Jet clamped(const math::Jet& x, const math::Jet& low, const math::Jet& high, double way) noexcept {
  return lesser(greater(x, low, way), high, way);
}

math::Jet square_root(const math::Jet& a) noexcept {
  if (a.v < 0) return math::constant(none);
  const double root = std::sqrt(a.v);
  if (a.v == 0 && a.d == 0 && a.dd == 0) return {};
  return math::chained(a, root, 0.5 / root, -0.25 / (root * a.v));
}

math::Jet arc_sine(const math::Jet& a) noexcept {
  if (!(std::abs(a.v) <= 1)) return math::constant(none);
  const double first = 1 / std::sqrt((1 - a.v) * (1 + a.v));
  return math::chained(a, elementary::asin(a.v), first, a.v * first * first * first);
}

math::Jet arc_tangent(const math::Jet& a) noexcept {
  const double first = 1 / (1 + a.v * a.v);
  return math::chained(a, elementary::atan(a.v), first, -2 * a.v * first * first);
}

math::Jet angle_of(const math::Jet& y, const math::Jet& x, double way) noexcept {
  // On the cut the side decides: pi where y comes from above, -pi where it comes from below.
  const double angle = y.v == 0 && x.v < 0 ? (tendency(y, way) < 0 ? -pi : pi) : elementary::atan2(y.v, x.v);
  const double square = x.v * x.v + y.v * y.v;
  const double turn = x.v * y.d - y.v * x.d, turning = x.v * y.dd - y.v * x.dd;
  const double growth = 2 * (x.v * x.d + y.v * y.d), rate = turn / square;
  return {angle, rate, (turning - rate * growth) / square};
}

math::Jet exponential(const math::Jet& a) noexcept {
  const double e = elementary::exp(a.v);
  return math::chained(a, e, e, e);
}

math::Jet logarithm(const math::Jet& a) noexcept {
  return math::chained(a, elementary::log(a.v), 1 / a.v, -1 / (a.v * a.v));
}

// x^y for a fixed y. Whole powers of up to 64 are products, so that t^2 is t*t to the last bit.
double power_value(double x, double y) noexcept {
  const bool whole = y == std::floor(y);
  if (whole && std::abs(y) <= 64) {
    double product = 1, square = x;
    for (int n = static_cast<int>(std::abs(y)); n > 0; n /= 2) {
      if (n % 2 == 1) product *= square;
      square *= square;
    }
    return y < 0 ? 1 / product : product;
  }
  if (x >= 0 || x != x) return elementary::pow(x, y);
  if (!whole) return none;
  const double size = elementary::pow(-x, y);
  return std::fmod(y, 2) == 0 ? size : -size;
}

math::Jet raised(const math::Jet& a, const math::Jet& b) noexcept {
  if (b.d == 0 && b.dd == 0) {
    const double n = b.v;
    const double first = n == 0 ? 0 : n * power_value(a.v, n - 1);
    const double second = n == 0 || n == 1 ? 0 : n * (n - 1) * power_value(a.v, n - 2);
    const math::Jet result = math::chained(a, power_value(a.v, n), first, second);
    // A constant base has no rates, not even where the power is steep.
    return a.d == 0 && a.dd == 0 ? math::constant(result.v) : result;
  }
  if (!(a.v > 0)) return {a.v == 0 && b.v > 0 ? 0 : none, none, none};
  math::Jet result = exponential(b * logarithm(a));
  result.v = elementary::pow(a.v, b.v);
  return result;
}

math::Jet smooth_step(const math::Jet& from, const math::Jet& to, const math::Jet& x, double way) noexcept {
  const math::Jet u = clamped(quotient(x - from, to - from), math::constant(0), math::constant(1), way);
  return u * u * (math::constant(3) - 2 * u);
}

using Arguments = const math::Jet*;

constexpr ExpressionFunction functions[] = {
    {"sin", "x", 1, false,
     [](Arguments a, double) noexcept {
       const elementary::SinCos wave = elementary::sin_cos(a[0].v);
       return math::chained(a[0], wave.sin, wave.cos, -wave.sin);
     }},
    {"cos", "x", 1, false,
     [](Arguments a, double) noexcept {
       const elementary::SinCos wave = elementary::sin_cos(a[0].v);
       return math::chained(a[0], wave.cos, -wave.sin, -wave.cos);
     }},
    {"tan", "x", 1, false,
     [](Arguments a, double) noexcept {
       const double t = elementary::tan(a[0].v), first = 1 + t * t;
       return math::chained(a[0], t, first, 2 * t * first);
     },
     true},
    {"asin", "x", 1, false, [](Arguments a, double) noexcept { return arc_sine(a[0]); }},
    {"acos", "x", 1, false,
     [](Arguments a, double) noexcept {
       const math::Jet s = negative(arc_sine(a[0]));
       return math::Jet{s.v == s.v ? elementary::acos(a[0].v) : s.v, s.d, s.dd};
     }},
    {"atan", "x", 1, false, [](Arguments a, double) noexcept { return arc_tangent(a[0]); }},
    {"atan2", "y, x", 2, false, [](Arguments a, double way) noexcept { return angle_of(a[0], a[1], way); }, true},
    {"sinh", "x", 1, false,
     [](Arguments a, double) noexcept {
       const double s = elementary::sinh(a[0].v), c = elementary::cosh(a[0].v);
       return math::chained(a[0], s, c, s);
     }},
    {"cosh", "x", 1, false,
     [](Arguments a, double) noexcept {
       const double s = elementary::sinh(a[0].v), c = elementary::cosh(a[0].v);
       return math::chained(a[0], c, s, c);
     }},
    {"tanh", "x", 1, false,
     [](Arguments a, double) noexcept {
       const double t = elementary::tanh(a[0].v), c = elementary::cosh(a[0].v), first = 1 / c / c;
       return math::chained(a[0], t, first, -2 * t * first);
     }},
    {"exp", "x", 1, false, [](Arguments a, double) noexcept { return exponential(a[0]); }},
    {"log", "x", 1, false, [](Arguments a, double) noexcept { return logarithm(a[0]); }},
    {"sqrt", "x", 1, false, [](Arguments a, double) noexcept { return square_root(a[0]); }},
    {"cbrt", "x", 1, false, [](Arguments a, double) noexcept { return math::cbrt(a[0]); }},
    {"pow", "x, y", 2, false, [](Arguments a, double) noexcept { return raised(a[0], a[1]); }},
    {"hypot", "x, y", 2, false, [](Arguments a, double) noexcept { return square_root(a[0] * a[0] + a[1] * a[1]); }},
    {"abs", "x", 1, false,
     [](Arguments a, double way) noexcept {
       const double sign = tendency(a[0], way);
       return math::Jet{std::abs(a[0].v), sign * a[0].d, sign * a[0].dd};
     }},
    {"sign", "x", 1, false, [](Arguments a, double way) noexcept { return math::constant(tendency(a[0], way)); }, true},
    {"floor", "x", 1, false, [](Arguments a, double way) noexcept { return floor_of(a[0], way); }, true},
    {"ceil", "x", 1, false, [](Arguments a, double way) noexcept { return negative(floor_of(negative(a[0]), way)); },
     true},
    {"round", "x", 1, false, [](Arguments a, double way) noexcept { return floor_of(a[0] + 0.5, way); }, true},
    {"fract", "x", 1, false, [](Arguments a, double way) noexcept { return a[0] - floor_of(a[0], way); }, true},
    {"mod", "x, y", 2, false,
     [](Arguments a, double way) noexcept { return a[0] - a[1] * floor_of(quotient(a[0], a[1]), way); }, true},
    {"min", "a, b, ...", 2, true, [](Arguments a, double way) noexcept { return lesser(a[0], a[1], way); }},
    {"max", "a, b, ...", 2, true, [](Arguments a, double way) noexcept { return greater(a[0], a[1], way); }},
    {"clamp", "x, low, high", 3, false,
     [](Arguments a, double way) noexcept { return clamped(a[0], a[1], a[2], way); }},
    {"mix", "a, b, weight", 3, false, [](Arguments a, double) noexcept { return a[0] + (a[1] - a[0]) * a[2]; }},
    {"step", "edge, x", 2, false,
     [](Arguments a, double way) noexcept { return math::constant(tendency(a[1] - a[0], way) < 0 ? 0 : 1); }, true},
    {"smoothstep", "from, to, x", 3, false,
     [](Arguments a, double way) noexcept { return smooth_step(a[0], a[1], a[2], way); }},
};

constexpr ExpressionFunction operators[] = {
    {"+", "a, b", 2, false, [](Arguments a, double) noexcept { return a[0] + a[1]; }},
    {"-", "a, b", 2, false, [](Arguments a, double) noexcept { return a[0] - a[1]; }},
    {"*", "a, b", 2, false, [](Arguments a, double) noexcept { return a[0] * a[1]; }},
    {"/", "a, b", 2, false, [](Arguments a, double) noexcept { return quotient(a[0], a[1]); }, true},
    {"^", "a, b", 2, false, [](Arguments a, double) noexcept { return raised(a[0], a[1]); }},
    {"_", "a", 1, false, [](Arguments a, double) noexcept { return negative(a[0]); }},
};

}  // namespace
}  // namespace tweenfall::expressions

namespace tweenfall::expressions {

std::span<const ExpressionFunction> expression_functions() noexcept {
  return expressions::functions;
}

const ExpressionFunction* expression_operator(char symbol) noexcept {
  for (const ExpressionFunction& each : expressions::operators)
    if (each.name[0] == symbol) return &each;
  return nullptr;
}

}  // namespace tweenfall::expressions
