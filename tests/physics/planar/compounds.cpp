#include <tweenfall/physics/planar_query.h>
#include <tweenfall/physics/world.h>

#include <cmath>
#include <limits>
#include <set>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double compound_step = 1.0 / 60, never_asleep = std::numeric_limits<double>::infinity();

/// A plate 2 m wide on two legs at its ends, its top 1 m above their feet; the node is between the feet.
planar::Compound flat_table() {
  return {{{planar::Box{Vec2(1, 0.1)}, Vec2(0, 0.9)},
           {planar::Box{Vec2(0.1, 0.4)}, Vec2(-0.9, 0.4)},
           {planar::Box{Vec2(0.1, 0.4)}, Vec2(0.9, 0.4)}}};
}

planar::Compound random_compound(Random& random) {
  planar::Compound compound;
  const int count = 2 + static_cast<int>(random.between(0, 3));
  for (int i = 0; i < count; ++i) {
    planar::Part part{planar::Circle{}, Vec2(random.between(-1, 1), random.between(-1, 1)), random.between(-3, 3)};
    const double a = random.between(0.1, 0.5), b = random.between(0.1, 0.5);
    if (i % 4 == 0) part.outline = planar::Circle{a};
    if (i % 4 == 1) part.outline = planar::Box{Vec2(a, b)};
    if (i % 4 == 2) part.outline = planar::Capsule{a, b};
    if (i % 4 == 3) part.outline.emplace<planar::Polygon>().corners = {Vec2(-a, -b), Vec2(b, -a), Vec2(0, a)};
    compound.parts.push_back(part);
  }
  return compound;
}

/// A part on its own, placed where its compound puts it.
planar::Shape alone(const planar::Part& part) {
  planar::Shape shape{.offset = part.offset, .angle = part.angle};
  std::visit([&](const auto& outline) { shape.outline = outline; }, part.outline);
  return shape;
}

void go(planar::World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step(compound_step);
}

}  // namespace

TEST_CASE("in a plane a compound has the mass, the center and the moment of its parts by the parallel-axis theorem") {
  // Two squares of side 1 with centers 3 m apart: each 1/6 + 1.5^2 of its mass.
  const planar::Compound pair{{{planar::Box{}, Vec2(-1, 0.5)}, {planar::Box{}, Vec2(2, 0.5), 0.7}}};
  CHECK(near(planar::area(pair), 2, 1e-15));
  const planar::MassProperties whole = planar::mass_properties({pair}, 4);
  CHECK(near(whole.center, Vec2(0.5, 0.5), 1e-15));
  CHECK(near(whole.moment, 4 * (1.0 / 6 + 2.25), 1e-14));
  // Two halves are the whole, wherever it is and however it is turned.
  const planar::Compound halves{
      {{planar::Box{Vec2(0.5, 0.25)}, Vec2(-0.5, 0)}, {planar::Box{Vec2(0.5, 0.25)}, Vec2(0.5, 0)}}};
  const planar::MassProperties made = planar::mass_properties({halves, Vec2(3, -2), 0.4}, 7);
  const planar::MassProperties wanted = planar::mass_properties({planar::Box{Vec2(1, 0.25)}, Vec2(3, -2), 0.4}, 7);
  CHECK(near(made.center, wanted.center, 1e-14));
  CHECK(near(made.moment, wanted.moment, 1e-14));
}

