#pragma once

/// Formulas written as text, `2*cos(tau*t)`, with exact rates.
///
/// Numbers, + - * / ^ (a power binds tighter than a sign and groups from the right), parentheses, the constants `pi`,
/// `tau` and `e`, variables and parameters by name, angles in radians, and the functions that `Expression::functions`
/// lists. A text is read once into a short program; evaluating that carries first and second derivatives along
/// (automatic differentiation), allocates nothing and never throws.

#include <tweenfall/curves/curve.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tweenfall {

/// What is wrong with an expression, and where.
class ExpressionError : public std::invalid_argument {
 public:
  ExpressionError(std::size_t place, const std::string& fault);
  /// Bytes before the place.
  [[nodiscard]] std::size_t place() const noexcept { return place_; }
  /// What is wrong, without the place.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  std::size_t place_;
  std::string fault_;
};

class Expression {
 public:
  /// A name that stands for a fixed number.
  struct Parameter {
    std::string name;
    double value = 0;
  };

  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  Expression(const Expression&) noexcept = default;
  Expression& operator=(const Expression&) noexcept = default;

  /// @param text       up to 4000 characters, nested up to 60 deep
  /// @param variables  names in the order in which `sample` takes their values
  /// @throws ExpressionError with the column and, for an unknown name, the nearest known one.
  explicit Expression(std::string_view text, std::span<const Parameter> parameters = {});
  Expression(std::string_view text, std::span<const std::string> variables, std::span<const Parameter> parameters);

  /// For the one variable t, at rate 1. Infinite or not a number where the formula is.
  ///
  /// Where the formula jumps or kinks (floor, abs, min, step, ...), `side` says which limit is meant.
  [[nodiscard]] Sample<double> sample(double t, Side side = Side::out) const noexcept;

  /// For several variables, each with its own first and second derivative. With the derivatives of a motion the result
  /// has the rate and acceleration along it; with a rate of 1 in one variable and 0 elsewhere, the partial derivatives
  /// in that one.
  /// @param variables  as many as were named
  [[nodiscard]] Sample<double> sample(std::span<const Sample<double>> variables, Side side = Side::out) const noexcept;

  /// For many sets of variables that stand still, in a fraction of the time: the value that `sample` gives for each, to
  /// the last bit.
  /// @param variables  for each variable a number per set, or fewer: then the first is that of all sets
  void values(std::span<const std::span<const double>> variables, std::span<double> out) const noexcept;
  /// Likewise partial derivatives, one list in the variable number `first`, the next in the one after it.
  /// @param out  lists of one length
  void slopes(std::span<const std::span<const double>> variables, std::size_t first,
              std::span<const std::span<double>> out, Side side = Side::out) const noexcept;

  /// Whether it reads the variable of that number.
  [[nodiscard]] bool reads(std::size_t variable) const noexcept;
  /// Its parts that may jump from one value to another, each as an expression of the same variables, inner ones first:
  /// calls of sign, floor, ceil, round, fract, mod, step, tan and atan2, and quotients.
  [[nodiscard]] std::vector<Expression> jumping_parts() const;

  /// Names and what they take, "clamp(x, low, high)", in the order the documentation lists them.
  [[nodiscard]] static std::vector<std::string> functions();

  struct Program;  ///< private to the library

 private:
  explicit Expression(std::shared_ptr<const Program> program) : program_(std::move(program)) {}

  std::shared_ptr<const Program> program_;
};

/// The expression as a curve over all times. Where the formula has no finite value, 0 stands in; where it has no finite
/// rate (sqrt(t) at 0), the rate is 0.
[[nodiscard]] Curve<double> expression_curve(const Expression& expression);

}  // namespace tweenfall
