#pragma once

/// Systems of first order given as formulas: a state of named numbers, and a formula for the rate of each.

#include <tweenfall/curves/expression.h>
#include <tweenfall/physics/first_order.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// x' = f(x, t) by expressions, from one start, and from others to compare it with.
struct ExpressionSystem {
  std::string name;
  std::vector<std::string> variables;       ///< positions first, then velocities, for integrators that need it
  std::vector<double> start;                ///< at t = 0; one for each variable
  std::vector<Expression> rates;            ///< of t and then the variables; one per variable
  std::optional<Expression> energy;         ///< of the same; a quantity whose conservation is to be watched
  std::vector<std::vector<double>> starts;  ///< other starts, for a portrait
  std::size_t across = 1, up = 2;           ///< the axes of a portrait: 0 is t, 1 the first variable, ...
  Integrator integrator = Integrator::rk4;
  double step = 0.01;    ///< s; > 0
  double duration = 10;  ///< s; > 0
};

/// @throws std::invalid_argument for lists of different lengths, numbers out of range, and more than a hundred thousand
/// numbers in the path.
void validate(const ExpressionSystem& system);

[[nodiscard]] FirstOrder rates_of(const ExpressionSystem& system);
/// An expression of t and the variables at a state.
[[nodiscard]] double value_at(const Expression& expression, double time, std::span<const double> state);

/// The path from a start until the duration is over, or until a state is no longer finite: then it ends with the last
/// one that is.
[[nodiscard]] FirstOrderPath path_of(const ExpressionSystem& system, std::span<const double> start);

}  // namespace tweenfall
