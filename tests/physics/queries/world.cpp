#include "physics/queries/solids.h"

#include <atomic>
#include <map>
#include <thread>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A world in which bodies are added, removed, moved and stepped at random, with every query answered body by body.
struct Restless {
  World world;
  Random random;
  std::vector<BodyId> bodies;
  std::map<std::uint32_t, std::uint64_t> groups;  ///< by index

  explicit Restless(std::uint64_t seed) : random(seed) {
    groups[world.add({.shape = {Plane{{0, 1, 0}, -4}}, .fixed = true}).index] = 1;
    for (int i = 0; i < 60; ++i) add();
  }
  void add() {
    BodySettings body;
    body.shape = any_shape(random, std::pow(10, random.between(-1.5, 0.3)));
    body.motion.pose = any_pose(random, 5);
    body.motion.twist = {random.vector(5), random.vector(5)};
    body.groups = 1 + random.bits() % 7;
    body.fixed = random.unit() < 0.3;
    if (!body.fixed && random.unit() < 0.2) body.drive = Drive::keyed();
    bodies.push_back(world.add(body));
    groups[bodies.back().index] = body.groups;
  }
  void change() {
    const double what = random.unit();
    const std::size_t which = random.bits() % bodies.size();
    if (what < 0.3 && bodies.size() < 80) {
      add();
    } else if (what < 0.5 && bodies.size() > 20) {
      world.remove(bodies[which]);
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(which));
    } else if (what < 0.7) {
      world.set_motion(bodies[which], {.pose = any_pose(random, 5)});
    } else {
      world.step(1.0 / 60);
    }
  }
};

}  // namespace

TEST_CASE("what a world answers is what all of its bodies one by one give, right after any change") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Restless restless(seed);
    World& world = restless.world;
    Random& random = restless.random;
    int rays = 0, ways = 0, overlaps = 0;
    const int rounds = cases(1000) / 4;
    for (int round = 0; round < rounds; ++round) {
      CAPTURE(seed);
      CAPTURE(round);
      restless.change();
      const QueryFilter filter{.groups = random.unit() < 0.5 ? ~std::uint64_t{0} : random.bits() % 8,
                               .accept = random.unit() < 0.5 ? std::function<bool(BodyId)>()
                                                             : [](BodyId body) { return body.index % 3 != 0; }};
      std::vector<BodyId> asked = world.bodies();
      std::erase_if(asked, [&](BodyId body) {
        const bool in_group = (restless.groups.at(body.index) & filter.groups) != 0;
        return !in_group || (filter.accept && !filter.accept(body));
      });
      const Vec3 from = random.vector(6), way = random.vector(12);
      const double length = random.unit() < 0.5 ? without_end : random.between(0, 9);

      std::vector<BodyRayHit> all;
      for (const BodyId body : asked)
        if (const auto hit = cast_ray(world.shape(body), world.motion(body).pose, from, way, length))
          all.push_back({*hit, body});
      std::ranges::sort(all, [](const BodyRayHit& a, const BodyRayHit& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.body.index < b.body.index;
      });
      const std::vector<BodyRayHit> through = cast_ray_through(world, from, way, length, filter);
      REQUIRE(through.size() == all.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        CHECK(through[i].body == all[i].body);
        CHECK(through[i].distance == all[i].distance);
        CHECK(through[i].normal == all[i].normal);
      }
      const std::optional<BodyRayHit> first = cast_ray(world, from, way, length, filter);
      REQUIRE(first.has_value() == !all.empty());
      if (first) {
        ++rays;
        CHECK(first->body == all[0].body);
        CHECK(first->point == all[0].point);
      }

      const Shape shape = any_shape(random, 0.5);
      const Pose pose = any_pose(random, 6);
      std::vector<BodyId> over;
      std::optional<BodyShapeHit> soonest;
      std::optional<NearestBody> nearest;
      const double within = random.unit() < 0.3 ? without_end : random.between(0, 3);
      for (const BodyId body : asked) {
        const Pose at = world.motion(body).pose;
        if (overlapping(world.shape(body), at, shape, pose)) over.push_back(body);
        const auto hit = cast_shape(shape, pose, way, world.shape(body), at);
        if (hit && (!soonest || hit->fraction < soonest->fraction)) soonest = BodyShapeHit{*hit, body};
        const Vec3 closest = closest_point(world, body, from);
        const double away = distance({Sphere{1e-300}}, {.position = from}, world.shape(body), at).distance;
        if (away <= within && (!nearest || away < nearest->distance)) nearest = NearestBody{body, away, closest};
      }
      CHECK(overlapping(world, shape, pose, filter) == over);
      overlaps += static_cast<int>(over.size());
      const std::optional<BodyShapeHit> met = cast_shape(world, shape, pose, way, filter);
      REQUIRE(met.has_value() == soonest.has_value());
      if (met) {
        ++ways;
        CHECK(met->body == soonest->body);
        CHECK(met->fraction == soonest->fraction);
        CHECK(met->normal == soonest->normal);
      }
      const std::optional<NearestBody> found = nearest_body(world, from, within, filter);
      REQUIRE(found.has_value() == nearest.has_value());
      if (found) {
        CHECK(found->distance == doctest::Approx(nearest->distance).epsilon(1e-12));
        if (found->distance > 0) CHECK(found->body == nearest->body);
        if (found->distance > 0) CHECK(found->point == nearest->point);
      }
    }
    CHECK(rays > rounds / 10);
    CHECK(ways > rounds / 5);
    CHECK(overlaps > rounds / 10);
  }
}

