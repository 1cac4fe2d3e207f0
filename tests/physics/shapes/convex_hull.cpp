#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>
#include <tweenfall/physics/shape.h>

#include <limits>
#include <set>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

std::vector<Vec3> box_corners(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return corners;
}

std::string refusal(const std::vector<Vec3>& points) {
  try {
    (void)ConvexHull(points);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "made";
}

/// What every hull must be, whatever it was made from: closed, convex, and around all points.
void check_polyhedron(const ConvexHull& hull, const std::vector<Vec3>& points) {
  const auto vertices = hull.vertices();
  const double size = hull.outer_radius(), within = 2e-5 * size;
  CHECK(vertices.size() + hull.faces().size() == hull.edges().size() + 2);
  for (const ConvexHull::Face& face : hull.faces()) {
    CHECK(std::abs(face.normal.norm() - 1) < 1e-14);
    for (const Vec3& point : points) CHECK(face.normal.dot(point) <= face.offset + within);
    const auto corners = hull.corners(face);
    CHECK(corners.size() >= 3);
    CHECK(std::set<std::uint32_t>(corners.begin(), corners.end()).size() == corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3& a = vertices[corners[i]];
      const Vec3& b = vertices[corners[(i + 1) % corners.size()]];
      const Vec3& c = vertices[corners[(i + 2) % corners.size()]];
      CHECK(std::abs(face.normal.dot(a) - face.offset) <= within);
      CHECK((b - a).cross(c - b).dot(face.normal) > -within * size);
    }
  }
  std::size_t sides = 0;
  for (const ConvexHull::Edge& edge : hull.edges()) {
    CHECK(edge.from < edge.to);
    const auto runs = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
      const auto corners = hull.corners(hull.faces()[face]);
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] == from && corners[(i + 1) % corners.size()] == to) return true;
      return false;
    };
    CHECK(runs(edge.left, edge.from, edge.to));
    CHECK(runs(edge.right, edge.to, edge.from));
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) sides += hull.neighbors(i).size();
  CHECK(sides == 2 * hull.edges().size());
  CHECK(is_closed(hull.surface()));
}

SurfaceMesh turned_profile(const std::vector<Vec2>& profile, int sides) {
  std::vector<Key<Vec2>> keys;
  for (std::size_t i = 0; i < profile.size(); ++i) keys.push_back({static_cast<double>(i), profile[i], Ease::linear()});
  return lathe(keyed_curve<Vec2>(std::span<const Key<Vec2>>(keys)), {.segments = sides, .profile_steps = 1});
}

}  // namespace

TEST_CASE("the hull of a box's corners has six rectangles, and the box's volume and inertia") {
  const Vec3 half(0.3, 0.5, 0.2);
  const std::vector<Vec3> corners = box_corners(half);
  const ConvexHull hull(corners);
  check_polyhedron(hull, corners);
  CHECK(hull.vertices().size() == 8);
  CHECK(hull.edges().size() == 12);
  REQUIRE(hull.faces().size() == 6);
  for (const ConvexHull::Face& face : hull.faces()) CHECK(face.corners == 4);
  CHECK(near(hull.inner_radius(), 0.2, 1e-15));
  CHECK(near(hull.outer_radius(), half.norm(), 1e-15));
  Pose offset;
  offset.position = Vec3(1, -2, 0.5);
  offset.rotation = Quat(0.5, 0.5, -0.5, 0.5);
  const Shape box{Box{half}, offset}, same{Hull{hull}, offset};
  CHECK(near(volume(same.solid), volume(box.solid), 1e-15));
  const MassProperties of_box = mass_properties(box, 3), of_hull = mass_properties(same, 3);
  CHECK(near(of_hull.center, of_box.center, 1e-14));
  CHECK(near(of_hull.inertia, of_box.inertia, 1e-14));
  Pose node;
  node.rotation = test::Random(5).rotation();
  CHECK(near(bounds(same, node).low, bounds(box, node).low, 1e-14));
  CHECK(near(bounds(same, node).high, bounds(box, node).high, 1e-14));
}

