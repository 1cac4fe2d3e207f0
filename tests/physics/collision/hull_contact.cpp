#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>
#include <tweenfall/physics/contact.h>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

Pose standing(const Vec3& position, const Quat& rotation = Quat(1, 0, 0, 0)) {
  Pose pose;
  pose.position = position;
  pose.rotation = rotation;
  return pose;
}

Quat quarter_parts(const Vec3& axis, double degrees) {
  const double half = degrees * test::pi / 360;
  return Quat(std::cos(half), axis.x() * std::sin(half), axis.y() * std::sin(half), axis.z() * std::sin(half));
}

double greatest_depth(const Manifold& manifold) {
  double most = -1e9;
  for (int i = 0; i < manifold.count; ++i)
    most = std::max(most, manifold.points[static_cast<std::size_t>(i)].penetration);
  return most;
}

Shape hull_of(const std::vector<Vec3>& points) {
  return {Hull{ConvexHull(points)}};
}

Shape hull_box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  return hull_of(corners);
}

Shape octahedron() {
  return hull_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}

Shape cylinder(double radius, double height, int sides) {
  const Curve<Vec2> wall = keyed_curve<Vec2>({{0, {radius, -height / 2}, Ease::linear()}, {1, {radius, height / 2}}});
  return {Hull{ConvexHull(lathe(wall, {.segments = sides, .profile_steps = 1}))}};
}

}  // namespace

TEST_CASE("a ball meets a hull's face, edge and corner along their closed-form directions") {
  const Shape ball{Sphere{0.5}}, hull = octahedron();
  const double third = 1 / std::sqrt(3.0);
  // Over the middle of the face x + y + z = 1, 0.4 m up.
  const Vec3 out(third, third, third);
  const Manifold face = collide(hull, standing({0, 0, 0}), ball, standing(Vec3(1, 1, 1) / 3 + 0.4 * out));
  REQUIRE(face.count == 1);
  CHECK(near(face.normal, out, 1e-14));
  CHECK(near(face.points[0].penetration, 0.1, 1e-14));
  CHECK(near(face.points[0].position, Vec3(Vec3(1, 1, 1) / 3 - 0.05 * out), 1e-14));
  const Manifold edge = collide(hull, standing({0, 0, 0}), ball, standing({0.5 + 0.3, 0.5 + 0.3, 0}));
  REQUIRE(edge.count == 1);
  CHECK(near(edge.normal, Vec3(std::sqrt(0.5), std::sqrt(0.5), 0), 1e-14));
  CHECK(near(edge.points[0].penetration, 0.5 - 0.3 * std::sqrt(2.0), 1e-14));
  const Manifold corner = collide(ball, standing({0, 1.3, 0}), hull, standing({0, 0, 0}));
  REQUIRE(corner.count == 1);
  CHECK(near(corner.normal, Vec3(0, -1, 0), 1e-14));  // from the ball toward the hull
  CHECK(near(corner.points[0].penetration, 0.2, 1e-14));
  const Manifold inside = collide(hull, standing({0, 0, 0}), ball, standing({0.1, 0.2, 0.05}));
  REQUIRE(inside.count == 1);
  CHECK(near(inside.normal, out, 1e-14));
  CHECK(near(inside.points[0].penetration, 0.5 + (1 - 0.35) * third, 1e-14));
  CHECK(collide(hull, standing({0, 0, 0}), ball, standing({0, 1.6, 0})).count == 0);
  CHECK(collide(hull, standing({0, 0, 0}), ball, standing({0, 1.6, 0}), 0.2).count == 1);
}

