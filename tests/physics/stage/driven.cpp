#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/recording.h>

#include <cmath>
#include <limits>

#include "forces/formula_leaps.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// 1000 kg on four standing wheels, with an empty script.
StageDescription parked_car() {
  StageDescription stage;
  stage.nodes.push_back({.name = "road", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  stage.nodes.push_back({.name = "car",
                         .rest = {.position = Vec3(0, 0.6 - 1000 * 9.81 / 120000, 0)},
                         .body = BodyDescription{.shape = {Box{Vec3(1.6, 0.1, 0.7)}}, .mass = 1000.0}});
  VehicleDescription car{.name = "car", .chassis = 1};
  for (const double x : {1.3, -1.3})
    for (const double z : {-0.7, 0.7})
      car.wheels.push_back({.name = (x > 0 ? std::string("front") : "rear") + (z > 0 ? " right" : " left"),
                            .wheel = {.mount = Vec3(x, 0, z), .grip = 0.8, .side_grip = 0.8},
                            .torque = 150,
                            .brake = 20'000,
                            .lock = x > 0 ? 0.05 : 0});
  stage.vehicles.push_back(std::move(car));
  return stage;
}

/// From step to step, what an agent sees decides what it does.
void drive_about(Stage& stage, double until) {
  while (stage.time() < until) {
    const double ahead = stage.world(1).motion.pose.position.x();
    if (ahead < 4)
      stage.control("car", {.throttle = 1 - ahead / 8, .steer = 0.3 * std::sin(stage.time())});
    else
      stage.control("car", {.throttle = 0, .brake = 0.4});
    stage.advance(0.0317);
  }
}

}  // namespace

TEST_CASE("a car that is driven from outside goes as its engine drives it, and stops after v^2 / (2 mu g)") {
  Stage stage(parked_car());
  stage.advance_to(0.2003);  // inside of a step
  CHECK(std::abs(stage.twist(1).linear.x()) < 1e-6);
  stage.control("car", {.throttle = 1});
  stage.advance_to(2.2003);
  // T / r on four wheels, divided by the mass plus that of the wheels
  CHECK(near(stage.twist(1).linear.x(), 2 * (4 * 150 / 0.3) / (1000 + 4 / 0.09), 2e-2));
  stage.control("car", {.throttle = 5});  // counts as 1
  stage.advance_to(3.2003);
  CHECK(near(stage.twist(1).linear.x(), 3 * (4 * 150 / 0.3) / (1000 + 4 / 0.09), 2e-2));
  stage.control("car", {.throttle = 0, .brake = 1});
  const double v = stage.twist(1).linear.x(), from = stage.world(1).motion.pose.position.x();
  stage.advance_to(6);
  CHECK(stage.world(1).motion.pose.position.x() - from == doctest::Approx(v * v / (2 * 0.8 * 9.81)).epsilon(0.02));
}

TEST_CASE("what drove a car, given again, leads to the same bits; so do going back, copies and what was saved") {
  Stage played(parked_car());
  drive_about(played, 2.5);
  const std::vector<TimedInput> inputs = played.inputs();
  CHECK(inputs.size() > 50);
  CHECK(std::get<input::Control>(inputs[3].what).vehicle == "car");
  Stage again(parked_car());
  CHECK(advance_with(again, inputs, played.time()).empty());
  CHECK(again.state_hash() == played.state_hash());
  CHECK(again.world(1).motion.pose.position == played.world(1).motion.pose.position);

  const std::uint64_t at_end = played.state_hash();
  const double end = played.time();
  played.seek(1.1);
  const std::vector<std::byte> saved = played.save();
  Stage loaded(parked_car());
  loaded.load(saved);
  CHECK(loaded.state_hash() == played.state_hash());
  played.advance_to(end);
  CHECK(played.state_hash() == at_end);
  // What was controlled when it was saved stays controlled; later controls come again.
  loaded.advance_to(end);
  CHECK(loaded.state_hash() == at_end);
  // Another script does not matter while everything is controlled.
  StageDescription scripted = parked_car();
  scripted.vehicles[0].throttle = Strength::formula("sin(t)");
  Stage held(scripted), free(parked_car());
  for (Stage* const stage : {&held, &free}) {
    stage->control("car", {.throttle = 0.5, .brake = 0, .steer = 0.1});
    stage->advance_to(1);
  }
  CHECK(held.state_hash() == free.state_hash());
}

TEST_CASE("a vehicle that is not there and numbers that are none are refused, and nothing has changed") {
  Stage stage(parked_car());
  stage.advance_to(0.1);
  const std::uint64_t before = stage.state_hash();
  CHECK_THROWS_WITH_AS(stage.control("cra", {.brake = 1}), doctest::Contains("did you mean \"car\"?"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(stage.control("car", {.steer = std::nan("")}), "steer of a vehicle must be finite",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(stage.control("car", {.throttle = -std::numeric_limits<double>::infinity()}),
                       "throttle of a vehicle must be finite", std::invalid_argument);
  CHECK_THROWS_WITH_AS(stage.control("car", {}), doctest::Contains("needs a throttle"), std::invalid_argument);
  CHECK(stage.state_hash() == before);
  CHECK(stage.inputs().empty());
}

TEST_CASE("a stage's hash tells of its wheels and particles, not of its bodies alone") {
  Stage still(parked_car()), turned(parked_car());
  // In the air a spinning wheel moves nothing else.
  for (Stage* const stage : {&still, &turned}) stage->advance_to(0.05);
  turned.control("car", {.steer = 0.5});
  CHECK(still.state_hash() != turned.state_hash());
  const auto fountain = [](double rate) {
    StageDescription stage;
    stage.particles.push_back({.name = "spray"});
    stage.particles[0].emitters.push_back({.rate = Curve<double>(rate), .speed = Curve<double>(2.0)});
    Stage run(stage);
    run.advance_to(0.5);
    return run.state_hash();
  };
  CHECK(fountain(10) == fountain(10));
  CHECK(fountain(10) != fountain(10.5));
  CHECK(fountain(10) != fountain(0));
}

TEST_CASE("where a strength leaps inside a step, the force is there from that instant on") {
  const double begins = 0.31371, ends = 0.71113;
  StageDescription stage;
  stage.step = 1.0 / 60;
  stage.world.gravity = Vec3(0, 0, 0);
  stage.nodes.push_back({.name = "box", .body = BodyDescription{.shape = {Box{Vec3(1, 1, 1)}}, .mass = 2.0}});
  const Strength keyed(keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::hold()},
                                            {.time = begins, .value = 1.0, .ease = Ease::hold()},
                                            {.time = ends, .value = 0.0}}));
  const Strength formula = Strength::formula("step(0.31371, t) - floor(t / 0.71113)");
  const auto kinds = {Integrator::exact_quadratic, Integrator::rk4, Integrator::trapezoid};
  for (int n = 0; n < 6; ++n) {
    stage.world.integrator = *(kinds.begin() + n / 2);
    stage.forces = {{.force = Push{.force = Vec3(3, 0, 0)}, .a = 0, .strength = n % 2 == 0 ? keyed : formula}};
    CAPTURE(n);
    Stage run(stage);
    run.advance_to(1);
    CHECK(near(run.twist(0).linear.x(), 1.5 * (ends - begins), 1e-8));
    const double gone = 0.75 * (ends - begins) * (ends - begins) + 1.5 * (ends - begins) * (1 - ends);
    CHECK(near(run.world(0).motion.pose.position.x(), gone, 1e-8));
  }
}

TEST_CASE("where a field leaps inside a step, in a pulse however short, its force is there from that instant on") {
  const double begins = 0.31371, ends = 0.71113;
  const auto short_pulse = [](double length) {
    return "3 * mass * (step(0.5113, t) - step(" + std::to_string(0.5113 + length) + ", t))";
  };
  struct Case {
    std::string text;
    double gain, way;  // m/s and m at 1 s, of 3 m/s^2
  };
  const double held = ends - begins, late = 1 - 0.5113;
  const std::vector<Case> cases{
      {"3 * mass * (step(0.31371, t) - floor(t / 0.71113))", 3 * held, 1.5 * held * held + 3 * held * (1 - ends)},
      {"1.5 * mass * (1 + sign(t - 0.31371))", 3 * (1 - begins), 1.5 * (1 - begins) * (1 - begins)},
      {"(3 + 0 * x * vy) * mass * floor(mod(t + 0.68629, 2))", 3 * (1 - begins), 1.5 * (1 - begins) * (1 - begins)},
      {short_pulse(1e-3), 3e-3, 3e-3 * (late - 5e-4)},
      {short_pulse(1e-5), 3e-5, 3e-5 * (late - 5e-6)}};
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4, Integrator::trapezoid})
    for (const Case& each : cases) {
      CAPTURE(each.text);
      StageDescription stage;
      stage.step = 1.0 / 60;
      stage.world.gravity = Vec3(0, 0, 0);
      stage.world.integrator = integrator;
      stage.nodes.push_back({.name = "box", .body = BodyDescription{.shape = {Box{Vec3(1, 1, 1)}}, .mass = 2.0}});
      stage.forces = {{.force = ForceFormula({each.text, "0", "0"})}};
      Stage run(stage);
      run.advance_to(1);
      CHECK(near(run.twist(0).linear.x(), each.gain, 1e-8));
      CHECK(near(run.world(0).motion.pose.position.x(), each.way, 1e-8));
    }
}

