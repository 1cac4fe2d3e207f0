#include "state/ignored_pairs.h"

#include <tweenfall/physics/world.h>

#include <set>

#include "support.h"

using namespace tweenfall;

namespace {

BodySettings ball_at(double x, double y) {
  BodySettings ball;
  ball.shape.solid = Sphere{0.5};
  ball.mass = 1;
  ball.motion.pose.position = Vec3(x, y, 0);
  return ball;
}

BodySettings ground() {
  return {.shape = {Box{Vec3(20, 1, 20)}}, .fixed = true, .motion = {.pose = {.position = Vec3(0, -1, 0)}}};
}

void run_for(World& world, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 120); ++i) world.step(1.0 / 120);
}

double height(const World& world, BodyId body) {
  return world.motion(body).pose.position.y();
}

}  // namespace

TEST_CASE("two bodies meet when each collides with a group of the other, and never else") {
  struct Case {
    std::uint64_t groups, with, floor_groups, floor_with;
    bool meet;
  };
  const std::uint64_t all = ~std::uint64_t{0}, last = std::uint64_t{1} << 63;
  for (const Case& c : {Case{1, all, 1, all, true}, Case{2, 1, 1, 2, true}, Case{2, 1, 1, 4, false},
                        Case{2, 4, 1, 2, false}, Case{6, 1, 1, 4, true}, Case{0, all, 1, all, false},
                        Case{1, 0, 1, all, false}, Case{last, last, last, last, true}, Case{last, 1, 1, all, true}}) {
    for (const bool plane : {false, true}) {
      CAPTURE(c.groups);
      CAPTURE(plane);
      World world;
      BodySettings floor = ground();
      if (plane) floor = {.shape = {Plane{}}, .fixed = true};
      floor.groups = c.floor_groups;
      floor.collides_with = c.floor_with;
      BodySettings ball = ball_at(0, 0.6);
      ball.groups = c.groups;
      ball.collides_with = c.with;
      const BodyId on = world.add(floor), body = world.add(ball);
      CHECK(world.collides(on, body) == c.meet);
      CHECK(world.collides(body, on) == c.meet);
      run_for(world, 1);
      CHECK((height(world, body) > 0.49) == c.meet);
      CHECK(world.contacts().empty() == !c.meet);
    }
  }
}

TEST_CASE("what falls through nothing but the body that it ignores falls as if that were not there") {
  World world, alone;
  const BodyId shelf =
      world.add({.shape = {Box{Vec3(2, 0.1, 2)}}, .fixed = true, .motion = {.pose = {.position = Vec3(0, 3, 0)}}});
  world.add(ground());
  alone.add(ground());
  const BodyId through = world.add(ball_at(0, 4)), other = world.add(ball_at(1.5, 4));
  const BodyId twin = alone.add(ball_at(0, 4));
  world.ignore(through, shelf);
  CHECK(!world.collides(shelf, through));
  CHECK(world.collides(shelf, other));
  for (int i = 0; i < 240; ++i) {
    world.step(1.0 / 120);
    alone.step(1.0 / 120);
    CHECK(world.motion(through).pose.position == alone.motion(twin).pose.position);
  }
  CHECK(height(world, other) == doctest::Approx(3.6).epsilon(1e-3));
}

TEST_CASE("who sleeps on a body wakes when it is told to pass through it, and falls") {
  for (const bool by_groups : {false, true}) {
    CAPTURE(by_groups);
    World world;
    const BodyId shelf =
        world.add({.shape = {Box{Vec3(2, 0.1, 2)}}, .fixed = true, .motion = {.pose = {.position = Vec3(0, 3, 0)}}});
    world.add(ground());
    const BodyId below = world.add(ball_at(0, 3.6)), above = world.add(ball_at(0, 4.6));
    run_for(world, 2);
    REQUIRE(world.asleep(above));
    if (by_groups)
      world.set_groups(shelf, 0, 0);
    else
      world.ignore(shelf, below);
    run_for(world, 0.3);
    CHECK(!world.asleep(above));
    CHECK(height(world, below) < 3.4);
    run_for(world, 4);
    CHECK(height(world, below) == doctest::Approx(0.5).epsilon(1e-3));
    // Groups let both fall; with `ignore` one falls, and the other comes to lie on the shelf.
    CHECK((height(world, above) > 3) == !by_groups);
  }
}

TEST_CASE("bodies that lie in each other and meet again are taken apart slowly, asleep or not") {
  for (const bool sleeps : {false, true}) {
    for (const bool by_groups : {false, true}) {
      World world;
      world.add(ground());
      BodySettings ball = ball_at(0, 0.5);
      if (by_groups) ball.collides_with = 1;
      const BodyId a = world.add(ball);
      if (by_groups) ball.groups = 2;
      ball.motion.pose.position.x() = 0.9;
      const BodyId b = world.add(ball);
      if (!by_groups) world.ignore(b, a);
      run_for(world, sleeps ? 2 : 0.1);
      REQUIRE(world.asleep(a) == sleeps);
      if (by_groups)
        world.set_groups(b, 1, 1);
      else
        world.collide(a, b);
      CHECK(world.collides(a, b));
      double fastest = 0;
      for (int i = 0; i < 120; ++i) {
        world.step(1.0 / 120);
        fastest = std::max({fastest, world.twist(a).linear.norm(), world.twist(b).linear.norm()});
      }
      CHECK((world.motion(a).pose.position - world.motion(b).pose.position).norm() > 0.998);
      CHECK(fastest < 0.5);
    }
  }
}

