#include <tweenfall/physics/world.h>

#include <algorithm>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

World stack_of_ten(std::vector<BodyId>& boxes) {
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  world.add({.shape = {Plane{}}, .fixed = true});
  for (int i = 0; i < 10; ++i)
    boxes.push_back(world.add({.shape = {Box{{0.5, 0.5, 0.5}}},
                               .motion = {.pose = {.position = {0.01 * (i % 2), 0.5 + i, 0}}, .twist = {}}}));
  return world;
}

}  // namespace

TEST_CASE("steps of any two lengths in turn leave a stack of ten standing") {
  for (const double whole : {1.0 / 60, 1.0 / 240}) {
    for (const double sliver : {1e-12, 1e-9, 1e-7, 1e-5}) {
      CAPTURE(whole);
      CAPTURE(sliver);
      std::vector<BodyId> boxes;
      World world = stack_of_ten(boxes);
      std::vector<Vec3> start;
      for (int i = 0; i < 120; ++i) world.step(whole);
      for (const BodyId box : boxes) start.push_back(world.motion(box).pose.position);
      for (int i = 0; i < 60; ++i) {
        world.step(sliver);
        world.step(whole - 2 * sliver);
        world.step(sliver);
      }
      double moved = 0;
      for (std::size_t i = 0; i < boxes.size(); ++i)
        moved = std::max(moved, (world.motion(boxes[i]).pose.position - start[i]).norm());
      CHECK(moved < 5e-4);
    }
  }
}
