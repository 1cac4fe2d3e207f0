#pragma once

// The operators and functions of expressions on many numbers at once, with the bits that each of them has alone.

#include <array>
#include <cstddef>
#include <span>

#include "expression/expression_kinds.h"

namespace tweenfall::expressions {

/// How many numbers are handled together.
inline constexpr std::size_t most_lanes = 64;

/// Lists of the values, and for numbers that move of their first and second derivatives.
template <class Number>
inline constexpr std::size_t parts_of = sizeof(Number) / sizeof(double);
template <class Number>
using Lanes = std::array<std::array<double, most_lanes>, parts_of<Number>>;
template <class Number>
using LanesView = std::array<const double*, parts_of<Number>>;

/// What a function found of its argument's values: the derivatives in several variables follow from the same.
struct Prepared {
  std::size_t count = 0;  ///< of the values, 0 before
  double exponent = 0;    ///< of a power
  std::array<double, most_lanes> argument;
  std::array<std::array<double, most_lanes>, 3> found;
};

/// All of them write elsewhere than where they read.
template <class Number>
struct KernelsOf {
  using Function = void (*)(const LanesView<Number>* arguments, std::size_t count, double way, Prepared& prepared,
                            Lanes<Number>& out);
  std::array<Function, kinds::All::size> functions;  ///< none for `Power` of numbers that stand still
  /// a^n for one n.
  void (*raise)(const LanesView<Number>& a, double n, std::size_t count, Prepared& prepared, Lanes<Number>& out);
};
struct ExpressionKernels {
  KernelsOf<Still> values;
  KernelsOf<Jet> jets;

  template <class Number>
  [[nodiscard]] const KernelsOf<Number>& of() const noexcept {
    if constexpr (parts_of<Number> == 1)
      return values;
    else
      return jets;
  }
};

/// Those that this processor can run, from the slowest to the fastest.
[[nodiscard]] std::span<const ExpressionKernels* const> expression_kernels() noexcept;

}  // namespace tweenfall::expressions
