#include <tweenfall/physics/height_field.h>
#include <tweenfall/physics/triangle_mesh.h>

#include <cmath>

#include "physics/strategies/ground.h"

using namespace tweenfall;
using test::near;

namespace {

constexpr double sixtieth = 1.0 / 60;

Solid square_of_triangles() {
  return TriangleMesh({.positions = {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}}, .triangles = {0, 2, 1, 0, 3, 2}});
}

BodyId add_led(World& world, const Solid& solid, const Vec3& place, const Vec3& velocity) {
  BodySettings led = test::solid_at(solid, place);
  led.drive = Drive::keyed();
  led.motion.twist.linear = velocity;
  return world.add(led);
}

void lead(World& world, BodyId body, const Vec3& velocity) {
  Motion target = world.motion(body);
  target.pose.position += sixtieth * velocity;
  target.twist.linear = velocity;
  world.set_target(body, target);
}

}  // namespace

TEST_CASE("what falls onto triangles lies on them, however they are found and whatever takes overlap apart") {
  for (const Detection collision : {Detection::discrete, Detection::ahead, Detection::time_of_impact})
    for (const Parting separation :
         {Parting::half, Parting::by_mass, Parting::positional_impulse, Parting::closest_point}) {
      CAPTURE(static_cast<int>(collision));
      CAPTURE(static_cast<int>(separation));
      World world(test::with(ContactSolver::iterative, separation, collision));
      BodySettings ground = test::solid_at(square_of_triangles(), Vec3::Zero());
      ground.mass.reset();
      ground.fixed = true;
      world.add(ground);
      const BodyId ball = world.add(test::solid_at(Sphere{0.1}, Vec3(0.3, 0.4, 0.1)));
      const BodyId box = world.add(test::solid_at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(1.3, 0.5, 1.1)));
      for (int n = 0; n < 180; ++n) world.step(sixtieth);
      // A step's fall from rest, g dt^2, is what discrete detection finds each time.
      CHECK(near(world.motion(ball).pose.position.y(), 0.1, 3e-3));
      CHECK(near(world.motion(box).pose.position.y(), 0.2, 3e-3));
    }
}

TEST_CASE("what stands on a lift that goes down stays on it, and what a bat meets stays in front of it") {
  for (const Detection collision : {Detection::discrete, Detection::ahead, Detection::time_of_impact}) {
    CAPTURE(static_cast<int>(collision));
    World world(test::with(ContactSolver::iterative, Parting::half, collision));
    const Vec3 down(0, -1, 0), onward(5, 0, 0);
    const BodyId lift = add_led(world, Box{Vec3(1, 0.1, 1)}, Vec3(0, 10, 0), down);
    const BodyId box = world.add(test::solid_at(Box{Vec3(0.2, 0.2, 0.2)}, Vec3(0, 10.3, 0)));
    World weightless(test::weightless(test::with(ContactSolver::iterative, Parting::half, collision)));
    const BodyId bat = add_led(weightless, Box{Vec3(0.5, 1, 1)}, Vec3(0, 0, 0), onward);
    const BodyId ball = weightless.add(test::solid_at(Sphere{0.1}, Vec3(0.83, 0, 0)));
    for (int n = 0; n < 120; ++n) {
      lead(world, lift, down);
      world.step(sixtieth);
      lead(weightless, bat, onward);
      weightless.step(sixtieth);
      if (n < 30) continue;
      REQUIRE(near(world.motion(box).pose.position.y() - world.motion(lift).pose.position.y(), 0.3, 3e-3));
      REQUIRE(near(weightless.motion(ball).pose.position.x() - weightless.motion(bat).pose.position.x(), 0.6, 1e-3));
    }
    CHECK(near(weightless.twist(ball).linear, onward, 1e-6));
  }
}
