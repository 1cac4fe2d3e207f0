#include <tweenfall/physics/first_order.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "forces/integrators/integrators.h"

namespace tweenfall {

namespace {

constexpr std::size_t most_numbers_of_path = 10'000'000;

bool halves(Integrator integrator) {
  return integrator == Integrator::exact_quadratic || integrator == Integrator::semi_implicit_euler ||
         integrator == Integrator::verlet;
}

void require_system(bool fine, const char* fault) {
  if (!fine) throw std::invalid_argument(std::string("a system of first order: ") + fault);
}

}  // namespace

FirstOrderStepper::FirstOrderStepper(FirstOrder rates, std::vector<double> state, Integrator integrator, double time)
    : rates_(std::move(rates)), state_(std::move(state)), integrator_(integrator), time_(time) {
  require_system(static_cast<bool>(rates_), "there are no rates");
  require_system(!state_.empty(), "the state has no numbers");
  require_system(std::all_of(state_.begin(), state_.end(), [](double number) { return std::isfinite(number); }),
                 "a number of the state is not finite");
  require_system(std::isfinite(time_), "the time is not finite");
  require_system(forces::exists(integrator_), "there is no such integrator");
  require_system(!halves(integrator_) || state_.size() % 2 == 0,
                 "this integrator needs positions and as many velocities, but the state has an odd length");
  places_.assign(state_.size(), 0);
  std::fill_n(places_.begin(), state_.size() / 2, std::uint8_t{1});
  there_.resize(state_.size());
  sizes_.resize(state_.size());
  means_.resize(state_.size());
}

void FirstOrderStepper::step(double dt) {
  require_system(std::isfinite(dt), "a step is not finite");
  if (dt == 0) return;
  for (std::size_t i = 0; i < state_.size(); ++i) sizes_[i] = std::abs(state_[i]);
  const auto rates_of = [this](double after, std::span<const double> since, std::span<double> rates) {
    for (std::size_t i = 0; i < state_.size(); ++i) there_[i] = state_[i] + since[i];
    rates_(time_ + after, there_, rates);
  };
  constexpr std::array<std::uint32_t, 1> one{0};
  forces::integrator_of(integrator_)({std::ref(rates_of), state_.size(), 1, places_, sizes_, one, one}, dt, room_,
                                     means_);
  forces::advance(state_, dt, means_);
  time_ += dt;
}

FirstOrderPath first_order_path(const FirstOrder& rates, const std::vector<double>& start, Integrator integrator,
                                double dt, std::size_t count, double time) {
  require_system(count < most_numbers_of_path / std::max<std::size_t>(1, start.size()),
                 "a path of more than ten million numbers");
  FirstOrderStepper stepper(rates, start, integrator, time);
  FirstOrderPath path;
  path.times.reserve(count + 1);
  path.states.reserve(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    if (i > 0) stepper.step(dt);
    // Multiplied rather than added up, so that the last time is what was asked for.
    path.times.push_back(time + static_cast<double>(i) * dt);
    path.states.emplace_back(stepper.state().begin(), stepper.state().end());
  }
  return path;
}

}  // namespace tweenfall
