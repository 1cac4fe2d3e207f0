#include <tweenfall/physics/planar_world.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "processor_time.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Heaps, a keyed pusher, a driven body, joints, a sensor, sleepers.
planar::World busy_world() {
  Random random(7);
  planar::World world;
  world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
  const BodyId pusher =
      world.add({.shape = {planar::Box{Vec2(0.2, 1)}}, .drive = Drive::keyed(), .motion = {.position = Vec2(-3, 1)}});
  static_cast<void>(pusher);
  world.add(
      {.shape = {planar::Box{Vec2(2, 0.2)}}, .sensor = true, .fixed = true, .motion = {.position = Vec2(2, 0.5)}});
  std::vector<BodyId> bodies;
  for (int i = 0; i < 40; ++i) {
    planar::BodySettings body{.restitution = i % 5 == 0 ? 0.6 : 0,
                              .rolling_friction = i % 3 == 1 ? 0.05 : 0,
                              .linear_damping = i % 7 == 0 ? 0.1 : 0};
    const std::vector<planar::Shape> shapes{
        {planar::Box{Vec2(0.3, 0.2)}},
        {planar::Circle{0.25}},
        {planar::Polygon{{Vec2(0, 0), Vec2(0.5, 0), Vec2(0.2, 0.4)}}, Vec2(0.1, 0), 0.3},
        {planar::Compound{{{planar::Circle{0.2}, Vec2(-0.2, 0)}, {planar::Box{Vec2(0.3, 0.1)}, Vec2(0.1, 0)}}}}};
    body.shape = shapes[static_cast<std::size_t>(i % 10 == 9 ? 3 : i % 3)];
    body.motion = {Vec2(0.8 * (i % 8) - 2, 0.5 + 0.9 * (i / 8)), random.between(0, 6), Vec2(0, 0),
                   random.between(-3, 3)};
    if (i == 11) body.drive = {.hz = 2, .zeta = 0.7, .max_force = 500};
    bodies.push_back(world.add(body));
  }
  world.add_joint({.a = bodies[3], .b = bodies[4], .anchor_a = Vec2(0.3, 0), .kind = planar::Distance{{0.2, 1}}});
  world.add_joint({.a = bodies[4], .b = bodies[5], .kind = planar::Spring{0.5, 40, 1}});
  world.add_joint({.b = bodies[5],
                   .anchor_a = Vec2(2, 3),
                   .anchor_b = Vec2(0.1, 0),
                   .kind = planar::Hinge{Limits{-2, 2}, Motor{.speed = 1, .max_force = 5}}});
  world.add_joint({.a = bodies[6],
                   .b = bodies[7],
                   .kind = planar::Pulley{.pulley_a = Vec2(1, 6), .pulley_b = Vec2(4, 6), .ratio = 1.5}});
  world.add_joint({.a = bodies[9], .b = bodies[10], .kind = planar::Gear{-2}});
  world.add_joint(
      {.a = bodies[12],
       .b = bodies[13],
       .kind = planar::Wheel{.suspension = Limits{-0.2, 0.3}, .motor = Motor{.speed = 4, .max_force = 20}}});
  world.remove(bodies[20]);
  return world;
}

void drive_on(planar::World& world, int n) {
  const double t = (n + 1) / 60.0;
  world.set_target(world.bodies()[1], {Vec2(-3 + t, 1), 0, Vec2(1, 0), 0});
  world.step(1.0 / 60);
}

}  // namespace

TEST_CASE("in a plane a copy and what was saved and loaded step to the same bits") {
  planar::World world = busy_world();
  for (int i = 0; i < 150; ++i) drive_on(world, i);
  planar::World copy = world, loaded;
  const std::vector<std::byte> saved = world.save();
  loaded.load(saved);
  CHECK(loaded.save() == saved);
  CHECK(loaded.state_hash() == world.state_hash());
  for (int i = 150; i < 300; ++i) {
    for (planar::World* one : {&world, &copy, &loaded}) drive_on(*one, i);
    REQUIRE(copy.state_hash() == world.state_hash());
    REQUIRE(loaded.state_hash() == world.state_hash());
  }
  CHECK(copy.contacts().size() == world.contacts().size());
}

