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
