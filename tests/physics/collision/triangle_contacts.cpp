#include "physics/grounds.h"

namespace tweenfall::test::grounds {

TEST_CASE("what slides, rolls or lies on a flat floor of triangles does as on a plane") {
  test::Random random(3);
  const Shape even{TriangleMesh(flat_floor(8, 40))}, uneven{TriangleMesh(flat_floor(8, 40, &random))};
  const std::vector<double> zeros(81 * 81, 0.0);
  const Shape field{HeightField(81, zeros, 0.2, 0.2)};
  const Quat none(1, 0, 0, 0), turn = exp_map(Vec3(0, 0.3, 0)), lying = exp_map(Vec3(0, 0, test::pi / 2));
  const std::vector<Vec3> corners = {
      {-0.2, -0.1, -0.3}, {0.3, -0.1, -0.2}, {0.25, -0.1, 0.3}, {-0.3, -0.1, 0.2}, {0, 0.3, 0}};
  const Solid hull = Hull{ConvexHull(corners)};
  struct Case {
    const char* name;
    BodySettings body;
    double bound;
  };
  const Vec3 way(2.6, 0, 1.1);
  const std::vector<Case> cases = {
      {"a ball that rolls", sliding(Sphere{0.2}, {-4, 0.2, -3}, none, way, 0.8), 1e-6},
      {"a small ball that rolls", sliding(Sphere{0.03}, {-4, 0.03, -3}, none, way, 0.8), 1e-6},
      {"a ball that bounces", sliding(Sphere{0.2}, {-4, 1.2, -3}, none, way, 0.8), 1e-6},
      {"a box that slides", sliding(Box{{0.3, 0.1, 0.2}}, {-4, 0.1, -3}, turn, way, 0.3), 1e-4},
      {"a big box that slides", sliding(Box{{1, 0.3, 0.7}}, {-4, 0.3, -3}, turn, way, 0.3), 1e-4},
      {"a capsule that slides lying", sliding(Capsule{0.1, 0.3}, {-4, 0.1, -3}, turn * lying, way, 0.3), 1e-4},
      {"a cylinder that slides upright", sliding(Cylinder{0.3, 0.1}, {-4, 0.1, -3}, turn, way, 0.3), 1e-4},
      {"a hull that slides", sliding(hull, {-4, 0.1, -3}, turn, way, 0.3), 1e-4}};
  for (const Case& each : cases)
    for (const Shape& floor : {even, uneven, field}) {
      double turned = 0;
      const double away = away_from_plane(floor, each.body, 120, &turned);
      CAPTURE(std::string(each.name));
      CAPTURE(std::string(kind_name(floor.solid)));
      CHECK(away < each.bound);
      CHECK(turned < each.bound);
    }
}

TEST_CASE("a ball on a floor of triangles rolls on as the closed form says, and slides until it does") {
  // From sliding at v without spin a ball comes to roll at 5/7 v after 2 v / (7 mu g).
  World world(wide_awake());
  world.add({.shape = {TriangleMesh(flat_floor(20, 80))}, .friction = 1, .fixed = true});
  const BodyId ball = world.add(sliding(Sphere{0.15}, {-9, 0.15, -7}, Quat(1, 0, 0, 0), {3, 0, 2}, 0.09));
  for (int i = 0; i < 240; ++i) world.step(1.0 / 120);
  const Motion motion = world.motion(ball);
  CAPTURE((motion.twist.linear - Vec3(3, 0, 2) * 5 / 7).norm());
  CHECK(near(motion.twist.linear, Vec3(3, 0, 2) * 5 / 7, 5e-4));
  CHECK(near(motion.twist.angular, Vec3(0, 1, 0).cross(motion.twist.linear) / 0.15, 1e-3));
  CHECK(std::abs(motion.pose.position.y() - 0.15) < 1e-4);
}

TEST_CASE("a ball lies as deep in a mesh as its nearest triangle says") {
  const HeightField field = hills(9, 0.5, 0.6, 8);
  const SurfaceMesh mesh = field.surface();
  test::Random random(2);
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 center(random.between(-1.5, 1.5), random.between(0, 1), random.between(-1.5, 1.5));
    const std::optional<RayHit> above = cast_ray({field}, {}, center, {0, -1, 0});
    if (!above) continue;  // under the ground
    const double away = distance_to(mesh, center);
    const Manifold manifold = collide({field}, {}, {Sphere{0.15}}, placed_at(center), 0.01);
    CHECK((manifold.count > 0) == (away <= 0.16));
    if (manifold.count == 0) continue;
    ++touching;
    CHECK(near(manifold.points[0].penetration, 0.15 - away, 1e-9));
  }
  CHECK(touching > 300);
}

