#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/fitted_shapes.h>

#include "support.h"

namespace tweenfall::test::fitting {

std::vector<Vec3> on_ball(int count, const Vec3& stretch, std::uint64_t number) {
  Random random(number);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) points.push_back(random.vector(1).normalized().cwiseProduct(stretch));
  return points;
}

TEST_CASE("the hull around a mesh of many points has no more vertices than it may, and leaves little outside") {
  for (const int count : {200, 5000, 50'000}) {
    const std::vector<Vec3> points = on_ball(count, {1, 0.6, 0.8}, 7);
    const ConvexHull hull = hull_around(points);
    CAPTURE(count);
    CHECK(hull.vertices().size() <= ConvexHull::most_vertices);
    CHECK(hull.vertices().size() >= 190);
    double out = 0;
    for (const Vec3& point : points)
      for (const ConvexHull::Face& face : hull.faces()) out = std::max(out, face.normal.dot(point) - face.offset);
    // What 256 points leave out of a ball: about 2 / 256 of its radius.
    CHECK(out < 0.025);
    CHECK(near(hull.measures().volume, 4 * pi / 3 * 0.48, 0.15));
  }
}

TEST_CASE("the hull around a finely divided box is the box, and that of few vertices is near") {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i)
    for (int k = 0; k <= 20; ++k)
      for (const double side : {-1.0, 1.0}) {
        points.emplace_back(side, 0.1 * i - 1, 0.1 * k - 1);
        points.emplace_back(0.1 * i - 1, side, 0.1 * k - 1);
        points.emplace_back(0.1 * i - 1, 0.1 * k - 1, side);
      }
  const ConvexHull hull = hull_around(points);
  CHECK(hull.vertices().size() == 8);
  CHECK(near(hull.measures().volume, 8, 1e-12));
  CHECK(hull_around(on_ball(3000, {1, 1, 1}, 2), 24).vertices().size() <= 24);
  CHECK_THROWS_WITH((void)hull_around(points, 3), "a hull can have 4 to 256 vertices, but is asked for 3");
  points[5].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS((void)hull_around(points), std::invalid_argument);
}

TEST_CASE("the box around the points of a turned box is that box, wherever it stands") {
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    const Vec3 half(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1)), place = random.vector(5);
    const Quat turn = random.rotation();
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)
      points.push_back(
          place + turn * Vec3((k & 1 ? 1 : -1) * half.x(), (k & 2 ? 1 : -1) * half.y(), (k & 4 ? 1 : -1) * half.z()));
    for (int k = 0; k < 50; ++k) points.push_back(place + turn * random.vector(1).cwiseProduct(half));
    const Shape box = box_around(points);
    CHECK(near(volume(box.solid), 8 * half.prod(), 1e-9));
    CHECK(near(box.offset.position, place, 1e-9));
  }
}

TEST_CASE("the box around any points holds them all, and is no larger than boxes turned at random") {
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    std::vector<Vec3> points;
    const Vec3 stretch(random.between(0.2, 1), random.between(0.2, 1), random.between(0.2, 1));
    const Quat turn = random.rotation();
    for (int k = 0; k < 60; ++k) points.push_back(turn * random.vector(1).cwiseProduct(stretch));
    const Shape shape = box_around(points);
    const Vec3 half = std::get<Box>(shape.solid).half_extents;
    for (const Vec3& point : points) {
      const Vec3 local = shape.offset.rotation.conjugate() * Vec3(point - shape.offset.position);
      CHECK((local.cwiseAbs() - half).maxCoeff() < 1e-12);
    }
    for (int k = 0; k < 300; ++k) {
      const Mat3 axes = random.rotation().toRotationMatrix();
      Vec3 low = Vec3::Constant(1e9), high = -low;
      for (const Vec3& point : points) {
        const Vec3 local = axes * point;
        low = low.cwiseMin(local);
        high = high.cwiseMax(local);
      }
      CHECK((high - low).prod() > 0.999 * volume(shape.solid));
    }
  }
}