TEST_CASE(
    "in a plane a table stands on its two feet, which bear its load by the law of the lever, and things pass below") {
  planar::World world({.sleep_after = never_asleep});
  const BodyId ground = world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
  const BodyId stand = world.add({.shape = {flat_table()}, .mass = 10.0});
  const BodyId load =
      world.add({.shape = {planar::Box{Vec2(0.1, 0.1)}}, .mass = 5.0, .motion = {.position = Vec2(0.45, 1.1)}});
  // Below the plate there is room.
  const BodyId ball =
      world.add({.shape = {planar::Circle{0.2}}, .friction = 1, .motion = {.position = Vec2(-0.5, 0.2)}});
  go(world, 240);
  CHECK(near(world.motion(stand).position, Vec2(0, 0), 2e-3));
  CHECK(near(world.motion(ball).position, Vec2(-0.5, 0.2), 2e-3));
  double left = 0, right = 0, top = 0;
  std::set<std::uint32_t> feet;
  for (const planar::Contact& contact : world.contacts()) {
    if (contact.a == ground && contact.b == stand) {
      feet.insert(contact.part_b);
      (contact.part_b == 1 ? left : right) += contact.impulse / compound_step;
    }
    if (contact.a == stand && contact.b == load) {
      CHECK(contact.part_a == 0);
      top += contact.impulse / compound_step;
    }
  }
  CHECK(feet == std::set<std::uint32_t>{1, 2});
  CHECK(near(top, 5 * 9.81, 1e-4));
  // Each foot is 0.2 m wide and may carry anywhere on it: the load is exact about the middle of either only up to that.
  CHECK(near(left + right, 15 * 9.81, 1e-4));
  const double share = 5 * 9.81 * (0.9 - 0.45) / 1.8 + 5 * 9.81;
  CHECK(std::abs(left - share) < 15 * 9.81 * 0.1 / 1.6);
  // A blow rolls the ball against a leg, which stops it.
  world.apply_impulse(ball, Vec2(1.5 * world.mass(ball).mass, 0), world.motion(ball).position);
  go(world, 240);
  CHECK(world.motion(ball).position.x() < world.motion(stand).position.x() + 0.8 - 0.2 + 2e-3);
}

TEST_CASE("in a plane a compound that looks like one body moves like one") {
  const auto run = [](const planar::Shape& shape) {
    planar::World world({.sleep_after = never_asleep});
    world.add({.shape = {planar::HalfPlane{Vec2(0.2, 1)}}, .fixed = true});
    const BodyId body = world.add({.shape = shape,
                                   .mass = 2.0,
                                   .friction = 0.9,
                                   .motion = {.position = Vec2(-4, 3), .velocity = Vec2(1, 0), .spin = 1}});
    go(world, 45);
    return world.motion(body);
  };
  // Up to the first touch and in the air after it: later the order in which corners hit decides.
  const planar::Motion one = run({planar::Box{Vec2(1, 0.25)}});
  const planar::Motion two = run({planar::Compound{
      {{planar::Box{Vec2(0.5, 0.25)}, Vec2(-0.5, 0)}, {planar::Box{Vec2(0.5, 0.25)}, Vec2(0.5, 0)}}}});
  CHECK(near(two.position, one.position, 1e-9));
  CHECK(near(two.angle, one.angle, 1e-9));
  // Rolling on a circle with a lump: a compound of only that circle has the same bits.
  const planar::Motion circle = run({planar::Circle{0.5}}), single = run({planar::Compound{{{planar::Circle{0.5}}}}});
  CHECK(circle.position == single.position);
  CHECK(circle.angle == single.angle);
}

TEST_CASE("in a plane rays, moving shapes and distances meet a compound as they meet its nearest part") {
  Random random(21);
  int hits = 0, inside = 0;
  for (int n = 0; n < 2000; ++n) {
    const planar::Compound compound = random_compound(random), other = random_compound(random);
    const planar::Place place{Vec2(random.between(-1, 1), random.between(-1, 1)), random.between(-4, 4)};
    const planar::Place there{Vec2(random.between(-4, 4), random.between(-4, 4)), random.between(-4, 4)};
    const Vec2 from(random.between(-5, 5), random.between(-5, 5)), way(random.between(-1, 1), random.between(-1, 1));
    double first = never_asleep, apart = never_asleep, nearest = never_asleep, free = never_asleep;
    const planar::Shape ball{planar::Circle{0.2}};
    for (const planar::Part& part : compound.parts) {
      if (const auto hit = planar::cast_ray(alone(part), place, from, way)) first = std::min(first, hit->distance);
      if (const auto hit = planar::cast_shape(ball, {from, 0}, 6 * way, alone(part), place))
        free = std::min(free, hit->fraction);
      nearest = std::min(nearest, (planar::closest_point(alone(part), place, from) - from).norm());
      for (const planar::Part& its : other.parts)
        apart = std::min(apart, planar::distance(alone(part), place, alone(its), there).distance);
    }
    const auto hit = planar::cast_ray({compound}, place, from, way);
    REQUIRE(hit.has_value() == std::isfinite(first));
    if (hit) CHECK(hit->distance == first);
    const auto met = planar::cast_shape(ball, {from, 0}, 6 * way, {compound}, place);
    REQUIRE(met.has_value() == std::isfinite(free));
    if (met) CHECK(met->fraction == free);
    CHECK(planar::distance({compound}, place, {other}, there).distance == apart);
    CHECK(planar::overlapping({compound}, place, {other}, there) == (apart <= 0));
    CHECK(near((planar::closest_point({compound}, place, from) - from).norm(), nearest, 1e-15));
    // A world gives the same, about the center of mass.
    planar::World world;
    const BodyId body = world.add({.shape = {compound}, .fixed = true, .motion = {place.position, place.angle}});
    const auto seen = planar::cast_ray(world, from, way);
    REQUIRE(seen.has_value() == hit.has_value());
    if (seen) CHECK(near(seen->distance, first, 1e-12));
    CHECK(near((planar::closest_point(world, body, from) - from).norm(), nearest, 1e-12));
    hits += hit ? 1 : 0;
    inside += hit && hit->inside ? 1 : 0;
  }
  CHECK(hits > 150);
  CHECK(inside > 20);
}

