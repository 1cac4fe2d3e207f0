#include <tweenfall/physics/world.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

TEST_CASE("a step of what has settled, and asking where its bodies are, takes no memory") {
  for (const bool stacked : {true, false}) {
    CAPTURE(stacked);
    World world({.sleep_after = std::numeric_limits<double>::infinity()});
    world.add({.shape = {Box{{100, 1, 100}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    std::vector<BodyId> bodies;
    bodies.reserve(100);
    for (int i = 0; i < 100; ++i) {
      BodySettings body{.shape = {Box{{0.5, 0.5, 0.5}}}};
      body.motion.pose.position = stacked ? Vec3(3 * (i / 10), 0.5 + i % 10, 0) : Vec3(1.001 * i, 0.5, 0);
      bodies.push_back(world.add(body));
    }
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    const std::size_t before = test::allocations();
    double sum = 0;
    for (int i = 0; i < 60; ++i) {
      world.step(1.0 / 60);
      for (const BodyId body : bodies) sum += world.motion(body).pose.position.y() + world.twist(body).linear.norm();
    }
    CHECK(test::allocations() == before);
    CHECK(std::isfinite(sum));
    CHECK(world.contacts().size() >= 100);
  }
}
