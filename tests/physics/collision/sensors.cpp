#include <tweenfall/physics/query.h>
#include <tweenfall/physics/world.h>

#include <set>

#include "support.h"

using namespace tweenfall;

namespace {

BodySettings sensing(const Solid& solid, const Vec3& place) {
  BodySettings sensor;
  sensor.shape.solid = solid;
  sensor.fixed = true;
  sensor.sensor = true;
  sensor.motion.pose.position = place;
  return sensor;
}

BodySettings small_ball(const Vec3& place) {
  BodySettings ball;
  ball.shape.solid = Sphere{0.1};
  ball.motion.pose.position = place;
  return ball;
}

using IndexPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

IndexPairs pairs_in(std::span<const SensorOverlap> overlaps) {
  IndexPairs pairs;
  for (const SensorOverlap& overlap : overlaps) pairs.insert({overlap.sensor.index, overlap.body.index});
  return pairs;
}

}  // namespace

TEST_CASE("what falls through a sensor falls as if it were not there, begins once and ends once") {
  World world, alone;
  const BodyId sensor = world.add(sensing(Box{{1, 0.5, 1}}, {0, -2, 0}));
  const BodyId ball = world.add(small_ball({0, 0, 0})), twin = alone.add(small_ball({0, 0, 0}));
  CHECK(!world.collides(sensor, ball));
  int began = 0, ended = 0;
  for (int i = 0; i < 240; ++i) {
    world.step(1.0 / 240);
    alone.step(1.0 / 240);
    CHECK(world.motion(ball).pose.position == alone.motion(twin).pose.position);
    CHECK(world.contacts().empty());
    const double height = world.motion(ball).pose.position.y();
    const bool inside = height <= -1.4 && height >= -2.6;
    REQUIRE(world.sensor_overlaps().size() == (inside ? 1 : 0));
    if (inside) {
      CHECK(world.sensor_overlaps()[0].sensor == sensor);
      CHECK(world.sensor_overlaps()[0].body == ball);
      began += world.sensor_overlaps()[0].began ? 1 : 0;
    }
    for (const SensorOverlap& left : world.ended_sensor_overlaps()) {
      ++ended;
      CHECK(left.body == ball);
      CHECK(height < -2.6);
    }
  }
  CHECK(began == 1);
  CHECK(ended == 1);
  CHECK(world.reaction(sensor) == Vec3(0, 0, 0));
}

TEST_CASE("sensors report who sleeps in them, what is keyed, and what moves them; fixed ones no fixed bodies") {
  World world;
  const BodyId floor = world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId room = world.add(sensing(Box{{2, 2, 2}}, {0, 1, 0}));
  const BodyId ball = world.add(small_ball({0, 0.1, 0}));
  BodySettings door = small_ball({5, 0.5, 0});
  door.drive = Drive::keyed();
  const BodyId keyed = world.add(door);
  BodySettings falling = small_ball({0.5, 6, 0});
  falling.sensor = true;
  const BodyId probe = world.add(falling);
  for (int i = 0; i < 240; ++i) world.step(1.0 / 120);
  REQUIRE(world.asleep(ball));
  CHECK(pairs_in(world.sensor_overlaps()) == IndexPairs{{room.index, ball.index}, {probe.index, floor.index}});
  CHECK(!world.sensor_overlaps()[0].began);
  world.set_target(keyed, {.pose = {.position = Vec3(1, 0.5, 0)}});
  world.step(1.0 / 120);
  CHECK(pairs_in(world.sensor_overlaps()).contains({room.index, keyed.index}));
  CHECK(world.asleep(ball));
  // The sensor moves away: to where no one is.
  world.set_motion(room, {.pose = {.position = Vec3(50, 50, 0)}});
  world.step(1.0 / 120);
  CHECK(pairs_in(world.ended_sensor_overlaps()) == IndexPairs{{room.index, ball.index}, {room.index, keyed.index}});
  world.set_motion(room, {.pose = {.position = Vec3(0, 1, 0)}});
  world.step(1.0 / 120);
  CHECK(world.sensor_overlaps().size() == 3);
  // A removed body has left, and a removed sensor has no one in it.
  world.remove(ball);
  const BodyId other = world.add(small_ball({0, 0.1, 0.3}));
  REQUIRE(other.index == ball.index);
  world.step(1.0 / 120);
  REQUIRE(world.ended_sensor_overlaps().size() == 1);
  CHECK(world.ended_sensor_overlaps()[0].body == ball);
  CHECK(world.sensor_overlaps()[0].body == other);
  CHECK(world.sensor_overlaps()[0].began);
  world.remove(room);
  world.step(1.0 / 120);
  CHECK(world.ended_sensor_overlaps().size() == 2);
  world.step(1.0 / 120);
  CHECK(world.ended_sensor_overlaps().empty());
  CHECK(pairs_in(world.sensor_overlaps()) == IndexPairs{{probe.index, floor.index}});
}