TEST_CASE("in a plane nothing quick passes the thin parts of a compound, and a sensor tells it once") {
  planar::World world({.gravity = {0, 0}, .sleep_after = never_asleep});
  planar::Compound comb;
  for (int i = 0; i < 20; ++i) comb.parts.push_back({planar::Box{Vec2(0.01, 1)}, Vec2(0.5 * i, 0)});
  const BodyId wall = world.add({.shape = {comb}, .fixed = true});
  const BodyId gate =
      world.add({.shape = {planar::Compound{{{planar::Circle{1}, Vec2(-2, 0)}, {planar::Circle{1}, Vec2(-1.5, 0)}}}},
                 .sensor = true,
                 .fixed = true});
  const BodyId bullet = world.add({.shape = {planar::Circle{0.05}},
                                   .mass = 1.0,
                                   .motion = {.position = Vec2(-1.7, 0.2), .velocity = Vec2(300, 0)}});
  world.step(compound_step);
  CHECK(world.motion(bullet).position.x() < 0);
  REQUIRE(world.contacts().size() == 1);
  CHECK(world.contacts()[0].part_a == 0);
  CHECK(world.contacts()[0].a == wall);
  world.set_motion(bullet, {Vec2(-1.7, 0.2)});
  world.step(compound_step);
  REQUIRE(world.sensor_overlaps().size() == 1);
  CHECK(world.sensor_overlaps()[0].sensor == gate);
  CHECK(world.sensor_overlaps()[0].body == bullet);
}

TEST_CASE("in a plane a pair of compounds ends touching once, when the last of its parts has let go") {
  planar::World world({.sleep_after = never_asleep});
  const BodyId ground = world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
  const BodyId stand = world.add({.shape = {flat_table()}, .mass = 10.0});
  go(world, 60);
  CHECK(world.contacts().size() == 2);
  world.set_motion(stand, {Vec2(0, 2)});
  world.step(compound_step);
  REQUIRE(world.ended_contacts().size() == 1);
  CHECK(world.ended_contacts()[0].a == ground);
  CHECK(world.ended_contacts()[0].b == stand);
}

TEST_CASE("in a plane a heap of compounds keeps its bits in copies and in bytes, and comes to rest above the floor") {
  Random random(5);
  planar::World world;
  world.add({.shape = {planar::HalfPlane{}}, .fixed = true});
  std::vector<BodyId> bodies;
  for (int i = 0; i < 60; ++i)
    bodies.push_back(world.add({.shape = {random_compound(random)},
                                .motion = {Vec2(1.5 * (i % 6), 2 + 1.6 * (i / 6)), random.between(-3, 3)}}));
  go(world, 120);
  planar::World copy = world, loaded;
  loaded.load(world.save());
  for (planar::World* one : {&world, &copy, &loaded}) {
    one->remove(bodies[7]);
    go(*one, 480);
  }
  CHECK(copy.state_hash() == world.state_hash());
  CHECK(loaded.state_hash() == world.state_hash());
  for (const BodyId body : bodies) {
    if (!world.contains(body)) continue;
    CHECK(world.motion(body).position.y() > -1.5);
    CHECK(planar::distance(world.shape(body), {world.motion(body).position, world.motion(body).angle},
                           {planar::HalfPlane{Vec2(0, 1), -0.05}}, {})
              .distance > 0);
  }
}