TEST_CASE("a shot at 300 m/s is stopped by a mesh and by a height field, whatever its shape") {
  const HeightField ground = hills(41, 0.25, 0.4, 12);
  const SurfaceMesh surface = ground.surface();
  test::Random random(31);
  for (const Shape& shape : {Shape{ground}, Shape{TriangleMesh(surface)}})
    for (const Solid& solid : one_of_each())
      for (int i = 0; i < 4; ++i) {
        World world(wide_awake());
        world.add({.shape = shape, .fixed = true});
        BodySettings body{.shape = {solid}, .mass = 1.0};
        body.motion.pose =
            placed_at({random.between(-2, 2), random.between(1, 6), random.between(-2, 2)}, random.rotation());
        body.motion.twist.linear = 300 * Vec3(random.between(-0.6, 0.6), -1, random.between(-0.6, 0.6)).normalized();
        if (i % 2 == 1) body.motion.twist.angular = random.vector(40);
        const BodyId id = world.add(body);
        bool under = false;
        for (int k = 0; k < 60; ++k) {
          world.step(1.0 / 60);
          const Vec3 p = world.motion(id).pose.position;
          const bool now = p.cwiseAbs().maxCoeff() < 4.9 && !cast_ray(shape, {}, p + Vec3(0, 0.05, 0), {0, -1, 0});
          under = under || now;
        }
        CAPTURE(std::string(kind_name(solid)));
        CAPTURE(std::string(kind_name(shape.solid)));
        CAPTURE(i);
        CHECK_FALSE(under);
      }
}

