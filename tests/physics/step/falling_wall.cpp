#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

/// A wall of boxes, balls and capsules, one deep and slightly askew, that falls to a heap.
struct Wall {
  World world;
  std::vector<BodyId> bodies;

  explicit Wall(std::uint64_t seed) {
    world.add({.shape = {Plane{}}, .restitution = 0.1, .fixed = true});
    test::Random random(seed);
    const Solid solids[] = {Box{Vec3(0.4, 0.4, 0.4)}, Sphere{0.45}, Capsule{0.3, 0.25}, Box{Vec3(0.35, 0.35, 0.35)}};
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 10; ++column) {
        BodySettings body;
        body.shape.solid = solids[(row + column) % 4];
        body.mass = 1.0;
        body.restitution = 0.1 * static_cast<double>(1 + seed % 4);
        body.motion.pose.position = Vec3((column - 5) * 1.05, 0.6 + 1.05 * row, random.between(-0.05, 0.05));
        bodies.push_back(world.add(body));
      }
  }
};

}  // namespace

TEST_CASE("in a heap that rebounds, no body moves farther in a step than its speed can carry it") {
  constexpr double dt = 1.0 / 60;
  for (const std::uint64_t seed : {0u, 1u, 5u}) {
    Wall wall(seed);
    double most = 0;
    for (int step = 0; step < 120; ++step) {
      const World before = wall.world;
      wall.world.step(dt);
      for (const BodyId body : wall.bodies) {
        const double moved = (wall.world.motion(body).pose.position - before.motion(body).pose.position).norm();
        const double speed = std::max(before.twist(body).linear.norm(), wall.world.twist(body).linear.norm());
        most = std::max(most, moved - speed * dt);
      }
    }
    CAPTURE(seed);
    // What remains: speeds that a body has only within the step, and overlap that is being removed.
    CHECK(most < 0.05);
  }
}
