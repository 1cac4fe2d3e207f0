#include <tweenfall/physics/world.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

namespace {

constexpr double awake = std::numeric_limits<double>::infinity();

/// The memory of a world after some steps: its state, which a copy takes along, and its working memory.
struct Held {
  std::size_t state, room, bodies, pairs;
};

Held held_by(const std::vector<BodySettings>& bodies, int steps) {
  const std::size_t before = test::bytes_held();
  World world({.sleep_after = awake});
  for (const BodySettings& body : bodies) world.add(body);
  for (int i = 0; i < steps; ++i) world.step(1.0 / 60);
  const std::size_t all = test::bytes_held() - before;
  const World copy = world;
  const std::size_t state = test::bytes_held() - before - all;
  return {state, all - state, bodies.size(), world.contacts().size()};
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

TEST_CASE("the state of a body and of a touching pair, and the room to work on them, take no more memory than stated") {
  for (const bool balls : {true, false}) {
    CAPTURE(balls);
    const Solid solid = balls ? Solid(Sphere{0.5}) : Solid(Box{Vec3(0.5, 0.5, 0.5)});
    const Held apart = held_by(rows_of(solid, 1, false), 4), stacked = held_by(rows_of(solid, 1, true), 4);
    REQUIRE(apart.pairs == 0);
    REQUIRE(stacked.pairs == 1000);
    const auto of_body = [&](std::size_t bytes) {
      return static_cast<double>(bytes) / static_cast<double>(apart.bodies);
    };
    const auto of_pair = [&](std::size_t with, std::size_t without) {
      return (static_cast<double>(with) - static_cast<double>(without)) / static_cast<double>(stacked.pairs);
    };
    MESSAGE(of_body(apart.state) << " bytes of state and " << of_body(apart.room) << " of room for each body, "
                                 << of_pair(stacked.state, apart.state) << " and " << of_pair(stacked.room, apart.room)
                                 << " for each pair that touches");
    CHECK(of_body(apart.state) <= 400);
    CHECK(of_body(apart.room) <= 1000);
    CHECK(of_pair(stacked.state, apart.state) <= (balls ? 180 : 500));
    CHECK(of_pair(stacked.room, apart.room) <= 2700);
  }
}

TEST_CASE("bodies that are alike share what they are made of, and those that are not have their own") {
  const auto bytes_of = [](int kinds) {
    World world;
    for (int i = 0; i < 1000; ++i) {
      BodySettings body{.shape = {Box{Vec3(0.5, 0.5, 0.5 + 0.001 * (i % kinds))}}};
      body.motion.pose.position = Vec3(3 * i, 0, 0);
      world.add(body);
    }
    const std::vector<std::byte> saved = world.save();
    World loaded;
    const std::size_t before = test::bytes_held();
    loaded.load(saved);
    CHECK(loaded.state_hash() == world.state_hash());
    for (const BodyId body : world.bodies()) {
      REQUIRE(loaded.mass(body).mass == world.mass(body).mass);
      REQUIRE(std::get<Box>(loaded.shape(body).solid).half_extents ==
              std::get<Box>(world.shape(body).solid).half_extents);
      REQUIRE(loaded.mass(body).mass == doctest::Approx(1000 * 8 * 0.25 * (0.5 + 0.001 * (body.index % kinds))));
    }
    return static_cast<double>(test::bytes_held() - before) / 1000;
  };
  const double alike = bytes_of(1), four = bytes_of(4), different = bytes_of(1000);
  MESSAGE(alike << ", " << four << " and " << different << " bytes for each body");
  CHECK(alike <= 400);
  CHECK(four <= 402);
  CHECK(different <= 900);
}