TEST_CASE("the capsule around the points of a capsule is nearly that capsule") {
  Random random(4);
  const Quat turn = random.rotation();
  const Vec3 place(1, -2, 3), axis = turn * Vec3(0, 1, 0);
  std::vector<Vec3> points;
  for (int i = 0; i < 4000; ++i) {
    // Evenly over the surface: sides and ends by their share of it.
    const Vec3 out = random.vector(1).normalized();
    const bool side = random.between(0, 1) < 0.6;
    const Vec3 flat = Vec3(out.x(), 0, out.z()).normalized();
    points.push_back(place + turn * (side ? Vec3(0.2 * flat + Vec3(0, random.between(-0.6, 0.6), 0))
                                          : Vec3(0.2 * out + Vec3(0, out.y() < 0 ? -0.6 : 0.6, 0))));
  }
  for (const std::optional<Vec3>& along : {std::optional<Vec3>(), std::optional<Vec3>(7 * axis)}) {
    const Shape shape = capsule_around(points, along);
    const auto& capsule = std::get<Capsule>(shape.solid);
    CHECK(near(capsule.radius, 0.2, 0.005));
    CHECK(near(capsule.half_height, 0.6, 0.08));
    CHECK(near(shape.offset.position, place, 0.02));
    CHECK(std::abs((shape.offset.rotation * Vec3(0, 1, 0)).dot(axis)) > 0.999);
  }
  CHECK_THROWS_WITH((void)capsule_around({}), "a capsule around points needs some that span a volume");
  CHECK_THROWS_AS((void)box_around({}), std::invalid_argument);
  CHECK_THROWS_WITH((void)capsule_around(points, Vec3(0, 0, 0)), "the axis of a capsule must be finite and not zero");
}

TEST_CASE("points that lie on one line or at one place have no capsule, whatever their size and turn") {
  Random random(5);
  for (const double size : {1e-6, 1.0, 1e6}) {
    const Vec3 along = size * random.vector(1), place = size * random.vector(3);
    std::vector<Vec3> line, sheet;
    for (int i = 0; i < 200; ++i) {
      line.emplace_back(place + random.between(-1, 1) * along);
      sheet.emplace_back(place + random.between(-1, 1) * along + random.between(-1, 1) * size * Vec3(0, 0, 1));
    }
    CHECK_THROWS_WITH((void)capsule_around(line),
                      "a capsule around points needs some beside its axis, but nearly all of the 200 points lie on one "
                      "straight line");
    CHECK_THROWS_WITH((void)capsule_around(std::vector<Vec3>(20, place)),
                      "a capsule around points needs some beside its axis, but all 20 points lie at one place");
    CHECK(std::get<Capsule>(capsule_around(sheet).solid).radius > 0.01 * size);
  }
  CHECK_THROWS_AS((void)capsule_around(std::vector<Vec3>{{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1e200}}),
                  std::invalid_argument);
}

TEST_CASE("a hull of few vertices is found around a needle and a sheet that lie aslant") {
  Random random(6);
  const Vec3 thin(1, 1e-4, 1e-4), flat(1, 1e-4, 1);
  for (const Vec3& stretch : {thin, flat})
    for (int i = 0; i < 20; ++i) {
      const Quat turn = random.rotation();
      std::vector<Vec3> points;
      for (int k = 0; k < 200; ++k) points.emplace_back(turn * random.vector(1).cwiseProduct(stretch));
      const ConvexHull hull = hull_around(points, 32);
      CHECK(hull.vertices().size() >= 8);
      // Along the needle and across it, it is as wide as the points.
      for (int axis = 0; axis < 3; ++axis) {
        double of_points = 0, of_hull = 0;
        for (const Vec3& point : points) of_points = std::max(of_points, (turn * Vec3::Unit(axis)).dot(point));
        for (const Vec3& vertex : hull.vertices()) of_hull = std::max(of_hull, (turn * Vec3::Unit(axis)).dot(vertex));
        CHECK(of_hull > 0.8 * of_points);
      }
    }
  std::vector<Vec3> line;
  for (int k = 0; k < 300; ++k) line.emplace_back(k * 0.01, k * 0.02, k * -0.03);
  CHECK_THROWS_WITH((void)hull_around(line, 32),
                    "a convex hull needs points that enclose a volume, but all 300 points lie on one straight line");
}

}  // namespace tweenfall::test::fitting