TEST_CASE("sensors hold to groups and ignored pairs, do not see each other, and are asked for only by name") {
  World world({.gravity = Vec3(0, 0, 0)});
  BodySettings picky = sensing(Sphere{1}, {0, 0, 0});
  picky.collides_with = 2;
  const BodyId sensor = world.add(picky), second = world.add(sensing(Sphere{1}, {0.5, 0, 0}));
  const BodyId plain = world.add(small_ball({0, 0, 0}));
  BodySettings grouped = small_ball({0.4, 0, 0});
  grouped.groups = 2;
  const BodyId seen = world.add(grouped);
  world.ignore(second, plain);
  world.step(0.01);
  CHECK(pairs_in(world.sensor_overlaps()) == IndexPairs{{sensor.index, seen.index}, {second.index, seen.index}});
  CHECK(cast_ray(world, Vec3(-9, 0, 0), Vec3(1, 0, 0))->body == plain);
  CHECK(cast_ray(world, Vec3(-9, 0, 0), Vec3(1, 0, 0), 99, {.sensors = true})->body == sensor);
  // Half spaces sense too.
  const BodyId below = world.add(sensing(Plane{{0, 1, 0}, 0}, {0, 0, 0}));
  world.step(0.01);
  CHECK(pairs_in(world.sensor_overlaps()).contains({below.index, plain.index}));
  // All of this is part of a copy, and of saved bytes.
  World copy = world, loaded;
  loaded.load(world.save());
  for (World* each : {&world, &copy, &loaded}) each->step(0.01);
  CHECK(world.state_hash() == copy.state_hash());
  CHECK(world.state_hash() == loaded.state_hash());
  CHECK(pairs_in(loaded.sensor_overlaps()) == pairs_in(world.sensor_overlaps()));
}

TEST_CASE("a contact that ends is told once, by rising, by being ignored, and by losing a body") {
  World world;
  const BodyId floor = world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId ball = world.add(small_ball({0, 0.1, 0}));
  const auto pair_told = [&] {
    REQUIRE(world.ended_contacts().size() == 1);
    CHECK(world.ended_contacts()[0].a == floor);
    CHECK(world.ended_contacts()[0].b == ball);
  };
  world.step(0.01);
  REQUIRE(world.contacts().size() == 1);
  CHECK(world.contacts()[0].began);
  for (int i = 0; i < 300; ++i) {
    world.step(0.01);
    REQUIRE(world.contacts().size() == 1);
    CHECK(!world.contacts()[0].began);
    CHECK(world.ended_contacts().empty());
  }
  REQUIRE(world.asleep(ball));
  world.apply_impulse(ball, Vec3(0, 10 * world.mass(ball).mass, 0), world.motion(ball).pose.position);
  // In the step in which it rises it still touches.
  world.step(0.01);
  CHECK(world.contacts().size() == 1);
  world.step(0.01);
  pair_told();
  world.step(0.01);
  CHECK(world.ended_contacts().empty());
  world.set_motion(ball, {.pose = {.position = Vec3(0, 0.1, 0)}});
  world.step(0.01);
  REQUIRE(world.contacts().size() == 1);
  world.ignore(ball, floor);
  world.step(0.01);
  pair_told();
  world.collide(ball, floor);
  world.set_motion(ball, {.pose = {.position = Vec3(0, 0.1, 0)}});
  world.step(0.01);
  REQUIRE(world.contacts().size() == 1);
  world.remove(ball);
  CHECK(world.contacts().empty());
  CHECK(world.ended_contacts().empty());
  world.step(0.01);
  pair_told();
  world.step(0.01);
  CHECK(world.ended_contacts().empty());
}

TEST_CASE("two bodies that touched with several parts end one contact when one of them is removed") {
  std::vector<Shape> legs;
  for (const double x : {-0.3, 0.3})
    for (const double z : {-0.3, 0.3}) legs.push_back({Box{{0.05, 0.2, 0.05}}, {.position = Vec3(x, 0.2, z)}});
  World world;
  const BodyId floor = world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId stool = world.add({.shape = {Compound(legs)}});
  world.step(0.01);
  REQUIRE(world.contacts().size() == 4);
  world.remove(stool);
  world.step(0.01);
  REQUIRE(world.ended_contacts().size() == 1);
  CHECK(world.ended_contacts()[0].a == floor);
  CHECK(world.ended_contacts()[0].b == stool);
}

TEST_CASE("who began and did not end touches, step after step, in a heap that tumbles") {
  World world;
  test::Random random(6);
  world.add({.shape = {Plane{}}, .fixed = true});
  for (int i = 0; i < 40; ++i) {
    BodySettings body = small_ball(random.vector(0.4) + Vec3(0, 0.5 + 0.1 * i, 0));
    if (i % 2 == 0) body.shape.solid = Box{{0.1, 0.12, 0.08}};
    body.restitution = 0.5;
    world.add(body);
  }
  IndexPairs touching;
  std::size_t ended = 0;
  for (int i = 0; i < 400; ++i) {
    if (i % 50 == 49) world.remove(world.bodies()[5]);
    world.step(1.0 / 120);
    for (const EndedContact& end : world.ended_contacts()) {
      ++ended;
      CHECK(touching.erase({end.a.index, end.b.index}) == 1);
    }
    for (const Contact& contact : world.contacts())
      if (contact.began) CHECK(touching.insert({contact.a.index, contact.b.index}).second);
    IndexPairs now;
    for (const Contact& contact : world.contacts()) now.insert({contact.a.index, contact.b.index});
    CHECK(touching == now);
  }
  CHECK(ended > 20);
}
