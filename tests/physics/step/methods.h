#pragma once

#include <tweenfall/physics/world.h>

#include <array>

namespace tweenfall::test {

/// An integrator, and the power of the step with which its error decreases.
struct Method {
  const char* name;
  Integrator integrator;
  double order;
};
inline constexpr std::array<Method, 9> methods{{{"exact-quadratic", Integrator::exact_quadratic, 2},
                                                {"semi-implicit-euler", Integrator::semi_implicit_euler, 1},
                                                {"explicit-euler", Integrator::explicit_euler, 1},
                                                {"midpoint", Integrator::midpoint, 2},
                                                {"trapezoid", Integrator::trapezoid, 2},
                                                {"rk4", Integrator::rk4, 4},
                                                {"verlet", Integrator::verlet, 2},
                                                {"backward-euler", Integrator::backward_euler, 1},
                                                {"implicit-trapezoid", Integrator::implicit_trapezoid, 2}}};

}  // namespace tweenfall::test
