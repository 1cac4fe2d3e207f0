#include "physics/queries/solids.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A solid as corners, edges and triangles with a skin: what brute force needs.
struct Framework {
  std::vector<Vec3> corners;
  std::vector<std::pair<Vec3, Vec3>> edges;
  std::vector<std::array<Vec3, 3>> triangles;
  double skin = 0;
};

Framework framework_of(const Shape& shape, const Pose& node) {
  Framework frame;
  const Quat rotation = node.rotation * shape.offset.rotation;
  const auto placed = [&](const Vec3& local) -> Vec3 {
    return node.position + node.rotation * shape.offset.position + rotation * local;
  };
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) {
    frame.skin = sphere->radius;
    frame.corners = {placed(Vec3(0, 0, 0))};
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    frame.skin = capsule->radius;
    frame.corners = {placed(Vec3(0, capsule->half_height, 0)), placed(Vec3(0, -capsule->half_height, 0))};
    frame.edges = {{frame.corners[0], frame.corners[1]}};
  } else {
    std::vector<Vec3> points;
    if (const auto* box = std::get_if<Box>(&shape.solid))
      for (int i = 0; i < 8; ++i)
        points.emplace_back(box->half_extents.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    const ConvexHull hull = points.empty() ? std::get<Hull>(shape.solid).convex : ConvexHull(points);
    for (const Vec3& vertex : hull.vertices()) frame.corners.push_back(placed(vertex));
    for (const ConvexHull::Edge& edge : hull.edges())
      frame.edges.emplace_back(frame.corners[edge.from], frame.corners[edge.to]);
    for (const ConvexHull::Face& face : hull.faces()) {
      const auto corners = hull.corners(face);
      for (std::size_t i = 2; i < corners.size(); ++i)
        frame.triangles.push_back(
            {frame.corners[corners[0]], frame.corners[corners[i - 1]], frame.corners[corners[i]]});
    }
  }
  return frame;
}

double over_triangle(const Vec3& point, const std::array<Vec3, 3>& triangle) {
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  for (std::size_t i = 0; i < 3; ++i)
    if (normal.cross(triangle[(i + 1) % 3] - triangle[i]).dot(point - triangle[i]) < 0)
      return std::numeric_limits<double>::infinity();
  return std::abs(normal.dot(point - triangle[0]));
}

double to_edge(const Vec3& point, const std::pair<Vec3, Vec3>& edge) {
  const Vec3 along = edge.second - edge.first;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp(along.dot(point - edge.first) / square, 0.0, 1.0) : 0;
  return (point - edge.first - share * along).norm();
}

double between_lines(const std::pair<Vec3, Vec3>& a, const std::pair<Vec3, Vec3>& b) {
  const Vec3 along_a = a.second - a.first, along_b = b.second - b.first, apart = b.first - a.first;
  const Vec3 across = along_a.cross(along_b);
  const double square = across.squaredNorm();
  if (!(square > 1e-20 * along_a.squaredNorm() * along_b.squaredNorm())) return std::numeric_limits<double>::infinity();
  const double on_a = apart.cross(along_b).dot(across) / square, on_b = apart.cross(along_a).dot(across) / square;
  if (on_a < 0 || on_a > 1 || on_b < 0 || on_b > 1) return std::numeric_limits<double>::infinity();
  return std::abs(apart.dot(across)) / std::sqrt(square);
}

/// The least distance of all corners, edges and faces; only for frameworks that do not overlap.
double counted_out(const Framework& a, const Framework& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Vec3& corner : from->corners) {
      for (const Vec3& other : to->corners) least = std::min(least, (corner - other).norm());
      for (const auto& edge : to->edges) least = std::min(least, to_edge(corner, edge));
      for (const auto& triangle : to->triangles) least = std::min(least, over_triangle(corner, triangle));
    }
  for (const auto& edge : a.edges)
    for (const auto& other : b.edges) least = std::min(least, between_lines(edge, other));
  return least - a.skin - b.skin;
}

