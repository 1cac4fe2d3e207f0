#pragma once

// A parsed expression: steps for a stack machine.

#include <tweenfall/curves/expression.h>

#include "expression/expression_functions.h"

namespace tweenfall {

struct Expression::Program {
  /// Pushes a number or a variable, or calls a function on what was pushed last.
  struct Step {
    const expressions::ExpressionFunction* function = nullptr;  // null: pushes
    int variable = -1;                                          // -1: the number
    double number = 0;
  };
  static constexpr int most_depth = 64;

  std::vector<Step> steps;
};

namespace expressions {

/// @throws ExpressionError
[[nodiscard]] std::vector<Expression::Program::Step> read_expression(std::string_view text,
                                                                     std::span<const std::string> variables,
                                                                     std::span<const Expression::Parameter> parameters);

}  // namespace expressions

}  // namespace tweenfall
