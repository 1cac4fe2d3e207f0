#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

void advance(std::span<double> since, double share, std::span<const double> rates) {
  for (std::size_t i = 0; i < since.size(); ++i) since[i] += share * rates[i];
}

Integrate* integrator_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::semi_implicit_euler:
      return semi_implicit_euler;
    case Integrator::explicit_euler:
      return explicit_euler;
    case Integrator::midpoint:
      return midpoint;
    case Integrator::trapezoid:
      return trapezoid;
    case Integrator::rk4:
      return rk4;
    case Integrator::exact_quadratic:
    case Integrator::verlet:
      return verlet;
    case Integrator::backward_euler:
      return backward_euler;
    case Integrator::implicit_trapezoid:
      return implicit_trapezoid;
  }
  return nullptr;
}

Integrate* asking(Integrator integrator) {
  const bool knows = integrator == Integrator::exact_quadratic || integrator == Integrator::semi_implicit_euler;
  return knows ? nullptr : integrator_of(integrator);
}

bool implicit(Integrator integrator) {
  return integrator == Integrator::backward_euler || integrator == Integrator::implicit_trapezoid;
}

bool exists(Integrator integrator) {
  return integrator_of(integrator) != nullptr;
}

}  // namespace tweenfall::forces
