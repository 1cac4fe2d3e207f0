#pragma once

// Expressions at many sets of variables at once.

#include "expression/expression_kernels.h"
#include "expression/expression_program.h"

namespace tweenfall::expressions {

/// One list per variable.
using VariableLists = std::span<const std::span<const double>>;

void find_values(const ExpressionKernels& kernels, const Expression::Program& program, VariableLists variables,
                 std::span<double> out) noexcept;
/// @param first  number of the variable of the first list of results; the next are those of the next variables
void find_slopes(const ExpressionKernels& kernels, const Expression::Program& program, VariableLists variables,
                 std::size_t first, double way, std::span<const std::span<double>> out) noexcept;

}  // namespace tweenfall::expressions
