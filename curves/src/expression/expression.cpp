#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/leaps.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "expression/expression_program.h"

namespace tweenfall {

ExpressionError::ExpressionError(std::size_t place, const std::string& fault)
    : std::invalid_argument("column " + std::to_string(place + 1) + ": " + fault), place_(place), fault_(fault) {}

Expression::Expression(std::string_view text, std::span<const Parameter> parameters)
    : Expression(text, std::array<std::string, 1>{"t"}, parameters) {}

Expression::Expression(std::string_view text, std::span<const std::string> variables,
                       std::span<const Parameter> parameters)
    : program_(std::make_shared<const Program>(Program{expressions::read_expression(text, variables, parameters)})) {}

Sample<double> Expression::sample(double t, Side side) const noexcept {
  const Sample<double> time{t, 1, 0};
  return sample(std::span<const Sample<double>>(&time, 1), side);
}

Sample<double> Expression::sample(std::span<const Sample<double>> variables, Side side) const noexcept {
  std::array<math::Jet, Program::most_depth> stack;
  std::size_t top = 0;
  const double way = side == Side::out ? 1 : -1;
  for (const Program::Step& step : program_->steps) {
    if (step.function) {
      top -= static_cast<std::size_t>(step.function->count);
      stack[top] = step.function->apply(&stack[top], way);
    } else if (step.variable < 0) {
      stack[top] = math::constant(step.number);
    } else if (const auto i = static_cast<std::size_t>(step.variable); i < variables.size()) {
      stack[top] = {variables[i].value, variables[i].rate, variables[i].acceleration};
    } else {
      stack[top] = math::constant(0);
    }
    ++top;
  }
  return {stack[0].v, stack[0].d, stack[0].dd};
}

bool Expression::reads(std::size_t variable) const noexcept {
  return std::any_of(program_->steps.begin(), program_->steps.end(), [&](const Program::Step& step) {
    return !step.function && step.variable >= 0 && static_cast<std::size_t>(step.variable) == variable;
  });
}

std::vector<Expression> Expression::jumping_parts() const {
  const std::vector<Program::Step>& steps = program_->steps;
  std::vector<Expression> parts;
  std::vector<std::ptrdiff_t> begins;  // of what lies on the stack, among the steps
  for (std::ptrdiff_t i = 0; i < std::ssize(steps); ++i) {
    std::ptrdiff_t begin = i;
    if (const expressions::ExpressionFunction* function = steps[static_cast<std::size_t>(i)].function) {
      begins.resize(begins.size() - static_cast<std::size_t>(function->count) + 1);
      begin = begins.back();
      begins.pop_back();
      if (function->jumps)
        parts.push_back(Expression(std::make_shared<const Program>(
            Program{std::vector<Program::Step>(steps.begin() + begin, steps.begin() + i + 1)})));
    }
    begins.push_back(begin);
  }
  return parts;
}

std::vector<std::string> Expression::functions() {
  std::vector<std::string> result;
  for (const expressions::ExpressionFunction& each : expressions::expression_functions())
    result.push_back(std::string(each.name) + "(" + std::string(each.arguments) + ")");
  return result;
}

Curve<double> expression_curve(const Expression& expression) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  std::vector<NumberOverTime> leaping;
  for (const Expression& part : expression.jumping_parts())
    if (part.reads(0)) leaping.push_back([part](double t, Side side) { return part.sample(t, side); });
  const Curve<double> curve(
      [expression](double t, Side side) {
        Sample<double> s = expression.sample(t, side);
        if (!std::isfinite(s.value)) return Sample<double>{0, 0, 0};
        if (!std::isfinite(s.rate)) s.rate = 0;
        if (!std::isfinite(s.acceleration)) s.acceleration = 0;
        return s;
      },
      -endless, endless);
  return leaping.empty() ? curve : with_leaping(curve, leaping);
}

}  // namespace tweenfall