TEST_CASE("points twice, inside, in faces and on edges change nothing") {
  std::vector<Vec3> points;
  test::Random random(11);
  for (int x = 0; x <= 6; ++x)
    for (int y = 0; y <= 5; ++y)
      for (int z = 0; z <= 4; ++z) points.emplace_back(x / 6.0, y / 5.0, z / 4.0);
  for (int i = 0; i < 100; ++i) points.push_back(points[random.bits() % points.size()]);
  // Turned, so that no coordinate is exact, and rounded to single precision.
  const Quat turn = random.rotation();
  for (const bool single : {false, true}) {
    std::vector<Vec3> placed;
    for (const Vec3& point : points) {
      const Vec3 at = turn * point;
      placed.push_back(single ? Vec3(at.cast<float>().cast<double>()) : at);
    }
    const ConvexHull hull(placed);
    check_polyhedron(hull, placed);
    CHECK(hull.vertices().size() == 8);
    CHECK(hull.faces().size() == 6);
    CHECK(near(hull.measures().volume, 1, 1e-6));
  }
}

TEST_CASE("hulls of random points are closed, convex and around them, whatever the points are") {
  test::Random random(3);
  for (int round = 0; round < 60; ++round) {
    const int kind = round % 6;
    std::vector<Vec3> points;
    const int count = 4 + static_cast<int>(random.bits() % 120);
    for (int i = 0; i < count; ++i) {
      Vec3 point = random.vector(1);
      if (kind == 1) point.normalize();
      if (kind == 2) point = (point * 3).array().round();  // a coarse grid: many points in one plane
      if (kind == 3) point.y() *= 1e-3;                    // a sheet
      if (kind == 4) point.y() = point.y() > 0 ? 1 : -1;   // two planes
      if (kind == 5) point += 1e-7 * random.vector(1) + Vec3(1000, -200, 30);
      points.push_back(point);
    }
    if (kind == 2) points.insert(points.end(), {Vec3(-3, 0, 0), Vec3(3, 0, 0), Vec3(0, 3, 1), Vec3(0, 0, -3)});
    if (kind == 5)
      for (int i = 0; i < count; ++i) points.push_back(points[static_cast<std::size_t>(i)] + 1e-8 * random.vector(1));
    CAPTURE(round);
    check_polyhedron(ConvexHull(points), points);
  }
}