TEST_CASE("asking changes no bit of a world, and an empty one has no answers") {
  Restless asked(9), left(9);
  for (int i = 0; i < 60; ++i) {
    (void)cast_ray(asked.world, Vec3(0, 5, 0), Vec3(0, -1, 0));
    (void)overlapping(asked.world, {Sphere{2}}, {});
    asked.world.step(1.0 / 60);
    left.world.step(1.0 / 60);
    CHECK(asked.world.state_hash() == left.world.state_hash());
  }
  const World empty;
  CHECK(!cast_ray(empty, Vec3(0, 0, 0), Vec3(1, 0, 0)).has_value());
  CHECK(cast_ray_through(empty, Vec3(0, 0, 0), Vec3(1, 0, 0)).empty());
  CHECK(!cast_shape(empty, {Sphere{1}}, {}, Vec3(1, 0, 0)).has_value());
  CHECK(overlapping(empty, {Sphere{1}}, {}).empty());
  CHECK(!nearest_body(empty, Vec3(0, 0, 0)).has_value());
}

TEST_CASE("a world answers several threads at once, a field in its midst, and a copy for itself") {
  Restless restless(11);
  World& world = restless.world;
  std::atomic<int> hits = 0;
  const auto ask = [&] {
    for (int i = 0; i < 200; ++i)
      if (cast_ray(world, Vec3(0.01 * i - 1, 9, 0), Vec3(0, -1, 0))) ++hits;
  };
  for (int round = 0; round < 5; ++round) {
    std::thread one(ask), two(ask);
    one.join();
    two.join();
    world.step(1.0 / 60);
  }
  CHECK(hits == 2000);
  const World copy = world;
  world.set_motion(restless.bodies[0], {.pose = {.position = Vec3(0, 50, 0)}});
  CHECK(nearest_body(world, Vec3(0, 60, 0))->body == restless.bodies[0]);
  CHECK(nearest_body(copy, Vec3(0, 60, 0))->distance > 40);
  // Another body of the same index at the same place.
  World first, second;
  first.add({.shape = {Sphere{1}}, .fixed = true});
  second.add({.shape = {Sphere{2}}, .fixed = true});
  CHECK(cast_ray(first, Vec3(0, 9, 0), Vec3(0, -1, 0))->distance == 8);
  first = second;
  CHECK(cast_ray(first, Vec3(0, 9, 0), Vec3(0, -1, 0))->distance == 7);
  int answers = 0;
  World falling;
  falling.add({.shape = {Plane{}}, .fixed = true});
  const BodyId ball = falling.add({.shape = {Sphere{0.5}}, .motion = {.pose = {.position = Vec3(0, 5, 0)}}});
  falling.add_force(Field([&](double, const Vec3&, const Vec3&, double) {
    if (cast_ray(falling, Vec3(0, 9, 0), Vec3(0, -1, 0))->body == ball) ++answers;
    return Vec3(0, 0, 0);
  }));
  for (int i = 0; i < 20; ++i) {
    falling.step(1.0 / 60);
    CHECK(cast_ray(falling, Vec3(0, 9, 0), Vec3(0, -1, 0))->distance ==
          9 - falling.motion(ball).pose.position.y() - 0.5);
  }
  CHECK(answers > 0);
}

TEST_CASE("questions that are none are refused") {
  World world;
  const BodyId body = world.add({});
  const double none = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)cast_ray(world, Vec3(0, 0, 0), Vec3(0, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_ray_through(world, Vec3(0, 0, 0), Vec3(0, none, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)cast_shape(world, {Plane{}}, {}, Vec3(0, 1, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)overlapping(world, {Plane{}}, {}), std::invalid_argument);
  CHECK_THROWS_AS((void)overlapping(world, {Sphere{1}}, {.rotation = Quat(2, 0, 0, 0)}), std::invalid_argument);
  CHECK_THROWS_AS((void)nearest_body(world, Vec3(0, 0, 0), -1), std::invalid_argument);
  CHECK_THROWS_AS((void)nearest_body(world, Vec3(none, 0, 0)), std::invalid_argument);
  world.remove(body);
  CHECK_THROWS_AS((void)closest_point(world, body, Vec3(0, 0, 0)), std::invalid_argument);
}

TEST_CASE("a ray through a hundred thousand bodies looks at few of them") {
  World world;
  Random random(3);
  for (int i = 0; i < 100000; ++i)
    world.add({.shape = {Sphere{0.1}}, .fixed = true, .motion = {.pose = {.position = random.vector(100)}}});
  int seen = 0;
  const QueryFilter counting{.accept = [&](BodyId) {
    ++seen;
    return true;
  }};
  int hits = 0;
  for (int i = 0; i < 100; ++i)
    if (cast_ray(world, random.vector(100), random.vector(1), without_end, counting)) ++hits;
  CHECK(hits > 0);
  // About thirty balls in a cylinder as wide as their boxes would be hit by a ray without an end.
  CHECK(seen < 100 * 40);
}
