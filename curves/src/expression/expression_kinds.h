#pragma once

// Every operator and function of expressions as a type, so that one list of them makes the table of those for one
// number and the tables of those for many.

#include <cstddef>
#include <type_traits>

#include "expression/expression_numbers.h"

namespace tweenfall::expressions::kinds {

#define TWEENFALL_KIND(Name, arguments, formula)                                                \
  struct Name {                                                                                 \
    static constexpr int count = arguments;                                                     \
    template <class Number>                                                                     \
    TWEENFALL_INLINED static Number of(const Number* a, [[maybe_unused]] double way) noexcept { \
      return formula;                                                                           \
    }                                                                                           \
  };

TWEENFALL_KIND(Sum, 2, a[0] + a[1])
TWEENFALL_KIND(Difference, 2, a[0] - a[1])
TWEENFALL_KIND(Product, 2, a[0] * a[1])
TWEENFALL_KIND(Quotient, 2, quotient(a[0], a[1]))
TWEENFALL_KIND(Negative, 1, negative(a[0]))
TWEENFALL_KIND(ArcSine, 1, arc_sine(a[0]))
TWEENFALL_KIND(ArcTangent, 1, arc_tangent(a[0]))
TWEENFALL_KIND(AngleOf, 2, angle_of(a[0], a[1], way))
TWEENFALL_KIND(SquareRoot, 1, square_root(a[0]))
TWEENFALL_KIND(CubeRoot, 1, cube_root(a[0]))
TWEENFALL_KIND(Hypotenuse, 2, square_root(a[0] * a[0] + a[1] * a[1]))
TWEENFALL_KIND(Magnitude, 1, magnitude(a[0], way))
TWEENFALL_KIND(Sign, 1, fixed<Number>(tendency(a[0], way)))
TWEENFALL_KIND(Floor, 1, floor_of(a[0], way))
TWEENFALL_KIND(Ceiling, 1, negative(floor_of(negative(a[0]), way)))
TWEENFALL_KIND(Round, 1, floor_of(a[0] + 0.5, way))
TWEENFALL_KIND(Fraction, 1, a[0] - floor_of(a[0], way))
TWEENFALL_KIND(Remainder, 2, a[0] - a[1] * floor_of(quotient(a[0], a[1]), way))
TWEENFALL_KIND(Lesser, 2, lesser(a[0], a[1], way))
TWEENFALL_KIND(Greater, 2, greater(a[0], a[1], way))
TWEENFALL_KIND(Clamped, 3, clamped(a[0], a[1], a[2], way))
TWEENFALL_KIND(Mixed, 3, a[0] + (a[1] - a[0]) * a[2])
TWEENFALL_KIND(Step, 2, fixed<Number>(tendency(a[1] - a[0], way) < 0 ? 0 : 1))
TWEENFALL_KIND(SmoothStep, 3, smooth_step(a[0], a[1], a[2], way))
#undef TWEENFALL_KIND

struct ArcCosine {
  static constexpr int count = 1;
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    Number s = negative(arc_sine(a[0]));
    if (s.v == s.v) s.v = elementary::acos(a[0].v);
    return s;
  }
};
struct Tangent {
  static constexpr int count = 1;
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    const double t = elementary::tan(a[0].v), first = 1 + t * t;
    return chained(a[0], t, first, 2 * t * first);
  }
};
struct HyperbolicSine {
  static constexpr int count = 1;
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    const double s = elementary::sinh(a[0].v);
    return chained(a[0], s, elementary::cosh(a[0].v), s);
  }
};
struct HyperbolicCosine {
  static constexpr int count = 1;
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    const double c = elementary::cosh(a[0].v);
    return chained(a[0], c, elementary::sinh(a[0].v), c);
  }
};
struct HyperbolicTangent {
  static constexpr int count = 1;
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    const double t = elementary::tanh(a[0].v), c = elementary::cosh(a[0].v), first = 1 / c / c;
    return chained(a[0], t, first, -2 * t * first);
  }
};

// Those that follow from an elementary function of the argument, which for many is found for all of them first.
struct Sine {
  static constexpr int count = 1;
  template <class Number>
  TWEENFALL_INLINED static Number from(const Number& a, const elementary::SinCos& wave) noexcept {
    return chained(a, wave.sin, wave.cos, -wave.sin);
  }
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    return from(a[0], elementary::sin_cos(a[0].v));
  }
};
struct Cosine {
  static constexpr int count = 1;
  template <class Number>
  TWEENFALL_INLINED static Number from(const Number& a, const elementary::SinCos& wave) noexcept {
    return chained(a, wave.cos, -wave.sin, -wave.cos);
  }
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    return from(a[0], elementary::sin_cos(a[0].v));
  }
};
struct Exponential {
  static constexpr int count = 1;
  template <class Number>
  TWEENFALL_INLINED static Number from(const Number& a, double e) noexcept {
    return chained(a, e, e, e);
  }
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    return from(a[0], elementary::exp(a[0].v));
  }
};
struct Logarithm {
  static constexpr int count = 1;
  template <class Number>
  TWEENFALL_INLINED static Number from(const Number& a, double l) noexcept {
    return chained(a, l, 1 / a.v, -1 / (a.v * a.v));
  }
  template <class Number>
  static Number of(const Number* a, double) noexcept {
    return from(a[0], elementary::log(a[0].v));
  }
};
/// For numbers that stand still, only if its exponent is one for all of them.
struct Power {
  static constexpr int count = 2;
  static Jet of(const Jet* a, double) noexcept { return raised(a[0], a[1]); }
};

template <class... Kinds>
struct List {
  static constexpr std::size_t size = sizeof...(Kinds);
  template <class Kind>
  static constexpr std::size_t place_of() noexcept {
    std::size_t place = 0;
    (void)((std::is_same_v<Kind, Kinds> || (++place, false)) || ...);
    return place;
  }
};
using All = List<Sum, Difference, Product, Quotient, Negative, ArcSine, ArcCosine, ArcTangent, AngleOf, SquareRoot,
                 CubeRoot, Hypotenuse, Magnitude, Sign, Floor, Ceiling, Round, Fraction, Remainder, Lesser, Greater,
                 Clamped, Mixed, Step, SmoothStep, Tangent, HyperbolicSine, HyperbolicCosine, HyperbolicTangent, Sine,
                 Cosine, Exponential, Logarithm, Power>;

}  // namespace tweenfall::expressions::kinds