TEST_CASE("balls and capsules overlap the hull of a box's corners by their radius less the distance to the box") {
  test::Random random(17);
  const Vec3 half(0.3, 0.5, 0.4);
  const Shape box{Box{half}}, hull = hull_box(half);
  int shallow = 0, deep = 0;
  for (int i = 0; i < 900; ++i) {
    const double half_height = i % 2 ? 0 : 0.3;
    const Shape round = i % 2 ? Shape{Sphere{0.2}} : Shape{Capsule{0.2, half_height}};
    const Pose at_box = standing(random.vector(1), random.rotation());
    const Pose at_round = standing(Vec3(at_box.position + random.vector(0.9)), random.rotation());
    // The distance to a box is convex along the axis: a ternary search finds the least.
    const auto distance = [&](double t) {
      const Vec3 at = at_round.position + at_round.rotation * Vec3(0, t, 0) - at_box.position;
      const Vec3 local = at_box.rotation.conjugate() * at;
      return (local - local.cwiseMax(-half).cwiseMin(half)).norm();
    };
    double low = -half_height, high = half_height;
    for (int k = 0; k < 100; ++k) {
      const double third = (high - low) / 3;
      if (distance(low + third) < distance(high - third))
        high -= third;
      else
        low += third;
    }
    const double least = distance(low);
    const Manifold manifold = collide(hull, at_box, round, at_round);
    CAPTURE(i);
    CHECK((manifold.count > 0) == (least < 0.2));
    if (manifold.count == 0) continue;
    CHECK(std::abs(manifold.normal.norm() - 1) < 1e-12);
    if (least > 1e-3) {
      ++shallow;
      // Nearly along a face's normal, the face's own normal is taken.
      CHECK(std::abs(greatest_depth(manifold) - (0.2 - least)) < 1e-3);
    } else if (least < 1e-9) {
      ++deep;
      CHECK(std::abs(greatest_depth(manifold) - greatest_depth(collide(box, at_box, round, at_round))) < 2e-3);
    }
  }
  CHECK(shallow > 80);
  CHECK(deep > 80);
}

TEST_CASE("a capsule lies on a hull's face with two contacts, on an edge along it with two, across one with one") {
  const Shape hull = hull_box(Vec3(1, 1, 1)), capsule{Capsule{0.25, 2}};
  const Pose at = standing({0, 0, 0});
  const Quat lying = quarter_parts({0, 0, 1}, 90);  // along x
  const Manifold on_face = collide(hull, at, capsule, standing({0, 1.24, 0}, lying));
  REQUIRE(on_face.count == 2);
  CHECK(near(on_face.normal, Vec3(0, 1, 0), 1e-12));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(near(on_face.points[i].penetration, 0.01, 1e-12));
    CHECK(near(std::abs(on_face.points[i].position.x()), 1, 1e-12));
    CHECK(near(on_face.points[i].position.y(), 0.995, 1e-12));
  }
  // The hull on edge, ridge along x: beside it, and across it.
  const Pose on_edge = standing({0, 0, 0}, quarter_parts({1, 0, 0}, 45));
  const double ridge = std::sqrt(2.0);
  const Manifold along = collide(hull, on_edge, capsule, standing({0.5, ridge + 0.24, 0}, lying));
  REQUIRE(along.count == 2);
  CHECK(near(along.normal, Vec3(0, 1, 0), 1e-12));
  CHECK(near(std::abs(along.points[0].position.x() - along.points[1].position.x()), 2, 1e-12));
  CHECK(near(along.points[0].penetration, 0.01, 1e-12));
  const Manifold across =
      collide(hull, on_edge, capsule, standing({0.5, ridge + 0.24, 0.3}, quarter_parts({1, 0, 0}, 90)));
  REQUIRE(across.count == 1);
  CHECK(near(across.points[0].position, Vec3(0.5, ridge - 0.005, 0), 1e-12));
  // Standing with its axis 0.1 m into the hull; a ridge 0.05 m into the axis.
  const Manifold deep = collide(hull, at, capsule, standing({0.3, 2.9, 0.2}));
  REQUIRE(deep.count >= 1);
  CHECK(near(deep.normal, Vec3(0, 1, 0), 1e-12));
  CHECK(near(greatest_depth(deep), 0.35, 1e-12));
  const Manifold cut = collide(hull, on_edge, capsule, standing({0, ridge - 0.05, 0}, quarter_parts({1, 0, 0}, 90)));
  REQUIRE(cut.count == 1);
  CHECK(near(cut.normal, Vec3(0, 1, 0), 1e-12));
  CHECK(near(cut.points[0].penetration, 0.3, 1e-12));
}

