#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

TEST_CASE("stacks of ten, twenty and forty boxes stand for a minute, and hardly lean") {
  for (const int height : {10, 20, 40}) {
    CAPTURE(height);
    World world({.sleep_after = std::numeric_limits<double>::infinity()});
    world.add({.shape = {Box{{100, 1, 100}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    std::vector<BodyId> boxes;
    for (int i = 0; i < height; ++i)
      boxes.push_back(world.add(
          {.shape = {Box{{0.5, 0.5, 0.5}}}, .friction = 0.6, .motion = {.pose = {.position = {0, 0.5 + i, 0}}}}));
    for (int step = 0; step < 3600; ++step) world.step(1.0 / 60);
    double off = 0;
    for (int i = 0; i < height; ++i) {
      const Vec3 place = world.motion(boxes[static_cast<std::size_t>(i)]).pose.position;
      off = std::max(off, std::hypot(place.x(), place.z()));
      // The lowest carry most; nowhere may they sink in.
      CHECK(place.y() > 0.5 + i - 0.01 * (i + 1));
    }
    CHECK(off < 1e-3);
  }
}