TEST_CASE("what rolls fast over a floor of a mesh is stopped by a wall of the same mesh") {
  SurfaceMesh hall = flat_floor(4, 16);
  const auto first = static_cast<std::uint32_t>(hall.positions.size());
  for (const double y : {0.0, 2.0})
    for (const double z : {-4.0, 4.0}) hall.positions.emplace_back(4, y, z);
  hall.triangles.insert(hall.triangles.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
  for (const Solid& solid : one_of_each()) {
    World world(wide_awake());
    world.add({.shape = {TriangleMesh(hall)}, .friction = 0, .fixed = true});
    const double low = -bounds({solid}, {}).low.y();
    const BodyId id = world.add(sliding(solid, {-1, low, 0.3}, Quat(1, 0, 0, 0), {120, 0, 0}, 0));
    double most = -10;
    for (int i = 0; i < 60; ++i) {
      world.step(1.0 / 60);
      most = std::max(most, world.motion(id).pose.position.x());
    }
    CAPTURE(std::string(kind_name(solid)));
    CHECK(most < 4.2);
    CHECK(most > 3.4);
    CHECK(world.motion(id).pose.position.x() < 4);
  }
}

TEST_CASE("what comes from behind a mesh passes, and what comes from the front does not") {
  for (const double from : {-1.0, 1.0}) {
    WorldSettings still = wide_awake();
    still.gravity = {0, 0, 0};
    World world(still);
    world.add({.shape = {TriangleMesh(flat_floor(3, 6))}, .fixed = true});
    BodySettings ball{.shape = {Sphere{0.2}}};
    ball.motion.pose.position = {0.1, from, 0.2};
    ball.motion.twist.linear = {0, -3 * from, 0};
    const BodyId id = world.add(ball);
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    CHECK(world.motion(id).pose.position.y() > (from > 0 ? 0.19 : 1.9));
  }
}

TEST_CASE("bodies of every shape come to rest on hills and stay above them") {
  const HeightField ground = hills(21, 0.4, 0.25, 9);
  for (const Shape& shape : {Shape{ground}, Shape{TriangleMesh(ground.surface())}}) {
    World world(wide_awake());
    world.add({.shape = shape, .friction = 0.9, .fixed = true});
    std::vector<BodyId> bodies;
    int number = 0;
    test::Random random(3);
    for (const Solid& solid : one_of_each())
      for (int i = 0; i < 3; ++i) {
        BodySettings body{.shape = {solid}, .friction = 0.9, .rolling_friction = 0.02};
        body.motion.pose = placed_at({-2.5 + 0.8 * (number % 7), 1.2, -1 + 0.8 * i}, random.rotation());
        bodies.push_back(world.add(body));
        ++number;
      }
    for (int i = 0; i < 600; ++i) world.step(1.0 / 120);
    for (const BodyId id : bodies) {
      const Motion motion = world.motion(id);
      CAPTURE(std::string(kind_name(world.shape(id).solid)));
      CHECK(motion.pose.position.y() > 0);
      CHECK(cast_ray(shape, {}, motion.pose.position, {0, -1, 0}).has_value());
      CHECK(motion.twist.linear.norm() < 0.05);
    }
    double deepest = 0;
    for (const Contact& contact : world.contacts())
      for (int i = 0; i < contact.manifold.count; ++i)
        deepest = std::max(deepest, contact.manifold.points[static_cast<std::size_t>(i)].penetration);
    CAPTURE(deepest);
    CHECK(deepest < 0.005);
  }
}

TEST_CASE("a ball that rolls over a mesh begins one contact, and keeps its number") {
  World world(wide_awake());
  world.add({.shape = {TriangleMesh(flat_floor(8, 40))}, .fixed = true});
  world.add(sliding(Sphere{0.2}, {-4, 0.3, -3}, Quat(1, 0, 0, 0), {3, 0, 1}, 0.5));
  int began = 0;
  for (int i = 0; i < 180; ++i) {
    world.step(1.0 / 60);
    for (const Contact& contact : world.contacts()) {
      began += contact.began ? 1 : 0;
      CHECK(contact.part_a == 0);
    }
  }
  CHECK(began == 1);
}

TEST_CASE("a compound stands on a mesh as on a plane, each part with its own contact") {
  std::vector<Shape> parts = {{Box{{0.6, 0.03, 0.4}}, placed_at({0, 0.72, 0})}};
  for (const double x : {-0.5, 0.5})
    for (const double z : {-0.3, 0.3}) parts.push_back({Box{{0.03, 0.345, 0.03}}, placed_at({x, 0.345, z})});
  for (const bool mesh_first : {true, false}) {
    World world(wide_awake());
    const BodySettings floor{.shape = {TriangleMesh(flat_floor(3, 31))}, .fixed = true};
    const BodySettings table{.shape = {Compound(parts)}};
    if (mesh_first) world.add(floor);
    const BodyId id = world.add(table);
    if (!mesh_first) world.add(floor);
    for (int i = 0; i < 300; ++i) world.step(1.0 / 60);
    CHECK(near(world.motion(id).pose.position, Vec3(0, 0, 0), 1e-3));
    REQUIRE(world.contacts().size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      const Contact& contact = world.contacts()[i];
      CHECK((mesh_first ? contact.part_b : contact.part_a) == i + 1);
      CHECK(contact.manifold.count == 4);
    }
  }
}

TEST_CASE("a turning mesh carries what stands on it") {
  World world(wide_awake());
  const BodyId disk = world.add({.shape = {TriangleMesh(flat_floor(2, 9))}, .friction = 1, .drive = Drive::keyed()});
  const BodyId box = world.add(sliding(Box{{0.1, 0.1, 0.1}}, {0.8, 0.1, 0}, Quat(1, 0, 0, 0), {0, 0, 0}, 1));
  for (int i = 1; i <= 240; ++i) {
    Motion target;
    const double speed = std::min(1.0, i / 120.0), angle = i <= 120 ? 0.5 * i * i / 120.0 / 120 : (i - 60) / 120.0;
    target.pose.rotation = exp_map(Vec3(0, angle, 0));
    target.twist.angular = {0, speed, 0};
    world.set_target(disk, target);
    world.step(1.0 / 120);
  }
  const Vec3 place = world.motion(box).pose.position;
  CHECK(near(place.norm(), Vec3(0.8, 0.1, 0).norm(), 5e-3));
  CHECK(near(world.motion(box).twist.angular, Vec3(0, 1, 0), 1e-2));
}

TEST_CASE("worlds with meshes are saved, loaded and stepped on with the same bits, on any number of threads") {
  const HeightField ground = hills(21, 0.4, 0.25, 9);
  World world;
  world.add({.shape = {ground}, .fixed = true});
  BodySettings second{.shape = {TriangleMesh(ball_of_triangles(0.7, 8))}, .fixed = true};
  second.motion.pose.position = {0, 0.2, 0};
  world.add(second);
  second.motion.pose.position = {1.5, 0.2, 1};
  world.add(second);
  test::Random random(3);
  for (const Solid& solid : one_of_each())
    for (int i = 0; i < 3; ++i) {
      BodySettings body{.shape = {solid}};
      body.motion.pose = placed_at(Vec3(0, 2.2, 0) + random.vector(1), random.rotation());
      world.add(body);
    }
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  const std::vector<std::byte> saved = world.save();
  WorldSettings three;
  three.threads = 3;
  World loaded(three), copy = world;
  loaded.load(saved);
  CHECK(loaded.state_hash() == world.state_hash());
  for (int i = 0; i < 60; ++i) {
    world.step(1.0 / 60);
    loaded.step(1.0 / 60);
    copy.step(1.0 / 60);
  }
  CHECK(loaded.state_hash() == world.state_hash());
  CHECK(copy.state_hash() == world.state_hash());
}

}  // namespace tweenfall::test::grounds