TEST_CASE("a fixed body that is told to meet what sleeps in it wakes it") {
  World world;
  world.add(ground());
  BodySettings block{
      .shape = {Box{Vec3(0.5, 0.5, 0.5)}}, .fixed = true, .motion = {.pose = {.position = Vec3(0.9, 0.5, 0)}}};
  block.groups = 0;
  const BodyId in_the_way = world.add(block), ball = world.add(ball_at(0, 0.5));
  run_for(world, 2);
  REQUIRE(world.asleep(ball));
  world.set_groups(in_the_way, 1, 1);
  world.step(1.0 / 120);
  CHECK(!world.asleep(ball));
  run_for(world, 1);
  CHECK(world.motion(ball).pose.position.x() < -0.09);
}

TEST_CASE("bodies that pass through each other share no island: one sleeps while the other moves in it") {
  World world;
  world.add(ground());
  const BodyId still = world.add(ball_at(0, 0.5)), goes = world.add(ball_at(-8, 0.5));
  world.ignore(still, goes);
  run_for(world, 1);
  world.apply_impulse(goes, Vec3(8, 0, 0), world.motion(goes).pose.position);
  run_for(world, 3);
  CHECK(world.asleep(still));
  CHECK(world.motion(still).pose.position.x() == 0);
  CHECK(world.motion(goes).pose.position.x() > 5);
}

TEST_CASE("what is ignored is forgotten with the body, and a stale handle or twice the same body is refused") {
  World world;
  const BodyId a = world.add(ball_at(0, 0)), b = world.add(ball_at(5, 0));
  world.ignore(a, b);
  world.ignore(b, a);
  world.collide(a, b);
  CHECK(world.collides(a, b));
  world.ignore(a, b);
  world.remove(b);
  CHECK_THROWS_AS(world.ignore(a, b), std::invalid_argument);
  CHECK_THROWS_AS(world.collide(b, a), std::invalid_argument);
  CHECK_THROWS_AS((void)world.collides(a, b), std::invalid_argument);
  CHECK_THROWS_AS(world.set_groups(b, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(world.ignore(a, a), std::invalid_argument);
  CHECK_THROWS_AS(world.collide(a, a), std::invalid_argument);
  CHECK(!world.collides(a, a));
  const BodyId next = world.add(ball_at(5, 0));
  REQUIRE(next.index == b.index);
  CHECK(world.collides(a, next));
}

TEST_CASE("the hash of a world changes with what its bodies may meet, and a copy goes on the same") {
  World world;
  world.add(ground());
  const BodyId a = world.add(ball_at(0, 1)), b = world.add(ball_at(0.3, 2));
  std::set<std::uint64_t> hashes{world.state_hash()};
  world.ignore(a, b);
  hashes.insert(world.state_hash());
  world.set_groups(a, 3, 1);
  hashes.insert(world.state_hash());
  world.set_groups(a, 1, 3);
  hashes.insert(world.state_hash());
  CHECK(hashes.size() == 4);
  World copy = world;
  run_for(world, 2);
  run_for(copy, 2);
  CHECK(world.state_hash() == copy.state_hash());
  CHECK(std::abs(height(world, a) - height(world, b)) < 1e-3);
}

TEST_CASE("a pair that the caller ignores and others hold meets again when the last of them lets go") {
  state::IgnoredPairs pairs;
  CHECK(!pairs.contains(1, 2));
  CHECK(pairs.hold(2, 1));
  CHECK(!pairs.hold(1, 2));
  CHECK(!pairs.ask(1, 2, true));
  CHECK(!pairs.ask(1, 2, true));
  CHECK(!pairs.let_go(1, 2));
  CHECK(!pairs.ask(2, 1, false));
  CHECK(pairs.contains(2, 1));
  CHECK(pairs.let_go(2, 1));
  CHECK(!pairs.contains(1, 2));
  CHECK(!pairs.let_go(1, 2));
  CHECK(!pairs.ask(1, 2, false));
  CHECK(pairs.ask(4, 3, true));
  CHECK(pairs.hold(3, 5));
  pairs.remove(3);
  CHECK(pairs.all().empty());

  // Checked against a set, whatever the order.
  test::Random random(8);
  std::set<std::pair<std::uint32_t, std::uint32_t>> asked;
  for (int i = 0; i < 4000; ++i) {
    const auto a = static_cast<std::uint32_t>(random.bits() % 30), b = static_cast<std::uint32_t>(random.bits() % 30);
    if (a == b) continue;
    const std::pair key(std::min(a, b), std::max(a, b));
    const bool ignore = random.unit() < 0.5;
    CHECK(pairs.ask(a, b, ignore) == (asked.contains(key) != ignore));
    if (ignore)
      asked.insert(key);
    else
      asked.erase(key);
    CHECK(pairs.contains(a, b) == ignore);
  }
  CHECK(pairs.all().size() == asked.size());
}
