#include "actors/particles/block.h"

namespace tweenfall::particles {

namespace {

/// Memory for the states of a step, kept from block to block.
struct Stages {
  std::array<Lists, 4> rates, accelerations;
  Lists places, speeds;
  Pulls start, end;
};

/// x += h r
void add(std::size_t count, double h, const Lists& rates, Lists& values) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) values[axis][i] += h * rates[axis][i];
}

void sum(std::size_t count, const Lists& values, double h, const Lists& rates, Lists& out) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) out[axis][i] = values[axis][i] + h * rates[axis][i];
}

/// The integrator of bodies: exact under a constant force, drag taken implicitly, the force at both ends.
void exact_quadratic(const Pulling& pulling, std::size_t count, double time, double dt, Stages& stages, Lists& places,
                     Lists& speeds) {
  find_pulls(pulling, count, places, speeds, time, Instant::start, stages.start);
  const Pulls& start = stages.start;
  const Lists* end = &start.acceleration;
  if (!pulling.steady) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i) {
        const double a = start.acceleration[axis][i];
        stages.places[axis][i] = places[axis][i] + speeds[axis][i] * dt + a * (0.5 * dt * dt);
        stages.speeds[axis][i] = speeds[axis][i] + a * dt;
      }
    find_pulls(pulling, count, stages.places, stages.speeds, time + dt, Instant::end, stages.end);
    // What a medium carries along is taken at the start, like its drag.
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i)
        stages.end.acceleration[axis][i] += start.carried[axis][i] - stages.end.carried[axis][i];
    end = &stages.end.acceleration;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i) {
      const double a = start.acceleration[axis][i], before = speeds[axis][i], slowed = 1 + start.drag[i] * dt;
      const double after = (before + 0.5 * (a + (*end)[axis][i]) * dt) / slowed;
      const double with_drag = after * dt - (a - start.carried[axis][i]) * (0.5 * dt * dt / slowed);
      places[axis][i] += start.drag[i] > 0 ? with_drag : before * dt + a * (0.5 * dt * dt);
      speeds[axis][i] = after;
    }
}

void semi_implicit_euler(const Pulling& pulling, std::size_t count, double time, double dt, Stages& stages,
                         Lists& places, Lists& speeds) {
  accelerate(pulling, count, places, speeds, time, Instant::start, stages.start, stages.accelerations[0]);
  add(count, dt, stages.accelerations[0], speeds);
  add(count, dt, speeds, places);
}

void explicit_euler(const Pulling& pulling, std::size_t count, double time, double dt, Stages& stages, Lists& places,
                    Lists& speeds) {
  accelerate(pulling, count, places, speeds, time, Instant::start, stages.start, stages.accelerations[0]);
  add(count, dt, speeds, places);
  add(count, dt, stages.accelerations[0], speeds);
}

void velocity_verlet(const Pulling& pulling, std::size_t count, double time, double dt, Stages& stages, Lists& places,
                     Lists& speeds) {
  Lists &first = stages.accelerations[0], &second = stages.accelerations[1];
  accelerate(pulling, count, places, speeds, time, Instant::start, stages.start, first);
  add(count, dt, speeds, places);
  add(count, 0.5 * dt * dt, first, places);
  sum(count, speeds, dt, first, stages.speeds);
  accelerate(pulling, count, places, stages.speeds, time + dt, Instant::end, stages.end, second);
  add(count, 0.5 * dt, first, speeds);
  add(count, 0.5 * dt, second, speeds);
}

/// Two stages: the second at `share` of the step, with weight `weight`.
void two_stages(const Pulling& pulling, std::size_t count, double time, double dt, double share, double weight,
                Stages& stages, Lists& places, Lists& speeds) {
  Lists &first = stages.accelerations[0], &second = stages.accelerations[1];
  accelerate(pulling, count, places, speeds, time, Instant::start, stages.start, first);
  sum(count, places, share * dt, speeds, stages.places);
  sum(count, speeds, share * dt, first, stages.speeds);
  accelerate(pulling, count, stages.places, stages.speeds, time + share * dt,
             share < 1 ? Instant::middle : Instant::end, stages.end, second);
  add(count, (1 - weight) * dt, speeds, places);
  add(count, weight * dt, stages.speeds, places);
  add(count, (1 - weight) * dt, first, speeds);
  add(count, weight * dt, second, speeds);
}

void runge_kutta_4(const Pulling& pulling, std::size_t count, double time, double dt, Stages& stages, Lists& places,
                   Lists& speeds) {
  constexpr std::array<double, 4> ahead{0, 0.5, 0.5, 1}, weights{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  constexpr std::array<Instant, 4> instants{Instant::start, Instant::middle, Instant::middle, Instant::end};
  for (std::size_t stage = 0; stage < 4; ++stage) {
    stages.rates[stage] = speeds;
    stages.places = places;
    if (stage > 0) {
      add(count, ahead[stage] * dt, stages.rates[stage - 1], stages.places);
      add(count, ahead[stage] * dt, stages.accelerations[stage - 1], stages.rates[stage]);
    }
    accelerate(pulling, count, stages.places, stages.rates[stage], time + ahead[stage] * dt, instants[stage],
               stages.start, stages.accelerations[stage]);
  }
  for (std::size_t stage = 0; stage < 4; ++stage) {
    add(count, weights[stage] * dt, stages.rates[stage], places);
    add(count, weights[stage] * dt, stages.accelerations[stage], speeds);
  }
}

}  // namespace

void accelerate(const Pulling& pulling, std::size_t count, const Lists& places, const Lists& speeds, double time,
                Instant instant, Pulls& pulls, Lists& out) {
  find_pulls(pulling, count, places, speeds, time, instant, pulls);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < count; ++i)
      out[axis][i] = pulls.acceleration[axis][i] - pulls.drag[i] * speeds[axis][i];
}

void integrate(Integrator integrator, const Pulling& pulling, std::size_t count, double time, double dt, Lists& places,
               Lists& speeds) {
  // Some hundred kilobytes, of which nothing is read that this call has not written.
  thread_local Stages stages;
  switch (integrator) {
    case Integrator::exact_quadratic:
      return exact_quadratic(pulling, count, time, dt, stages, places, speeds);
    case Integrator::semi_implicit_euler:
      return semi_implicit_euler(pulling, count, time, dt, stages, places, speeds);
    case Integrator::explicit_euler:
      return explicit_euler(pulling, count, time, dt, stages, places, speeds);
    case Integrator::midpoint:
      return two_stages(pulling, count, time, dt, 0.5, 1, stages, places, speeds);
    case Integrator::trapezoid:
      return two_stages(pulling, count, time, dt, 1, 0.5, stages, places, speeds);
    case Integrator::rk4:
      return runge_kutta_4(pulling, count, time, dt, stages, places, speeds);
    case Integrator::verlet:
      return velocity_verlet(pulling, count, time, dt, stages, places, speeds);
    case Integrator::backward_euler:
      return meet_the_end(pulling, count, time, dt, 1, places, speeds);
    case Integrator::implicit_trapezoid:
      return meet_the_end(pulling, count, time, dt, 0.5, places, speeds);
  }
}

}  // namespace tweenfall::particles