TEST_CASE(
    "in a plane contacts are told as the step left them, whatever is moved or removed before they are asked for") {
  planar::World world = busy_world();
  for (int i = 0; i < 120; ++i) drive_on(world, i);
  const std::vector<planar::Contact> told(world.contacts().begin(), world.contacts().end());
  REQUIRE(told.size() > 20);
  const auto same = [&](const planar::World& other) {
    const std::span<const planar::Contact> its = other.contacts();
    bool all = its.size() == told.size();
    for (std::size_t i = 0; all && i < told.size(); ++i) {
      const planar::Contact &one = told[i], &two = its[i];
      all = one.a == two.a && one.b == two.b && one.impulse == two.impulse && one.total_impulse == two.total_impulse &&
            one.began == two.began && one.approach_speed == two.approach_speed &&
            one.manifold.normal == two.manifold.normal && one.manifold.count == two.manifold.count;
      for (std::size_t n = 0; all && n < static_cast<std::size_t>(one.manifold.count); ++n)
        all = one.manifold.points[n].position == two.manifold.points[n].position &&
              one.manifold.points[n].penetration == two.manifold.points[n].penetration;
    }
    return all;
  };
  const BodyId touched = told[5].b;
  const std::vector<std::function<void(planar::World&)>> changes{
      [](planar::World&) {},
      [&](planar::World& its) { its.set_motion(touched, {.position = Vec2(5, 50), .angle = 1}); },
      [&](planar::World& its) { its.remove(touched); },
      [&](planar::World& its) { its.set_drive(touched, Drive::keyed()); },
      [&](planar::World& its) { its.apply_impulse(touched, Vec2(1, 2), Vec2(0, 0)); }};
  for (const auto& change : changes) {
    planar::World fresh = busy_world();
    for (int i = 0; i < 120; ++i) drive_on(fresh, i);
    change(fresh);
    const planar::World copy = fresh;
    CHECK(same(copy));
    CHECK(same(fresh));
    planar::World loaded;
    loaded.load(fresh.save());
    CHECK(same(loaded));
    // What has ended is told from them.
    fresh.step(1.0 / 60);
    loaded.step(1.0 / 60);
    CHECK(fresh.ended_contacts().size() == loaded.ended_contacts().size());
    CHECK(fresh.state_hash() == loaded.state_hash());
  }
}

TEST_CASE("in a plane what was found clear of each other is found again when it turns, or comes, into the way") {
  planar::World world({.gravity = {0, 0}, .sleep_after = INFINITY});
  world.add({.shape = {planar::Box{Vec2(0.2, 4)}}, .friction = 0, .fixed = true, .motion = {.position = Vec2(0.8, 0)}});
  // Its corner reaches the wall after asin(0.6 / sqrt(0.5)) - 45 degrees.
  const BodyId box = world.add(
      {.shape = {planar::Box{}}, .mass = 1.0, .friction = 0, .motion = {.position = Vec2(0, 0), .spin = 0.5}});
  const BodyId slow = world.add(
      {.shape = {planar::Circle{0.25}}, .mass = 1.0, .motion = {.position = Vec2(0, 1.5), .velocity = Vec2(0.1, 0)}});
  const double first = 2 * (std::asin(0.6 / std::sqrt(0.5)) - std::numbers::pi / 4), other = (0.6 - 0.25) / 0.1;
  double box_at = 0, slow_at = 0;
  for (int i = 1; i <= 600; ++i) {
    world.step(1.0 / 120);
    for (const planar::Contact& contact : world.contacts()) {
      double& at = contact.b == box ? box_at : slow_at;
      if (at == 0) at = i / 120.0;
    }
  }
  CHECK(std::abs(box_at - first) <= 2.0 / 120);
  CHECK(std::abs(slow_at - other) <= 2.0 / 120);
  CHECK(world.motion(slow).position.x() < 0.36);
}

TEST_CASE("in a plane bytes that were changed or cut are refused and change nothing") {
  planar::World world = busy_world();
  for (int i = 0; i < 20; ++i) drive_on(world, i);
  const std::vector<std::byte> saved = world.save();
  planar::World other = busy_world();
  const std::uint64_t before = other.state_hash();
  for (std::size_t i = 0; i < saved.size(); i += 97) {
    std::vector<std::byte> wrong = saved;
    wrong[i] ^= std::byte{0x10};
    CHECK_THROWS_AS(other.load(wrong), std::invalid_argument);
    CHECK_THROWS_AS(other.load(std::span(saved).first(i)), std::invalid_argument);
  }
  CHECK(other.state_hash() == before);
}