bool meets_triangle(const std::pair<Vec3, Vec3>& edge, const std::array<Vec3, 3>& triangle) {
  const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a);
  };
  if (side(triangle[0], triangle[1], triangle[2], edge.first) *
          side(triangle[0], triangle[1], triangle[2], edge.second) >
      0)
    return false;
  const double first = side(edge.first, edge.second, triangle[0], triangle[1]);
  const double second = side(edge.first, edge.second, triangle[1], triangle[2]);
  const double third = side(edge.first, edge.second, triangle[2], triangle[0]);
  return (first >= 0 && second >= 0 && third >= 0) || (first <= 0 && second <= 0 && third <= 0);
}

/// Whether cores overlap: a corner of one in the other, or an edge through a face.
bool cores_cross(const Shape& shape_a, const Pose& pose_a, const Framework& a, const Shape& shape_b, const Pose& pose_b,
                 const Framework& b) {
  const auto solid = [](const Framework& frame) { return !frame.triangles.empty(); };
  if (solid(b) && std::ranges::any_of(a.corners, [&](const Vec3& at) { return height_over(shape_b, pose_b, at) <= 0; }))
    return true;
  if (solid(a) && std::ranges::any_of(b.corners, [&](const Vec3& at) { return height_over(shape_a, pose_a, at) <= 0; }))
    return true;
  for (const auto& edge : a.edges)
    for (const auto& triangle : b.triangles)
      if (meets_triangle(edge, triangle)) return true;
  for (const auto& edge : b.edges)
    for (const auto& triangle : a.triangles)
      if (meets_triangle(edge, triangle)) return true;
  return false;
}

}  // namespace

TEST_CASE("distances of simple pairs are their closed forms, with the points where they are") {
  const auto at = [](double x, double y, double z) { return Pose{.position = Vec3(x, y, z)}; };
  const Separation balls = distance({Sphere{1}}, at(0, 0, 0), {Sphere{2}}, at(3, 4, 0));
  CHECK(balls.distance == doctest::Approx(2).epsilon(1e-15));
  CHECK(near(balls.on_a, Vec3(0.6, 0.8, 0), 1e-15));
  CHECK(near(balls.on_b, Vec3(1.8, 2.4, 0), 1e-15));
  const Separation corners = distance({Box{{1, 1, 1}}}, at(0, 0, 0), {Box{{1, 1, 1}}}, at(3, 4, 2.5));
  CHECK(corners.distance == doctest::Approx(std::sqrt(1 + 4 + 0.25)).epsilon(1e-15));
  CHECK(near(corners.on_a, Vec3(1, 1, 1), 1e-15));
  CHECK(near(corners.on_b, Vec3(2, 3, 1.5), 1e-15));
  const Separation plane = distance({Capsule{0.5, 1}}, at(7, 3, -2), {Plane{{0, 1, 0}, 1}}, {});
  CHECK(plane.distance == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(near(plane.on_b, Vec3(7, 1, -2), 1e-15));
  CHECK(near(plane.on_a, Vec3(7, 1.5, -2), 1e-15));
  // The smallest gaps, and no gap.
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Separation faces = distance({Box{{1, 1, 1}}}, at(0, 0, 0), {Box{{1, 1, 1}}}, at(2 + gap, 0.3, -0.2));
    CHECK(std::abs(faces.distance - gap) <= 1e-15);
  }
  CHECK(distance({Box{{1, 1, 1}}}, at(0, 0, 0), {Box{{1, 1, 1}}}, at(2, 0.3, -0.2)).distance == 0);
  CHECK(overlapping({Box{{1, 1, 1}}}, at(0, 0, 0), {Box{{1, 1, 1}}}, at(2, 2, 2)));
  CHECK(!overlapping({Box{{1, 1, 1}}}, at(0, 0, 0), {Box{{1, 1, 1}}}, at(2, 2, std::nextafter(2, 3))));
  CHECK(overlapping({Sphere{1}}, at(0, 0, 0), {Sphere{1}}, at(0, 0, 0)));
  CHECK(overlapping({Plane{}}, {}, {Sphere{1}}, at(0, 1, 0)));
  CHECK(!overlapping({Plane{}}, {}, {Sphere{1}}, at(0, 1 + 1e-12, 0)));
  CHECK_THROWS_AS((void)distance({Plane{}}, {}, {Plane{}}, at(0, 1, 0)), std::invalid_argument);
  CHECK_THROWS_AS((void)overlapping({Plane{}}, {}, {Plane{}}, at(0, 1, 0)), std::invalid_argument);
}

