#include "shapes/turn_onto.h"

#include "shapes/principal_axes.h"
#include "support.h"

using namespace tweenfall;

TEST_CASE("the shortest turn takes a direction to another, also to one beside it and to its opposite") {
  const Vec3 from(0.3, -1.2, 0.5);
  const Vec3 across = from.cross(Vec3(1, 0, 0)).normalized() * from.norm();
  for (const double angle : {0.0, 1e-12, 1e-3, 1.0, 3.0, 3.1415, 3.14159265, 3.141592653589793}) {
    CAPTURE(angle);
    const Vec3 to = 2 * (std::cos(angle) * from + std::sin(angle) * across);
    const Quat turn = shapes::turn_onto(from, to);
    CHECK(turn.norm() == doctest::Approx(1).epsilon(1e-14));
    CHECK((turn * from.normalized() - to.normalized()).norm() < 2e-8);
    CHECK(2 * std::acos(std::min(1.0, std::abs(turn.w()))) == doctest::Approx(angle).epsilon(1e-7));
  }
}

TEST_CASE("points are spread along axes that are right-handed, least first, however small, far and turned they lie") {
  for (const double size : {1e-6, 1.0, 1e6}) {
    CAPTURE(size);
    const Quat turned(Quat(1, 0.4, -0.7, 0.2).normalized());
    std::vector<Vec3> points;
    points.reserve(6);
    for (int i = 0; i < 3; ++i)
      for (const double way : {-1.0, 1.0})
        points.emplace_back(size * (turned * Vec3(way * (i + 1) * Vec3::Unit(i)) + Vec3(3, 4, 5)));
    const Mat3 axes = shapes::principal_axes(points);
    CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-14);
    CHECK(axes.determinant() == doctest::Approx(1));
    for (int i = 0; i < 3; ++i) CHECK(std::abs(axes.col(i).dot(turned * Vec3::Unit(i))) > 1 - 1e-13);
  }
  CHECK(shapes::principal_axes(std::vector<Vec3>{Vec3(1, 2, 3)}) == Mat3::Identity());
}