TEST_CASE("in a plane hostile numbers are refused in words, and stale handles too") {
  using doctest::Contains;
  planar::World world;
  CHECK_THROWS_WITH_AS(planar::World({.gravity = {NAN, 0}}), Contains("gravity must be finite"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(planar::World({.sub_steps = 0}), Contains("sub_steps must lie in 1 to 64"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add({.mass = 0.0}), Contains("mass must be positive"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add({.motion = {.position = Vec2(NAN, 0)}}), Contains("position of a body"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add({.shape = {planar::HalfPlane{}}}), Contains("half-plane has no mass"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add({.shape = {planar::Circle{1e-200}}, .mass = 1.0}), Contains("too small"),
                       std::invalid_argument);
  const BodyId body = world.add({});
  CHECK_THROWS_AS(world.apply_force(body, Vec2(INFINITY, 0), Vec2(0, 0)), std::invalid_argument);
  CHECK_THROWS_AS(world.step(0), std::invalid_argument);
  CHECK_THROWS_AS(world.step(NAN), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = body, .b = body}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = body, .kind = planar::Distance{{2, 1}}}), std::invalid_argument);
  world.remove(body);
  CHECK_THROWS_WITH_AS(static_cast<void>(world.motion(body)), Contains("it was removed"), std::invalid_argument);
  const BodyId next = world.add({});
  CHECK(next.index == body.index);
  CHECK(next != body);
}

TEST_CASE("in a plane what is no longer finite is named, and the world goes on without it") {
  planar::World world;
  const BodyId good = world.add({}), bad = world.add({.motion = {.position = Vec2(9, 0)}});
  world.apply_impulse(bad, Vec2(1e30, 0), Vec2(9, 0));
  world.apply_impulse(bad, Vec2(1e30, 0), Vec2(9, 0));
  world.apply_impulse(bad, Vec2(1e30, 0), Vec2(9, 0));
  for (int i = 0; i < 900; ++i) world.apply_impulse(bad, Vec2(1e30, 0), Vec2(9, 0));
  CHECK_THROWS_AS(world.step(1), NotFinite);
  CHECK_THROWS_AS(world.step(1), NotFinite);
  world.remove(bad);
  CHECK_NOTHROW(world.step(1));
  CHECK(std::isfinite(world.motion(good).position.y()));
}

TEST_CASE("in a plane thousands at one point part without end of time or NaN, and far out things still fall") {
  planar::World world({.gravity = {0, 0}});
  for (int i = 0; i < 600; ++i)
    world.add({.shape = i % 2 == 0 ? planar::Shape{planar::Circle{0.1}} : planar::Shape{planar::Box{Vec2(0.1, 0.1)}}});
  const double before = processor_seconds();
  for (int i = 0; i < 3; ++i) world.step(1.0 / 60);
  CHECK(processor_seconds() - before < 20);
  for (const BodyId body : world.bodies()) REQUIRE(world.motion(body).position.allFinite());
  planar::World far;
  far.add({.shape = {planar::Box{Vec2(5, 1)}}, .fixed = true, .motion = {.position = Vec2(1e8, -1)}});
  const BodyId box = far.add({.shape = {planar::Box{}}, .motion = {.position = Vec2(1e8, 0.5)}});
  for (int i = 0; i < 120; ++i) far.step(1.0 / 60);
  CHECK(near(far.motion(box).position.y(), 0.5, 1e-3));
  CHECK(near(far.motion(box).position.x(), 1e8, 1e-13));
}

TEST_CASE("in a plane a beam that bears many lies on a beam that bears many, whoever came first") {
  for (const bool beams_first : {true, false}) {
    CAPTURE(beams_first);
    planar::World world;
    world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
    BodyId top;
    const auto add_beams = [&] {
      world.add({.shape = {planar::Box{Vec2(11, 0.1)}}, .mass = 50, .motion = {.position = Vec2(5, 0.1)}});
      top = world.add({.shape = {planar::Box{Vec2(5, 0.1)}}, .mass = 50, .motion = {.position = Vec2(0, 0.3)}});
    };
    if (beams_first) add_beams();
    for (int i = 0; i < 70; ++i)
      for (const Vec2& on : {Vec2(-4.9, 0.45), Vec2(5.2, 0.25)})
        world.add({.shape = {planar::Circle{0.05}}, .mass = 0.1, .motion = {.position = on + Vec2(0.14 * i, 0)}});
    if (!beams_first) add_beams();
    for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
    CHECK((world.motion(top).position - Vec2(0, 0.3)).norm() < 5e-3);
  }
}