TEST_CASE("in a plane compounds that cannot be are refused by their part, and a thousand at one point part") {
  using doctest::Contains;
  planar::World world;
  CHECK_THROWS_WITH_AS(world.add({.shape = {planar::Compound{}}}), Contains("1 to 4096 parts, but this one has 0"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add({.shape = {planar::Compound{{{planar::Box{}}, {planar::Circle{-1}}}}}}),
                       Contains("part 1 of a compound: radius of a circle must be positive"), std::invalid_argument);
  planar::Compound lost{{{planar::Box{}, Vec2(NAN, 0)}}};
  CHECK_THROWS_WITH_AS(world.add({.shape = {lost}}), Contains("part 0 of a compound: its place must be finite"),
                       std::invalid_argument);
  Random random(8);
  std::vector<BodyId> crowd;
  for (int i = 0; i < 1000; ++i) crowd.push_back(world.add({.shape = {random_compound(random)}}));
  go(world, 10);
  for (const BodyId body : crowd) REQUIRE(world.motion(body).position.allFinite());
}

TEST_CASE("in a plane a compound of space is cut part by part, and moves about its center of mass as it does there") {
  // A heavy ball and a light, flat box: their sections have their center of mass elsewhere.
  const Compound hammer({{Sphere{0.4}, {.position = Vec3(0, 1, 0)}}, {Box{Vec3(0.1, 0.8, 0.05)}, {}}});
  const auto run = [&](WorldPlane plane, const Solid& solid) {
    World world({.sleep_after = never_asleep, .plane = plane});
    BodySettings body{.shape = {solid, {.position = Vec3(0.3, -0.2, 0)}}};
    body.motion.twist = {Vec3(1, 5, 0), Vec3(0, 0, 4)};
    const BodyId id = world.add(body);
    for (int i = 0; i < 60; ++i) world.step(compound_step);
    return world.motion(id);
  };
  for (const Solid& solid : {Solid(hammer), Solid(Cone{0.5, 0.6})}) {
    const Motion flat = run(WorldPlane::xy, solid), space = run(WorldPlane::none, solid);
    CHECK(near(flat.pose.position, space.pose.position, 1e-9));
    CHECK(near(flat.pose.rotation, space.pose.rotation, 1e-9));
  }
  World world({.plane = WorldPlane::xy});
  world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings standing{.shape = {Compound({{Box{Vec3(1, 0.1, 0.5)}, {.position = Vec3(0, 0.9, 0)}},
                                            {Box{Vec3(0.1, 0.4, 0.5)}, {.position = Vec3(-0.9, 0.4, 0)}},
                                            {Box{Vec3(0.1, 0.4, 0.5)}, {.position = Vec3(0.9, 0.4, 0)}}})}};
  const BodyId stand = world.add(standing);
  for (int i = 0; i < 30; ++i) world.step(compound_step);
  std::set<std::uint32_t> feet;
  for (const Contact& contact : world.contacts()) feet.insert(contact.part_b);
  CHECK(feet == std::set<std::uint32_t>{1, 2});
  World copy;
  copy.load(world.save());
  for (World* one : {&world, &copy}) {
    one->apply_impulse(stand, Vec3(0, 40, 0), Vec3(0.5, 0.5, 0));
    for (int i = 0; i < 120; ++i) one->step(compound_step);
  }
  CHECK(world.state_hash() == copy.state_hash());
  BodySettings tilted{.shape = {Compound({{Sphere{}}, {Box{}, {.rotation = Quat(0.8, 0.6, 0, 0)}}})}};
  CHECK_THROWS_WITH_AS(world.add(tilted), doctest::Contains("part 1 of a compound: a box cannot be cut"),
                       std::invalid_argument);
}
