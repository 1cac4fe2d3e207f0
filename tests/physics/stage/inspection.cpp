#include "support.h"

#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/stage.h>

using namespace tweenfall;

namespace {

NodeDescription ball_at(const std::string& name, const Vec3& place, double radius = 0.5) {
  return {.name = name, .rest = {.position = place}, .body = BodyDescription{.shape = {Sphere{radius}}, .mass = 1.0}};
}

}  // namespace

TEST_CASE("an inspection tells all that a stage refuses, each with its part, and the stage says the same") {
  StageDescription stage;
  stage.nodes = {ball_at("far", Vec3(1e31, 0, 0)), ball_at("right", Vec3(0, 0, 0)), ball_at("heavy", Vec3(3, 0, 0))};
  stage.nodes[2].body->mass = 1e40;
  stage.world.gravity = Vec3(0, 1e300, 0);
  const StageInspection found = inspect(stage);
  REQUIRE(found.faults.size() == 3);
  CHECK(found.faults[0].part == StageFault::Part::world);
  CHECK(found.faults[1].part == StageFault::Part::node);
  CHECK(found.faults[1].index == 0);
  CHECK(found.faults[1].message.find("the body of \"far\": position must be") == 0);
  CHECK(found.faults[2].index == 2);
  try {
    const Stage refused(stage);
    FAIL("a stage was made");
  } catch (const std::invalid_argument& error) {
    for (const StageFault& fault : found.faults)
      CHECK(std::string(error.what()).find(fault.message) != std::string::npos);
  }
  stage.world.gravity = Vec3(0, 0, 0);
  stage.nodes.erase(stage.nodes.begin());
  stage.nodes[1].body->mass = 1;
  stage.forces = {ForceDescription{}, ForceDescription{.force = Spring{.rest_length = 1e31}, .a = 0}};
  const StageInspection forces = inspect(stage);
  REQUIRE(forces.faults.size() == 1);
  CHECK(forces.faults[0].part == StageFault::Part::force);
  CHECK(forces.faults[0].index == 1);
}

