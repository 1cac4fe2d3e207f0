#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

// What holds for bodies of a meter holds for those of a millimeter, where all lengths, gravity's too, are a
// thousandth.

TEST_CASE("a column in which every other ball is a thousand times as heavy stands, however small it is") {
  constexpr int height = 17;
  for (const double size : {1.0, 0.01, 0.001}) {
    CAPTURE(size);
    World world({.gravity = {0, -9.81 * size, 0}, .sleep_after = std::numeric_limits<double>::infinity()});
    world.add({.shape = {Plane{}}, .fixed = true});
    std::vector<BodyId> balls;
    for (int i = 0; i < height; ++i)
      balls.push_back(world.add({.shape = {Sphere{0.5 * size}},
                                 .density = i % 2 == 0 ? 1e6 : 1e3,
                                 .motion = {.pose = {.position = {0, (0.5 + i) * size, 0}}}}));
    for (int step = 0; step < 20; ++step) world.step(1.0 / 60);
    double below = -0.5 * size;
    for (const BodyId ball : balls) {
      const double place = world.motion(ball).pose.position.y();
      CHECK(place - below > 0.999 * size);
      below = place;
    }
  }
}
