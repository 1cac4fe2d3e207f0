#include "physics/grounds.h"

namespace tweenfall::test::grounds {

TEST_CASE(
    "a mesh of triangles at random, crossing and doubled, keeps all that "
    "falls on it finite") {
  Random random(77);
  for (int round = 0; round < 6; ++round) {
    SurfaceMesh mesh;
    for (int i = 0; i < 60; ++i) mesh.positions.push_back(random.vector(2));
    for (int i = 0; i < 400; ++i) mesh.triangles.push_back(static_cast<std::uint32_t>(random.between(0, 59.999)));
    mesh.triangles.resize(399);
    for (int i = 0; i < 60; ++i) mesh.triangles.push_back(mesh.triangles[static_cast<std::size_t>(i)]);
    World world(wide_awake());
    world.add({.shape = {TriangleMesh(mesh)}, .fixed = true});
    std::vector<BodyId> bodies;
    for (const Solid& solid : one_of_each())
      for (int i = 0; i < 4; ++i) {
        BodySettings body{.shape = {solid}, .restitution = 0.5 * (i % 3)};
        body.motion.pose = placed_at(random.vector(2) + Vec3(0, 1, 0), random.rotation());
        body.motion.twist = {random.vector(20), random.vector(30)};
        bodies.push_back(world.add(body));
      }
    for (int i = 0; i < 240; ++i) world.step(i % 50 == 0 ? 0.1 : 1.0 / 60);
    for (const BodyId id : bodies) {
      CHECK(world.motion(id).pose.position.allFinite());
      CHECK(world.twist(id).linear.norm() < 300);
    }
  }
}

TEST_CASE("a ball and a box lie on a mesh of any size, wherever it is") {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const double far : {0.0, 1e4}) {
      SurfaceMesh mesh = flat_floor(3 * size, 7);
      const Vec3 place = far * size * Vec3(1, 0.5, -1);
      for (Vec3& position : mesh.positions) position += place;
      WorldSettings settings = wide_awake();
      settings.gravity = {0, -9.81 * size, 0};
      World world(settings);
      world.add({.shape = {TriangleMesh(mesh)}, .fixed = true});
      std::vector<BodyId> ids;
      for (const Solid& solid : {Solid{Sphere{0.2 * size}}, Solid{Box{Vec3::Constant(0.2 * size)}}}) {
        BodySettings body{.shape = {solid}};
        body.motion.pose.position = place + Vec3(ids.empty() ? -size : size, 0.2 * size, 0.3 * size);
        ids.push_back(world.add(body));
      }
      for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
      CAPTURE(size);
      CAPTURE(far);
      for (const BodyId id : ids)
        CHECK(std::abs(world.motion(id).pose.position.y() - place.y() - 0.2 * size) <
              2e-3 * std::max(1.0, size) + 0.003 * size);
    }
}

TEST_CASE(
    "a box that slides over the border of a floor of triangles tips over "
    "it and falls") {
  World world(wide_awake());
  world.add({.shape = {TriangleMesh(flat_floor(1, 5))}, .friction = 0.3, .fixed = true});
  const BodyId id = world.add(sliding(Box{{0.2, 0.2, 0.2}}, {0.5, 0.2, 0.1}, Quat(1, 0, 0, 0), {2.5, 0, 0}, 0.3));
  bool rose = false;
  for (int i = 0; i < 180; ++i) {
    world.step(1.0 / 60);
    rose = rose || world.motion(id).pose.position.y() > 0.3;
  }
  CHECK(world.motion(id).pose.position.y() < -1);
  CHECK_FALSE(rose);
}

TEST_CASE(
    "a box dropped on the ridge of a roof balances there with one "
    "contact that pushes up") {
  SurfaceMesh roof;
  roof.positions = {{0, 0, -1}, {0, 0, 1}, {-1, -1, -1}, {-1, -1, 1}, {1, -1, -1}, {1, -1, 1}};
  roof.triangles = {0, 2, 3, 0, 3, 1, 0, 1, 5, 0, 5, 4};
  const Shape shape{TriangleMesh(roof)};
  for (const double depth : {-0.001, 0.0005, 0.004}) {
    const Manifold manifold = collide(shape, {}, {Box{{0.3, 0.1, 0.3}}}, placed_at({0.05, 0.1 - depth, 0}), 0.002);
    CAPTURE(depth);
    REQUIRE(manifold.count >= 2);
    CHECK(near(manifold.normal, Vec3(0, 1, 0), 1e-6));
    for (int i = 0; i < manifold.count; ++i) {
      CHECK(near(manifold.points[static_cast<std::size_t>(i)].penetration, depth, 1e-9));
      CHECK(std::abs(manifold.points[static_cast<std::size_t>(i)].position.x()) < 1e-6);
    }
  }
}

}  // namespace tweenfall::test::grounds