TEST_CASE("the gap between any two shapes is what all their corners, edges and faces give, and both points are real") {
  Random random(31);
  double worst = 0;
  int apart = 0, meet = 0;
  const int count = cases(1000);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    const double size = std::pow(10, random.between(-2, 2)), far = i % 5 == 0 ? 1e3 * size : 0;
    const Shape a = any_shape(random, size), b = any_shape(random, size * std::pow(10, random.between(-1, 0.5)));
    const Vec3 place = random.vector(far);
    Pose pose_a = any_pose(random, size), pose_b = any_pose(random, 1.5 * size);
    if (i % 7 == 0) pose_a.rotation = pose_b.rotation = Quat::Identity();
    pose_a.position += place;
    pose_b.position += place;
    const Framework frame_a = framework_of(a, pose_a), frame_b = framework_of(b, pose_b);
    const double exact = cores_cross(a, pose_a, frame_a, b, pose_b, frame_b) ? -1.0 : counted_out(frame_a, frame_b);
    const Separation found = distance(a, pose_a, b, pose_b), back = distance(b, pose_b, a, pose_a);
    const double off = std::abs(found.distance - std::max(0.0, exact)) / size;
    worst = std::max(worst, off);
    CHECK(off < 1e-12);
    CHECK(std::abs(found.distance - back.distance) < 1e-12 * size);
    if (std::abs(exact) > 1e-12 * size) CHECK(overlapping(a, pose_a, b, pose_b) == (exact < 0));
    const double hair = 1e-11 * size;
    CHECK(height_over(a, pose_a, found.on_a) < hair);
    CHECK(height_over(b, pose_b, found.on_b) < hair);
    CHECK(std::abs((found.on_a - found.on_b).norm() - found.distance) < hair);
    ++(exact > 0 ? apart : meet);
  }
  MESSAGE(count << " pairs, " << apart << " apart: the distance is at worst " << worst << " of the size off");
  CHECK(apart > 0.3 * count);
  CHECK(meet > 0.1 * count);
}

TEST_CASE("the closest point of a shape is on its surface, and no point of the shape is nearer") {
  Random random(41);
  for (int i = 0; i < cases(1000); ++i) {
    CAPTURE(i);
    const Shape shape =
        i % 10 == 0 ? Shape{Plane{random.rotation() * Vec3(0, 1, 0), random.between(-1, 1)}} : any_shape(random, 1);
    const Pose pose = any_pose(random, 2);
    const Vec3 point = random.vector(4);
    const Vec3 closest = closest_point(shape, pose, point);
    if (height_over(shape, pose, point) <= 0) {
      CHECK(closest == point);
      continue;
    }
    CHECK(std::abs(height_over(shape, pose, closest)) < 1e-12);
    // All of a convex shape lies behind the plane through the closest point.
    const Vec3 out = (point - closest).normalized();
    if (!std::holds_alternative<Plane>(shape.solid)) {
      const Framework frame = framework_of(shape, pose);
      for (const Vec3& corner : frame.corners) CHECK(out.dot(corner - closest) + frame.skin < 1e-7);
    }
  }
}

TEST_CASE("distances far from the origin, of a trifle and of a world, are as good as their numbers") {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double far : {0.0, 1e3, 1e6}) {
      const Vec3 place = far * scale * Vec3(1, -1, 1);
      const Separation found = distance({Box{scale * Vec3(1, 1, 1)}}, {.position = place}, {Sphere{scale}},
                                        {.position = place + scale * Vec3(0, 3, 0)});
      CHECK(std::abs(found.distance - scale) <= scale * (4e-15 + 4e-16 * far));
    }
  }
}
