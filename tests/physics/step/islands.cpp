#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

struct Yard {
  World world;
  std::vector<BodyId> stack;

  explicit Yard(int far_columns) {
    const BodyId floor =
        world.add({.shape = {Box{{500, 1, 500}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    static_cast<void>(floor);
    for (int i = 0; i < 8; ++i)
      stack.push_back(world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                                 .restitution = 0.2,
                                 .motion = {.pose = {.position = {0.04 * (i % 3), 0.55 + 1.1 * i, 0}}}}));
    for (int column = 0; column < far_columns; ++column)
      for (int i = 0; i < 5; ++i)
        world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                   .restitution = 0.2,
                   .motion = {.pose = {.position = {20.0 + 3 * column, 0.55 + 1.1 * i, 0.1 * column}}}});
  }
};

}  // namespace

TEST_CASE("what an island does depends on no other: far columns leave a stack's bits as they are") {
  Yard alone(0), crowded(30);
  for (int step = 0; step < 240; ++step) {
    alone.world.step(1.0 / 120);
    crowded.world.step(1.0 / 120);
    for (std::size_t i = 0; i < alone.stack.size(); ++i) {
      CAPTURE(step);
      CAPTURE(i);
      const Motion one = alone.world.motion(alone.stack[i]);
      const Motion other = crowded.world.motion(crowded.stack[i]);
      REQUIRE(one.pose.position == other.pose.position);
      REQUIRE(one.pose.rotation.coeffs() == other.pose.rotation.coeffs());
      REQUIRE(one.twist.linear == other.twist.linear);
      REQUIRE(one.twist.angular == other.twist.angular);
    }
  }
}
