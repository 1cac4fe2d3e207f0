#pragma once

// The operators and functions of expressions, each on numbers with their derivatives.

#include <span>
#include <string_view>

#include "math/jet.h"

namespace tweenfall::expressions {

struct ExpressionFunction {
  std::string_view name;       // as written: "+", "clamp"
  std::string_view arguments;  // "x, low, high"
  int count;                   // of the arguments
  /// `way` is 1 for the limit from later, -1 for that from earlier: it decides where the function jumps or kinks.
  math::Jet (*apply)(const math::Jet* arguments, double way) noexcept;
  std::size_t kind;         // its place among `kinds::All`
  bool jumps = false;       // somewhere, from one value to another
  bool any_number = false;  // more arguments are folded: max(a, b, c) = max(max(a, b), c)
};

/// Those with a name, in the order the documentation lists them.
[[nodiscard]] std::span<const ExpressionFunction> expression_functions() noexcept;

/// One of + - * / ^, or '_' for the sign.
[[nodiscard]] const ExpressionFunction* expression_operator(char symbol) noexcept;

}  // namespace tweenfall::expressions
