// A hundred thousand particles through a sixtieth of a second on one core, which at 60 Hz may take 16.7 ms: falling, in
// a wind and around an attractor, under formulas, and among bodies. The counter gives milliseconds of the processor per
// step.

#include <tweenfall/physics/particles.h>

#include <benchmark/benchmark.h>

namespace {

using namespace tweenfall;

constexpr int many = 100000;

Particles spread(Integrator integrator) {
  Particles particles({.integrator = integrator, .radius = 0, .life = 1e9});
  for (int i = 0; i < many; ++i)
    particles.emit(Vec3(0.02 * (i % 500) - 5, 0.05 * (i / 500), 0.01 * (i % 700)), Vec3(0.1 * (i % 7), 1, 0));
  return particles;
}

void tell(benchmark::State& state) {
  state.counters["ms"] = benchmark::Counter(static_cast<double>(state.iterations()) * 1e-3,
                                            benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void falling(benchmark::State& state, Integrator integrator) {
  Particles particles = spread(integrator);
  particles.add_force(Drag{.linear = 1e-4, .quadratic = 1e-5});
  for (auto _ : state) particles.step(1e-6);
  tell(state);
}
BENCHMARK_CAPTURE(falling, exact_quadratic, Integrator::exact_quadratic);
BENCHMARK_CAPTURE(falling, semi_implicit_euler, Integrator::semi_implicit_euler);
BENCHMARK_CAPTURE(falling, verlet, Integrator::verlet);
BENCHMARK_CAPTURE(falling, rk4, Integrator::rk4);
BENCHMARK_CAPTURE(falling, backward_euler, Integrator::backward_euler);
BENCHMARK_CAPTURE(falling, implicit_trapezoid, Integrator::implicit_trapezoid);

void blown_around(benchmark::State& state) {
  Particles particles = spread(Integrator::exact_quadratic);
  particles.add_force(Wind{.velocity = Vec3(3, 0, 0), .linear = 1e-4});
  particles.add_force(Attractor{.at = Vec3(0, 5, 0), .acceleration = 20, .softening = 0.5});
  particles.add_force(Vortex{.acceleration = 5, .softening = 0.5});
  for (auto _ : state) particles.step(1e-6);
  tell(state);
}
BENCHMARK(blown_around);

void under_a_formula(benchmark::State& state, const ForceFormula& formula, Integrator integrator) {
  Particles particles = spread(integrator);
  particles.add_force(formula);
  for (auto _ : state) particles.step(1e-6);
  tell(state);
}
const ForceFormula waves({"-mass*sin(3*x + t)", "mass*cos(2*y)*exp(-0.1*z^2)", "-0.1*mass*vz/(1 + x^2)"});
BENCHMARK_CAPTURE(under_a_formula, waves, waves, Integrator::exact_quadratic);
BENCHMARK_CAPTURE(under_a_formula, waves_by_rk4, waves, Integrator::rk4);
BENCHMARK_CAPTURE(under_a_formula, waves_by_backward_euler, waves, Integrator::backward_euler);
BENCHMARK_CAPTURE(under_a_formula, linear, ForceFormula({"-mass*x", "-0.1*mass*y", "mass*sin(3*t)"}),
                  Integrator::exact_quadratic);
BENCHMARK_CAPTURE(under_a_formula, potential, ForceFormula::potential("mass*(0.5*x^2 + sin(y)*cos(z))"),
                  Integrator::exact_quadratic);
BENCHMARK_CAPTURE(under_a_formula, jumping,
                  ForceFormula({"mass*floor(2*x)", "mass*abs(y)^0.5", "mass*log(1 + z^2)*sqrt(1 + x^2)"}),
                  Integrator::exact_quadratic);

void among_bodies(benchmark::State& state) {
  World world;
  BodySettings body;
  body.fixed = true;
  body.shape.solid = Plane{};
  world.add(body);
  for (int i = 0; i < 20; ++i) {
    body.shape.solid = i % 2 == 0 ? Solid{Box{Vec3(0.3, 0.3, 0.3)}} : Solid{Sphere{0.3}};
    body.motion.pose.position = Vec3(0.5 * i - 5, 0.3 + 0.4 * (i % 5), 0.3 * i);
    world.add(body);
  }
  Particles particles = spread(Integrator::exact_quadratic);
  for (auto _ : state) particles.step(1.0 / 60, world);
  tell(state);
}
BENCHMARK(among_bodies)->Iterations(30);

}  // namespace
