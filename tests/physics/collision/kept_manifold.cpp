#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

double lowest_corner(const Motion& motion, const Vec3& half) {
  double lowest = 1e9;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 local((corner & 1 ? 1 : -1) * half.x(), (corner & 2 ? 1 : -1) * half.y(),
                     (corner & 4 ? 1 : -1) * half.z());
    lowest = std::min(lowest, (motion.pose.position + motion.pose.rotation * local).y());
  }
  return lowest;
}

}  // namespace

TEST_CASE("a box that falls over onto a face is met by all its corners, however slowly it turns") {
  const Vec3 half(0.5, 0.5, 0.5);
  for (const double degrees : {0.02, 0.1, 0.5, 2.0, 10.0, 44.0})
    for (const bool on_a_box : {false, true}) {
      CAPTURE(degrees);
      CAPTURE(on_a_box);
      World world;
      world.add({.shape = {on_a_box ? Solid(Box{{5, 1, 5}}) : Solid(Plane{})},
                 .fixed = true,
                 .motion = {.pose = {.position = {0, on_a_box ? -1.0 : 0.0, 0}}}});
      Motion motion;
      motion.pose.rotation = Quat(Eigen::AngleAxisd(degrees * 3.14159265358979 / 180, Vec3(0.3, 0, 1).normalized()));
      motion.pose.position.y() = -lowest_corner({.pose = {.rotation = motion.pose.rotation}}, half);
      const BodyId box = world.add({.shape = {Box{half}}, .motion = motion});
      double deepest = 0;
      for (int step = 0; step < 300; ++step) {
        world.step(1.0 / 60);
        deepest = std::min(deepest, lowest_corner(world.motion(box), half));
      }
      CHECK(deepest > -2.5e-3);
      CHECK(std::abs(world.motion(box).pose.position.y() - 0.5) < 1e-3);
      CHECK(world.contacts().front().manifold.count == 4);
    }
}

TEST_CASE("what is moved from under a resting box leaves no contact behind") {
  World world;
  const BodyId floor =
      world.add({.shape = {Box{{5, 1, 5}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
  const BodyId box = world.add({.shape = {Box{{0.5, 0.5, 0.5}}}, .motion = {.pose = {.position = {0, 0.5, 0}}}});
  for (int step = 0; step < 30; ++step) world.step(1.0 / 60);
  REQUIRE(world.contacts().size() == 1);
  world.set_motion(floor, {.pose = {.position = {0, -1.0005, 0}}});
  const double before = world.motion(box).pose.position.y();
  for (int step = 0; step < 30; ++step) world.step(1.0 / 60);
  CHECK(world.motion(box).pose.position.y() - before < -2e-4);
  world.set_motion(floor, {.pose = {.position = {0, -3, 0}}});
  world.step(1.0 / 60);
  CHECK(world.contacts().empty());
}