TEST_CASE("a hull on a plane stands on its spread-out corners") {
  const Shape floor{Plane{}};
  const Manifold cube = collide(hull_box(Vec3(0.5, 0.5, 0.5)), standing({0, 0.49, 0}), floor, standing({0, 0, 0}));
  REQUIRE(cube.count == 4);
  CHECK(near(cube.normal, Vec3(0, -1, 0), 1e-15));
  CHECK(near(greatest_depth(cube), 0.01, 1e-14));
  const Manifold disc = collide(cylinder(0.5, 0.2, 24), standing({0, 0.1, 0}), floor, standing({0, 0, 0}), 1e-3);
  REQUIRE(disc.count == 4);
  // The center is held from all sides.
  double least_x = 1, most_x = -1, least_z = 1, most_z = -1;
  for (const ContactPoint& point : disc.points) {
    least_x = std::min(least_x, point.position.x());
    most_x = std::max(most_x, point.position.x());
    least_z = std::min(least_z, point.position.z());
    most_z = std::max(most_z, point.position.z());
  }
  CHECK(least_x < -0.3);
  CHECK(most_x > 0.3);
  CHECK(least_z < -0.3);
  CHECK(most_z > 0.3);
  const Manifold tip = collide(floor, standing({0, 0, 0}), octahedron(), standing({0, 0.9, 0}));
  REQUIRE(tip.count == 1);
  CHECK(near(tip.normal, Vec3(0, 1, 0), 1e-15));
  CHECK(near(tip.points[0].position, Vec3(0, -0.05, 0), 1e-14));
}

