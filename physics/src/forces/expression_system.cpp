#include <tweenfall/physics/expression_system.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace tweenfall {

namespace forces {
namespace {

constexpr double most_on_the_way = 1e5;

double steps_of(const ExpressionSystem& system) {
  // A duration that is a whole number of steps, up to rounding, takes no extra step.
  return std::max(1.0, std::ceil(system.duration / system.step - 1e-9));
}

std::vector<Sample<double>> samples_of(double time, std::span<const double> state) {
  std::vector<Sample<double>> samples(state.size() + 1);
  samples[0].value = time;
  for (std::size_t i = 0; i < state.size(); ++i) samples[i + 1].value = state[i];
  return samples;
}

}  // namespace
}  // namespace forces

void validate(const ExpressionSystem& system) {
  const std::size_t count = system.variables.size();
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(count > 0, "a system needs a state");
  require(system.start.size() == count && system.rates.size() == count,
          "a system needs a start and a rate for each of its variables");
  for (const std::vector<double>& start : system.starts)
    require(start.size() == count, "every start of a system has one number for each of its variables");
  require(system.across <= count && system.up >= 1 && system.up <= count,
          "a portrait shows t or a variable across, and a variable up");
  require(system.step > 0 && std::isfinite(system.step) && system.duration > 0 && std::isfinite(system.duration),
          "step and duration of a system must be positive and finite");
  require(
      forces::steps_of(system) * static_cast<double>(count) <= forces::most_on_the_way,
      "the path of a system may have 100000 numbers, steps times variables; take longer steps or a shorter duration");
}

FirstOrder rates_of(const ExpressionSystem& system) {
  const auto rates = std::make_shared<const std::vector<Expression>>(system.rates);
  return [rates](double time, std::span<const double> state, std::span<double> out) {
    const std::vector<Sample<double>> at = forces::samples_of(time, state);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*rates)[i].sample(at).value;
  };
}

double value_at(const Expression& expression, double time, std::span<const double> state) {
  return expression.sample(forces::samples_of(time, state)).value;
}

FirstOrderPath path_of(const ExpressionSystem& system, std::span<const double> start) {
  validate(system);
  FirstOrderStepper stepper(rates_of(system), {start.begin(), start.end()}, system.integrator);
  const auto steps = static_cast<std::size_t>(forces::steps_of(system));
  FirstOrderPath path;
  for (std::size_t k = 0;; ++k) {
    // Multiplied, so that times do not drift from those of the steps.
    path.times.push_back(static_cast<double>(k) * system.step);
    path.states.emplace_back(stepper.state().begin(), stepper.state().end());
    if (k == steps) return path;
    stepper.step(system.step);
    if (!std::ranges::all_of(stepper.state(), [](double x) { return std::isfinite(x); })) return path;
  }
}

}  // namespace tweenfall
