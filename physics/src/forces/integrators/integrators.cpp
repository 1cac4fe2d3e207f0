#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

void Change::add(double share, const Change& other) {
  center += share * other.center;
  linear += share * other.linear;
  turn += share * other.turn;
  momentum += share * other.momentum;
}

Integrate* asking(Integrator integrator) {
  switch (integrator) {
    case Integrator::exact_quadratic:
    case Integrator::semi_implicit_euler:
      break;
    case Integrator::explicit_euler:
      return explicit_euler;
    case Integrator::midpoint:
      return midpoint;
    case Integrator::trapezoid:
      return trapezoid;
    case Integrator::rk4:
      return rk4;
  }
  return nullptr;
}

bool exists(Integrator integrator) {
  return integrator == Integrator::exact_quadratic || integrator == Integrator::semi_implicit_euler ||
         asking(integrator) != nullptr;
}

}  // namespace tweenfall::forces