TEST_CASE("crossed edges, a tip on a face and faces on faces touch where geometry says") {
  const Shape cube = hull_box(Vec3(0.5, 0.5, 0.5)), box{Box{Vec3(0.5, 0.5, 0.5)}};
  const double ridge = std::sqrt(0.5);
  for (const Shape& other : {cube, box}) {
    const Manifold edges = collide(cube, standing({0, 0, 0}, quarter_parts({1, 0, 0}, 45)), other,
                                   standing({0.1, 2 * ridge - 0.02, 0.05}, quarter_parts({0, 0, 1}, 45)));
    REQUIRE(edges.count == 1);
    CHECK(near(edges.normal, Vec3(0, 1, 0), 1e-12));
    CHECK(near(edges.points[0].penetration, 0.02, 1e-12));
    CHECK(near(edges.points[0].position, Vec3(0.1, ridge - 0.01, 0), 1e-12));
    const Manifold tip = collide(other, standing({0, 0, 0}), octahedron(), standing({0.2, 1.47, -0.1}));
    REQUIRE(tip.count >= 1);
    CHECK(near(tip.normal, Vec3(0, 1, 0), 1e-12));
    CHECK(near(greatest_depth(tip), 0.03, 1e-12));
    // A cube on another, shifted and turned a little: the corners of their common area.
    const Manifold stacked = collide(cube, standing({0, 0, 0}), other, standing({0.3, 0.99, 0.2}));
    REQUIRE(stacked.count == 4);
    CHECK(near(stacked.normal, Vec3(0, 1, 0), 1e-12));
    for (const ContactPoint& point : stacked.points) {
      CHECK(near(point.penetration, 0.01, 1e-12));
      CHECK(near(point.position.y(), 0.495, 1e-12));
      CHECK((near(point.position.x(), -0.2, 1e-12) || near(point.position.x(), 0.5, 1e-12)));
      CHECK((near(point.position.z(), -0.3, 1e-12) || near(point.position.z(), 0.5, 1e-12)));
    }
    const Manifold a_hair_on = collide(cube, standing({1e-9, 0, -1e-9}), other,
                                       standing({0.3, 0.99 + 1e-9, 0.2}, quarter_parts({0, 1, 0}, 1e-6)));
    REQUIRE(a_hair_on.count == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(stacked.points[i].feature == a_hair_on.points[i].feature);
  }
}

TEST_CASE("hulls overlap by what the Minkowski difference says, and part where it says") {
  test::Random random(29);
  int touching = 0, apart = 0;
  for (int round = 0; round < 150; ++round) {
    std::vector<Vec3> points_a, points_b, difference;
    for (int i = 0; i < 14; ++i) {
      points_a.push_back(random.vector(0.5));
      points_b.push_back(random.vector(0.5));
    }
    const Shape a = hull_of(points_a), b = hull_of(points_b);
    const Pose at_a = standing(random.vector(0.2), random.rotation());
    const Pose at_b = standing(random.vector(0.8), random.rotation());
    for (const Vec3& p : points_a)
      for (const Vec3& q : points_b)
        difference.push_back(at_a.position + at_a.rotation * p - at_b.position - at_b.rotation * q);
    const ConvexHull minkowski(difference);
    double depth = 1e9;  // of the origin
    for (const ConvexHull::Face& face : minkowski.faces()) depth = std::min(depth, face.offset);
    const Manifold manifold = collide(a, at_a, b, at_b), back = collide(b, at_b, a, at_a);
    CAPTURE(round);
    CAPTURE(depth);
    CHECK((manifold.count > 0) == (depth > 0));
    CHECK((back.count > 0) == (depth > 0));
    if (depth > 0) {
      ++touching;
      // An earlier kind of direction is kept while it is at most 6 thousandths of a size worse.
      CHECK(greatest_depth(manifold) <= depth + 2e-3);
      CHECK(greatest_depth(back) <= depth + 2e-3);
      // Moved out along the normal by that much, they no longer touch.
      Pose out = at_b;
      out.position += (depth + 2e-3) * manifold.normal;
      CHECK(collide(a, at_a, b, out).count == 0);
    } else {
      ++apart;
      CHECK(manifold.count == 0);
    }
  }
  CHECK(touching > 40);
  CHECK(apart > 20);
}

TEST_CASE("many-sided hulls meet each other as the round solids that they stand for") {
  const Shape pin = cylinder(0.2, 1, 48), ball{Sphere{0.2}}, box{Box{Vec3(1, 0.5, 1)}};
  const double flat = 0.2 * std::cos(test::pi / 48);
  // Two upright cylinders side by side, at any turn of their sides.
  for (int turn = 0; turn < 24; ++turn) {
    const Quat turned = quarter_parts({0, 1, 0}, 3.1 * turn);
    const Manifold beside = collide(pin, standing({0, 0, 0}), pin, standing({0.39, 0.2, 0.0}, turned), 1e-3);
    REQUIRE(beside.count >= 1);
    CHECK(std::abs(beside.normal.x() - 1) < 0.005);
    CHECK(greatest_depth(beside) < 0.0101 + 4e-4);  // by this much, an earlier kind of direction may be worse
    CHECK(greatest_depth(beside) > 2 * flat - 0.39 - 1e-9);
    const Manifold with_ball = collide(ball, standing({-0.39, 0, 0}), pin, standing({0, 0, 0}, turned));
    REQUIRE(with_ball.count == 1);
    CHECK(std::abs(with_ball.normal.x() - 1) < 0.005);
    CHECK(with_ball.points[0].penetration < 0.0101);
    CHECK(with_ball.points[0].penetration > 0.2 + flat - 0.39 - 1e-9);
    const Manifold on_box = collide(pin, standing({0.1, 1, 0.1}, turned), box, standing({0, 0.01, 0}));
    REQUIRE(on_box.count == 4);
    CHECK(near(on_box.normal, Vec3(0, -1, 0), 1e-12));
    CHECK(near(greatest_depth(on_box), 0.01, 1e-12));
  }
}

TEST_CASE("a cylinder that lies on a wide floor touches it along its line, however lightly") {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 20 : -20, i & 2 ? 0 : -2, i & 4 ? 20 : -20);
  const Shape box{Box{{20, 1, 20}}, {.position = Vec3(0, -1, 0)}}, hull{Hull{ConvexHull(corners)}};
  test::Random random(1);
  for (const Shape& floor : {box, hull})
    for (const double depth : {1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 0.0, -1e-9, -1e-7, -1e-5})
      for (int i = 0; i < 100; ++i) {
        const double around = random.between(-3, 3), about = random.between(-3, 3);
        const Quat lying = Quat(Eigen::AngleAxisd(around, Vec3::UnitY())) *
                           Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX())) *
                           Quat(Eigen::AngleAxisd(about, Vec3::UnitY()));
        const Pose pose{.position = Vec3(random.between(-10, 10), 0.2 - depth, random.between(-10, 10)),
                        .rotation = lying};
        CAPTURE(depth);
        CAPTURE(i);
        const Manifold manifold = collide(floor, Pose{}, {Cylinder{0.2, 0.3}}, pose, 1e-3);
        REQUIRE(manifold.count == 2);
        CHECK(near(manifold.normal, Vec3(0, 1, 0), 1e-12));
        const Vec3 along = lying * Vec3(0, 0.3, 0), below(pose.position.x(), -0.5 * depth, pose.position.z());
        const bool first = (manifold.points[0].position - below).dot(along) > 0;
        CHECK(near(manifold.points[first ? 0 : 1].position, Vec3(below + along), 1e-12));
        CHECK(near(manifold.points[first ? 1 : 0].position, Vec3(below - along), 1e-12));
        for (std::size_t k = 0; k < 2; ++k) CHECK(near(manifold.points[k].penetration, depth, 1e-12));
      }
}
