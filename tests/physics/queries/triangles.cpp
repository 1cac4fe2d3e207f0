#include "physics/grounds.h"

namespace tweenfall::test::grounds {

TEST_CASE("distances, nearest points and rays of meshes are those of their triangles, one by one") {
  test::Random random(17);
  const HeightField field = hills(9, 0.5, 0.8, 4);
  const SurfaceMesh mesh = field.surface();
  const Pose pose = placed_at({0.3, -1, 2}, random.rotation());
  const Shape as_field{field}, as_mesh{TriangleMesh(mesh)};
  SurfaceMesh in_world = mesh;
  for (Vec3& position : in_world.positions) position = pose.position + pose.rotation * position;
  for (int i = 0; i < 300; ++i) {
    const Vec3 point = pose.position + random.vector(3);
    const double expected = distance_to(in_world, point);
    for (const Shape& shape : {as_field, as_mesh}) {
      CHECK(near((closest_point(shape, pose, point) - point).norm(), expected, 1e-12));
      CHECK(
          near(distance(shape, pose, {Sphere{0.1}}, placed_at(point)).distance, std::max(0.0, expected - 0.1), 1e-12));
    }
    const Vec3 to = pose.position + random.vector(2);
    const Vec3 along = to - point;
    double first = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < in_world.triangles.size(); k += 3) {
      const Vec3 &a = in_world.positions[in_world.triangles[k]], &b = in_world.positions[in_world.triangles[k + 1]],
                 &c = in_world.positions[in_world.triangles[k + 2]];
      Mat3 system;
      system << along, a - b, a - c;
      const Vec3 solved = system.inverse() * (a - point);
      if (along.dot((b - a).cross(c - a)) < 0 && solved.y() >= 0 && solved.z() >= 0 && solved.y() + solved.z() <= 1 &&
          solved.x() >= 0)
        first = std::min(first, solved.x() * along.norm());
    }
    for (const Shape& shape : {as_field, as_mesh}) {
      const std::optional<RayHit> hit = cast_ray(shape, pose, point, along);
      CHECK(hit.has_value() == std::isfinite(first));
      if (hit) CHECK(near(hit->distance, first, 1e-10));
    }
  }
}

TEST_CASE("no ray slips through between two triangles") {
  const Shape ball{TriangleMesh(ball_of_triangles(1, 12))}, floor{TriangleMesh(flat_floor(2, 8))};
  test::Random random(5);
  const SurfaceMesh mesh = ball_of_triangles(1, 12);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3 &a = mesh.positions[mesh.triangles[i]], &b = mesh.positions[mesh.triangles[i + 1]];
    const double share = random.between(0, 1);
    for (const Vec3& target : {a, Vec3(a + share * (b - a)), Vec3(0.5 * (a + b))})
      for (const double far : {3.0, 1e3, 1e6}) CHECK(cast_ray(ball, {}, far * target, -target).has_value());
  }
  for (int i = -8; i <= 8; ++i)
    for (int k = -8; k <= 8; ++k) {
      const Vec3 over(0.25 * i * 0.97, 1, 0.25 * k * 0.97);
      const std::optional<RayHit> hit = cast_ray(floor, {}, over, {0, -1, 0});
      REQUIRE(hit.has_value());
      CHECK(hit->distance == 1);
      CHECK(near(hit->normal, Vec3(0, 1, 0), 1e-15));
      CHECK_FALSE(cast_ray(floor, {}, -over, {0, 1, 0}).has_value());  // from behind
    }
}

TEST_CASE("a shape cast at a mesh stops where it first meets one of its triangles") {
  test::Random random(23);
  const HeightField field = hills(9, 0.5, 0.8, 6);
  const SurfaceMesh mesh = field.surface();
  const Shape as_mesh{TriangleMesh(mesh)};
  int hits = 0;
  for (const Solid& solid : one_of_each())
    for (int i = 0; i < 12; ++i) {
      const Pose start = placed_at(Vec3(random.between(-1.5, 1.5), 2.5, random.between(-1.5, 1.5)), random.rotation());
      const Vec3 way(random.between(-1, 1), -3, random.between(-1, 1));
      double first = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
        SurfaceMesh one;
        one.positions = {mesh.positions[mesh.triangles[k]], mesh.positions[mesh.triangles[k + 1]],
                         mesh.positions[mesh.triangles[k + 2]]};
        // Thickened, so that it is a hull.
        const Vec3 down =
            -(one.positions[1] - one.positions[0]).cross(one.positions[2] - one.positions[0]).normalized();
        for (int j = 0; j < 3; ++j) one.positions.push_back(one.positions[static_cast<std::size_t>(j)] + 1e-3 * down);
        if (const auto hit = cast_shape({solid}, start, way, {Hull{ConvexHull(one.positions)}}, {}))
          first = std::min(first, hit->fraction);
      }
      const std::optional<ShapeHit> hit = cast_shape({solid}, start, way, as_mesh, {});
      REQUIRE(hit.has_value() == std::isfinite(first));
      if (!hit) continue;
      ++hits;
      CHECK(near(hit->fraction, first, 1e-3));
      CHECK(hit->normal.dot(way) < 0);
      // The same, seen from the mesh.
      const std::optional<ShapeHit> turned = cast_shape(as_mesh, {}, -way, {solid}, start);
      REQUIRE(turned.has_value());
      CHECK(near(turned->fraction, hit->fraction, 1e-9));
      Pose there = start;
      there.position += (hit->fraction - 1e-6) * way;
      CHECK_FALSE(overlapping(as_mesh, {}, {solid}, there));
      for (int k = 0; k < 10; ++k)
        CHECK_FALSE(overlapping(as_mesh, {}, {solid},
                                placed_at(start.position + 0.1 * k * (hit->fraction - 1e-6) * way, start.rotation)));
      there.position += 1e-4 * way;
      CHECK(overlapping({field}, {}, {solid}, there));
    }
  CHECK(hits > 60);
}

TEST_CASE("a compound that is cast stops where its first part does") {
  // The lower part passes beside the box, the upper one meets it.
  const Compound two({{Sphere{0.1}, placed_at({0, -0.3, 0})}, {Sphere{0.1}, placed_at({0, 0.3, 0})}});
  const std::optional<ShapeHit> hit =
      cast_shape({two}, placed_at({-2, 0, 0}), {4, 0, 0}, {Box{{0.1, 0.1, 0.1}}}, placed_at({0, 0.3, 0}));
  REQUIRE(hit.has_value());
  CHECK(near(hit->fraction, 1.8 / 4, 1e-9));
  const std::optional<ShapeHit> other =
      cast_shape({Sphere{0.1}}, placed_at({-2, -0.3, 0}), {4, 0, 0}, {two}, placed_at({0, 0, 0}));
  REQUIRE(other.has_value());
  CHECK(near(other->fraction, 1.8 / 4, 1e-9));
}

}  // namespace tweenfall::test::grounds