TEST_CASE("a thin slab of a field that a body passes within one step is told, and one that it cannot pass is not") {
  const auto told = [](const char* text, double speed) {
    StageDescription stage;
    stage.step = 1.0 / 60;
    stage.world.gravity = Vec3(0, 0, 0);
    BodyDescription bullet{.shape = {Sphere{0.01}}, .mass = 1.0};
    bullet.twist.linear = Vec3(speed, 0, 0);
    stage.nodes.push_back({.name = "bullet", .body = bullet});
    stage.forces = {{.force = ForceFormula({"0", text, "0"})}};
    const StageInspection found = inspect(stage, true);
    return found.extremes.empty() ? std::string() : found.extremes[0].message;
  };
  const char* slab = "step(1, x) - step(1.01, x)";
  CHECK(told(slab, 33).find("0.01 m long") != std::string::npos);
  CHECK(told(slab, 0.3).empty());
  CHECK(told("step(1, x) * step(0, 2 - x)", 30).empty());
  CHECK(told("x", 30).empty());
}

TEST_CASE("a formula that leaps tells when, and one that is only steep does not") {
  const auto parts = [](const char* text) {
    const Expression formula(text);
    return forces::leaping_parts({&formula, 1}, 0, 1);
  };
  CHECK(parts("2 * floor(t)").size() == 1);
  CHECK(parts("floor(3 * step(0.5, t)) / t - floor(2)").size() == 3);
  CHECK(parts("smoothstep(0, 1, t)").empty());
  const double never = std::numeric_limits<double>::infinity();
  const auto leap = [&](const char* text, double from, double to) {
    double first = never;
    for (const Expression& part : parts(text))
      first = std::min(first, forces::next_leap(forces::by_time(part, 0), from, std::min(to, first)));
    return first;
  };
  // Of many the first.
  CHECK(near(leap("floor(1000 * t)", 0.0005, 0.0205), 0.001, 1e-15));
  CHECK(near(leap("step(0.50003, t) - step(0.50004, t)", 0.49, 0.51), 0.50003, 1e-15));
  CHECK(near(leap("step(0.99, fract(10 * t))", 0.095, 0.105), 0.099, 1e-14));
  CHECK(leap("step(0.5, t)", 0.49, 0.51) == 0.5);
  CHECK(leap("step(0.5, t)", 0.49, 0.5) == 0.5);
  CHECK(leap("step(0.5, t)", 0.5, 0.51) == never);
  CHECK(near(leap("floor(t / 0.1)", 0.295, 0.305), 0.3, 1e-15));
  CHECK(near(leap("3 + 1e-6 * sign(sin(pi * t))", 0.999, 1.002), 1, 1e-15));
  CHECK(near(leap("mod(t, 0.7) * exp(t)", 1.39, 1.41), 1.4, 1e-15));
  CHECK(near(leap("fract(t) + 40 * sin(9 * t)", 1.999, 2.003), 2, 1e-15));
  for (const char* text : {"sin(1000 * t)", "smoothstep(0.499, 0.501, t)", "100 * t / (1 + t)", "atan2(sin(t), cos(t))",
                           "tanh(1e4 * (t - 0.5)) + floor(t)", "abs(t - 0.5)", "max(t, 0.5)", "1 / (t - 0.5)"})
    CHECK_MESSAGE(leap(text, 0.4985, 0.5015) == never, text);
  // Near the jump each side has its own value, as far as sums of steps may be off.
  const Strength strength = Strength::formula("floor(t)");
  for (const double off : {-3e-10, 0.0, 3e-10}) {
    CHECK(strength.at(2 + off, Side::out) == 2);
    CHECK(strength.at(2 + off, Side::in) == 1);
  }
  CHECK(strength.at(2.5) == 2);
}
