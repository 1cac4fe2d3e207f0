#include <tweenfall/physics/world.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

namespace {

constexpr double awake = std::numeric_limits<double>::infinity();

/// What a world holds after some steps, itself and the room that it works in.
struct Held {
  std::size_t bytes, bodies, pairs;
};

Held held_by(const std::vector<BodySettings>& bodies, int steps) {
  const std::size_t before = test::bytes_held();
  World world({.sleep_after = awake});
  for (const BodySettings& body : bodies) world.add(body);
  for (int i = 0; i < steps; ++i) world.step(1.0 / 60);
  return {test::bytes_held() - before, bodies.size(), world.contacts().size()};
}

BodySettings floor_of(double size) {
  return {.shape = {Box{{size, 1, size}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}};
}

/// Bodies in a row, apart or on top of each other four by four.
std::vector<BodySettings> rows_of(const Solid& solid, double height, bool stacked) {
  std::vector<BodySettings> bodies = {floor_of(3000)};
  bodies.reserve(1001);
  for (int i = 0; i < 1000; ++i) {
    BodySettings body{.shape = {solid}, .friction = 0.5};
    body.motion.pose.position = stacked ? Vec3(3 * (i / 4), height * (0.5 + i % 4), 0) : Vec3(3 * i, 1000, 0);
    bodies.push_back(body);
  }
  return bodies;
}

}  // namespace

TEST_CASE("a body and a touching pair take no more memory than is stated, in the state and in the room to work in") {
  for (const bool balls : {true, false}) {
    CAPTURE(balls);
    const Solid solid = balls ? Solid(Sphere{0.5}) : Solid(Box{Vec3(0.5, 0.5, 0.5)});
    const Held apart = held_by(rows_of(solid, 1, false), 4), stacked = held_by(rows_of(solid, 1, true), 4);
    REQUIRE(apart.pairs == 0);
    REQUIRE(stacked.pairs == 1000);
    const double by_body = static_cast<double>(apart.bytes) / static_cast<double>(apart.bodies);
    const double by_pair = static_cast<double>(stacked.bytes - apart.bytes) / static_cast<double>(stacked.pairs);
    MESSAGE(by_body << " bytes for each body, " << by_pair << " for each pair that touches");
    CHECK(by_body <= 2000);
    CHECK(by_pair <= (balls ? 3200 : 3400));
  }
}