TEST_CASE("a pyramid, an octahedron and a prism have the faces of the books") {
  const ConvexHull pyramid(std::vector<Vec3>{{1, 0, 1}, {-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {0, 1.5, 0}});
  CHECK(pyramid.faces().size() == 5);
  CHECK(near(pyramid.measures().volume, 2, 1e-15));
  CHECK(near(pyramid.measures().center, Vec3(0, 1.5 / 4, 0), 1e-15));
  const ConvexHull octahedron(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  CHECK(octahedron.faces().size() == 8);
  CHECK(near(octahedron.measures().volume, 4.0 / 3, 1e-15));
  CHECK(near(octahedron.inner_radius(), 1 / std::sqrt(3.0), 1e-15));
  // Edges of 1 m: volume 5 (3 + sqrt 5) / 12, every moment of inertia m phi^2 / 10.
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> points;
  for (const double one : {-0.5, 0.5})
    for (const double other : {-0.5 * golden, 0.5 * golden})
      points.insert(points.end(), {Vec3(0, one, other), Vec3(one, other, 0), Vec3(other, 0, one)});
  const Shape icosahedron{Hull{ConvexHull(points)}};
  CHECK(std::get<Hull>(icosahedron.solid).convex.faces().size() == 20);
  CHECK(near(volume(icosahedron.solid), 5 * (3 + std::sqrt(5.0)) / 12, 1e-14));
  CHECK(near(mass_properties(icosahedron, 3).inertia, Mat3(0.3 * golden * golden * Mat3::Identity()), 1e-14));
  const ConvexHull prism(turned_profile({{0.5, 0}, {0.5, 2}}, 24));
  CHECK(prism.vertices().size() == 48);
  CHECK(prism.faces().size() == 26);
  CHECK(prism.edges().size() == 72);
}

TEST_CASE("a turned profile comes to the cylinder's and the cone's mass properties as its sides grow in number") {
  const auto error_of_cylinder = [](int sides) {
    const Shape shape{Hull{ConvexHull(turned_profile({{0.5, 0}, {0.5, 2}}, sides))}};
    const MassProperties mass = mass_properties(shape, 3);
    CHECK(near(mass.center, Vec3(0, 1, 0), 1e-12));
    const Vec3 closed(3 * (3 * 0.25 + 4) / 12, 3 * 0.25 / 2, 3 * (3 * 0.25 + 4) / 12);
    CHECK(std::abs(volume(shape.solid) / (test::pi * 0.25 * 2) - 1) < 10.0 / (sides * sides));
    return (mass.inertia.diagonal() - closed).norm() / closed.norm();
  };
  const auto error_of_cone = [](int sides) {
    const Shape shape{Hull{ConvexHull(turned_profile({{0.5, 0}, {0, 2}}, sides))}};
    const MassProperties mass = mass_properties(shape, 3);
    CHECK(near(mass.center, Vec3(0, 0.5, 0), 1e-12));
    const double across = 3 * (3 * 0.25 / 20 + 3 * 4.0 / 80), along = 3 * 0.3 * 0.25;
    const Vec3 closed(across, along, across);
    return (mass.inertia.diagonal() - closed).norm() / closed.norm();
  };
  CHECK(error_of_cylinder(120) < 5e-4);
  CHECK(error_of_cone(120) < 1e-3);
  // In proportion to the square of the side's length.
  CHECK(near(error_of_cylinder(30) / error_of_cylinder(120), 16, 0.03));
  CHECK(near(error_of_cone(30) / error_of_cone(120), 16, 0.03));
}

TEST_CASE("a swept beam bent at a kink has the hull around its bend") {
  const auto line = [](const std::vector<Vec3>& points) {
    std::vector<Key<Vec3>> keys;
    for (std::size_t i = 0; i < points.size(); ++i) keys.push_back({static_cast<double>(i), points[i], Ease::linear()});
    return keyed_curve<Vec3>(std::span<const Key<Vec3>>(keys));
  };
  const Curve<Vec2> square = keyed_curve<Vec2>({{0, {-0.1, -0.1}, Ease::linear()},
                                                {1, {0.1, -0.1}, Ease::linear()},
                                                {2, {0.1, 0.1}, Ease::linear()},
                                                {3, {-0.1, 0.1}, Ease::linear()},
                                                {4, {-0.1, -0.1}}});
  const SweepOptions options{.rail_steps = 1, .profile_steps = 1};
  const ConvexHull straight(sweep(square, line({{0, 0, 0}, {3, 0, 0}}), options));
  CHECK(straight.faces().size() == 6);
  CHECK(near(straight.measures().volume, 0.12, 1e-12));
  const SurfaceMesh bent = sweep(square, line({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), options);
  const ConvexHull hull(bent);
  check_polyhedron(hull, bent.positions);
  // The triangle of the bend is filled: corner, two square ends, and the slope between them.
  CHECK(hull.measures().volume > 2 * measure(bent).volume);
}

TEST_CASE("the same points give the same hull to the bit, and copies share it") {
  test::Random random(21);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) points.push_back(random.vector(1));
  const ConvexHull first(points), second(points);
  ConvexHull copy = first;
  CHECK(copy.vertices().data() == first.vertices().data());
  REQUIRE(first.faces().size() == second.faces().size());
  for (std::size_t i = 0; i < first.faces().size(); ++i) {
    CHECK(first.faces()[i].normal == second.faces()[i].normal);
    CHECK(first.faces()[i].offset == second.faces()[i].offset);
  }
  copy = second;
  CHECK(copy.vertices().data() == second.vertices().data());
  const ConvexHull moved = std::move(copy);
  CHECK(copy.vertices().size() == moved.vertices().size());  // a hull is never empty
}

TEST_CASE("points that have no hull are refused, saying what would be right") {
  CHECK(refusal({}) == "a convex hull needs at least 4 points, but has 0");
  CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == "a convex hull needs at least 4 points, but has 3");
  CHECK(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::quiet_NaN()}})
            .rfind("points of a convex hull must be finite, but point 3 is (0, ", 0) == 0);
  CHECK(refusal({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}) ==
        "a convex hull needs points that enclose a volume, but all 4 points lie at one place");
  CHECK(refusal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {0.5, 0.5, 0.5}}) ==
        "a convex hull needs points that enclose a volume, but all 5 points lie on one straight line");
  CHECK(refusal({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}) ==
        "a convex hull needs points that enclose a volume, but all 4 points lie in one plane");
  CHECK(refusal({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1e200}}).find("between 1e-6 m and 1e6 m wide") !=
        std::string::npos);
  const std::vector<Vec3> ball =
      turned_profile({{0.1, 0}, {0.5, 0.1}, {0.9, 0.5}, {1, 1}, {0.5, 2}, {0, 2.2}}, 60).positions;
  CHECK(refusal(ball) ==
        "a convex hull can have 256 vertices, but these points make 301; take fewer points, or fewer sides around");
}