TEST_CASE("bodies that start in each other are told with their depth; those that touch or are held there are not") {
  StageDescription stage;
  stage.nodes = {
      {.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
      ball_at("standing", Vec3(0, 0.5, 0)),
      ball_at("sunk", Vec3(3, 0.25, 0)),
      ball_at("held", Vec3(6, 0, 0)),
      ball_at("over it", Vec3(6, 0.9, 0)),
      ball_at("a pair", Vec3(9, 2, 0)),
      ball_at("together", Vec3(9, 2.01, 0)),
  };
  stage.nodes[3].body->drive = Drive::keyed();
  const std::vector<StartOverlap> found = inspect(stage).overlaps;
  REQUIRE(found.size() == 3);
  CHECK(found[0].a == 2);
  CHECK(found[0].b == 0);
  CHECK(found[0].depth == doctest::Approx(0.25));
  CHECK(found[1].a == 4);
  CHECK(found[1].b == 3);
  CHECK(found[1].depth == doctest::Approx(0.1));
  CHECK(found[2].depth == doctest::Approx(0.99));
}

TEST_CASE(
    "a spring is stiff from the step on at which its phase per step reaches 1 radian, and held ends do not count") {
  StageDescription stage;
  stage.nodes = {ball_at("free", Vec3(0, 0, 0)), ball_at("held", Vec3(3, 0, 0))};
  stage.nodes[1].body->drive = Drive::keyed();
  const auto with = [&](double stiffness, double damping, std::size_t a) {
    stage.forces = {ForceDescription{.force = Spring{.stiffness = stiffness, .damping = damping}, .a = a}};
    return inspect(stage).stiff_springs;
  };
  stage.step = 0.01;
  CHECK(with(9999, 0, 0).empty());
  const std::vector<StiffSpring> swing = with(40000, 0, 0);
  REQUIRE(swing.size() == 1);
  CHECK(swing[0].longest_step == doctest::Approx(0.005));
  CHECK(with(0, 99, 0).empty());
  const std::vector<StiffSpring> damped = with(0, 1000, 0);
  REQUIRE(damped.size() == 1);
  CHECK(damped[0].longest_step == doctest::Approx(0.001));
  CHECK(with(40000, 0, 1).empty());
}

TEST_CASE("what is too large, too small, too far or too fast for numbers is told, and what is merely large is not") {
  const auto extremes = [](const NodeDescription& node) {
    StageDescription stage;
    stage.nodes = {node};
    return inspect(stage).extremes.size();
  };
  CHECK(extremes(ball_at("near", Vec3(1e5, 0, 0))) == 0);
  CHECK(extremes(ball_at("far", Vec3(1e30, 0, 0))) == 1);
  CHECK(extremes(ball_at("small", Vec3(0, 0, 0), 1e-4)) == 0);
  CHECK(extremes(ball_at("tiny", Vec3(0, 0, 0), 1e-8)) == 1);
  CHECK(extremes(ball_at("large", Vec3(0, 0, 0), 1e4)) == 0);
  CHECK(extremes(ball_at("huge", Vec3(0, 0, 0), 1e10)) == 1);
  NodeDescription needle = ball_at("needle", Vec3(0, 0, 0));
  needle.body->shape = {Capsule{1e-3, 0.5}};
  CHECK(extremes(needle) == 0);
  needle.body->shape = {Capsule{5e-324, 0.5}};
  CHECK(extremes(needle) == 1);
  NodeDescription bullet = ball_at("bullet", Vec3(0, 0, 0));
  bullet.body->twist.linear.x() = 1000;
  CHECK(extremes(bullet) == 0);
  bullet.body->twist.linear.x() = 1e8;
  CHECK(extremes(bullet) == 1);
}

TEST_CASE("drag that explicit integrators cannot follow is told with its force, also where a fall leads to it") {
  StageDescription stage;
  stage.nodes = {ball_at("a", Vec3(0, 0, 0))};
  stage.nodes[0].body->mass = 2;
  stage.world.gravity.setZero();
  const auto told = [&](Integrator integrator, double quadratic, double speed) {
    stage.world.integrator = integrator;
    stage.nodes[0].body->twist.linear = Vec3(speed, 0, 0);
    stage.forces = {ForceDescription{.force = Drag{.quadratic = quadratic}}};
    const std::vector<Extreme> extremes = inspect(stage).extremes;
    for (const Extreme& extreme : extremes) CHECK(extreme.part == StageFault::Part::force);
    return extremes.size();
  };
  CHECK(told(Integrator::rk4, 200, 12) == 1);
  CHECK(told(Integrator::exact_quadratic, 200, 12) == 0);
  CHECK(told(Integrator::backward_euler, 200, 12) == 0);
  // By the rate 2 c v / m, 1 divided by a step of 1/240 s.
  CHECK(told(Integrator::explicit_euler, 200, 1.19) == 0);
  CHECK(told(Integrator::explicit_euler, 200, 1.21) == 1);
  // A fall ends at sqrt(m g / c), where the rate is 2 sqrt(g c / m).
  stage.world.gravity = Vec3(0, -9.81, 0);
  const double limit = 2 * 120.0 * 120.0 / 9.81;
  CHECK(told(Integrator::rk4, 0.98 * limit, 0) == 0);
  CHECK(told(Integrator::rk4, 1.02 * limit, 0) == 1);
}

TEST_CASE("what throws a body in the first steps is told: a pull beyond reason, or one that grows outward") {
  StageDescription stage;
  stage.nodes = {{.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}},
                 ball_at("a", Vec3(2, 3, 0))};
  CHECK(inspect(stage).extremes.empty());
  stage.world.gravity = Vec3(0, -1e30, 0);
  REQUIRE(inspect(stage).extremes.size() == 1);
  CHECK(inspect(stage).extremes[0].part == StageFault::Part::world);
  stage.world.gravity = Vec3(0, -9.81, 0);
  // A push of 1e12 N on 1 kg makes 4e9 m/s in a step.
  stage.forces = {ForceDescription{.force = Push{.force = Vec3(1e12, 0, 0)}, .a = 1}};
  REQUIRE(inspect(stage).extremes.size() == 1);
  CHECK(inspect(stage).extremes[0].part == StageFault::Part::node);
  CHECK(inspect(stage).extremes[0].index == 1);
  CHECK(inspect(stage, false).extremes.empty());  // nobody has tried
  stage.forces = {ForceDescription{.force = Vortex{.acceleration = 0.4, .power = -1.3}}};
  REQUIRE(inspect(stage).extremes.size() == 1);
  CHECK(inspect(stage).extremes[0].part == StageFault::Part::force);
  stage.forces = {ForceDescription{.force = Vortex{.acceleration = 0.4, .power = 1}}};
  CHECK(inspect(stage).extremes.empty());
}
