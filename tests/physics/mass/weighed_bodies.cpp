#include <tweenfall/physics/mass_properties.h>
#include <tweenfall/physics/stage/stage.h>
#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

/// A ball with a core low in it, 1 kg in all.
BodySettings weighed_tumbler() {
  const MassProperties shell = mass_properties(Shape{Sphere{0.1}}, 0.4);
  Shape core{Sphere{0.03}};
  core.offset.position = {0, -0.05, 0};
  const MassProperties parts[] = {shell, mass_properties(core, 0.6)};
  return {.shape = {Sphere{0.1}}, .mass_properties = mass_properties(parts), .friction = 1};
}

}  // namespace

TEST_CASE("a ball that is heavier below rocks upright with the period of its closed form") {
  // Rolling without slip, small swings: w^2 = m g d / (I + m (R - d)^2), d from the middle to the center of mass.
  BodySettings ball = weighed_tumbler();
  const MassProperties mass = *ball.mass_properties;
  CHECK(near(mass.center, Vec3(0, -0.03, 0), 1e-15));
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  world.add({.shape = {Plane{}}, .friction = 1, .fixed = true});
  ball.motion.pose.position = {0, 0.1, 0};
  constexpr double tilt = 0.05;
  ball.motion.pose.rotation = Quat(std::cos(tilt / 2), 0, 0, std::sin(tilt / 2));
  const BodyId id = world.add(ball);
  CHECK(near(world.mass(id).inertia, mass.inertia, 1e-15));
  const double w = std::sqrt(9.81 * 0.03 / (mass.inertia(2, 2) + 0.07 * 0.07));
  const auto leans = [&] { return 2 * world.motion(id).pose.rotation.z(); };
  double crossed = 0, before = leans();
  const double dt = 1.0 / 960;
  int crossings = 0;
  for (int k = 1; crossings < 5 && k < 5000; ++k) {
    world.step(dt);
    const double now = leans();
    if ((before > 0) != (now > 0)) {
      ++crossings;
      crossed = (k - now / (now - before)) * dt;
    }
    before = now;
  }
  // Five quarters of swings minus one: from the tilt to the fifth time upright there are 2 1/4 swings.
  CHECK(crossed == doctest::Approx(2.25 * 2 * test::pi / w).epsilon(0.01));
}

TEST_CASE("a weighed body that is saved and loaded, or copied, goes on to the same bits") {
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  for (int i = 0; i < 3; ++i) {
    BodySettings ball = weighed_tumbler();
    ball.motion.pose.position = {0.05 * i, 0.2 + 0.25 * i, 0};
    world.add(ball);
  }
  for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
  World loaded, copy = world;
  loaded.load(world.save());
  for (int k = 0; k < 60; ++k)
    for (World* each : {&world, &loaded, &copy}) each->step(1.0 / 60);
  CHECK(loaded.state_hash() == world.state_hash());
  CHECK(copy.state_hash() == world.state_hash());
}

TEST_CASE("a stage hands mass properties on, keeps them when it is saved, and not on a scaled node") {
  const BodySettings ball = weighed_tumbler();
  NodeDescription node{.name = "ball",
                       .body = BodyDescription{.shape = ball.shape, .mass_properties = ball.mass_properties}};
  node.rest.position = {0, 3, 0};
  StageDescription described{.nodes = {node}};
  Stage stage(described);
  stage.advance(0.1);
  Stage loaded(described);
  loaded.load(stage.save());
  for (Stage* each : {&stage, &loaded}) each->advance(0.2);
  CHECK(loaded.state_hash() == stage.state_hash());
  described.nodes[0].rest.scale = {2, 2, 2};
  CHECK_THROWS_WITH(Stage{described}, doctest::Contains("need a node of scale 1"));
}

TEST_CASE("mass properties that no body can have are refused") {
  World world;
  const auto added = [&](const MassProperties& properties, Solid solid = Sphere{0.1}, bool fixed = false) {
    return world.add({.shape = {std::move(solid)}, .mass_properties = properties, .fixed = fixed});
  };
  const MassProperties rod = mass_properties(std::vector<PointMass>{{1, {0, 0, 0}}, {2, {0.6, 0, 0}}});
  CHECK_THROWS_WITH(added(rod), doctest::Contains("a body needs a moment of inertia about every axis"));
  CHECK_THROWS_WITH(added(*weighed_tumbler().mass_properties, Plane{}, true),
                    "a plane has no mass, so it takes no mass properties");
  MassProperties skewed = *weighed_tumbler().mass_properties;
  skewed.inertia(0, 0) *= 5;
  CHECK_THROWS_WITH(added(skewed), doctest::Contains("exceed the sum of the others"));
  BodySettings both = weighed_tumbler();
  both.mass = 1;
  CHECK_THROWS_WITH(world.add(both), "a body takes a mass or mass properties, not both");
}
