#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>
#include <tweenfall/physics/shape.h>

#include <limits>

#include "support.h"

using namespace tweenfall;
using test::near;

TEST_CASE("volumes are the closed forms") {
  using test::pi;
  CHECK(near(volume(Sphere{2}), 32 * pi / 3, 1e-15));
  CHECK(near(volume(Box{Vec3(1, 2, 3)}), 48, 1e-15));
  CHECK(near(volume(Capsule{0.5, 1}), pi / 2 + pi / 6, 1e-15));
  CHECK(volume(Plane{}) == std::numeric_limits<double>::infinity());
}

TEST_CASE("inertia of sphere, box and capsule is that of the tables") {
  CHECK(near(mass_properties({Sphere{0.5}}, 1).inertia, Mat3(0.1 * Mat3::Identity()), 1e-15));
  const Mat3 box = mass_properties({Box{Vec3(1, 0.2, 0.5)}}, 1).inertia;
  CHECK(near(Vec3(box.diagonal()), Vec3(0.09666666666666668, 0.41666666666666663, 0.3466666666666667), 1e-15));
  // A capsule without a cylinder is a ball.
  CHECK(near(mass_properties({Capsule{0.5, 0}}, 1).inertia, Mat3(0.1 * Mat3::Identity()), 1e-15));
  // Radius 1, cylinder 2 long, density 1 / pi: cylinder 2 kg, half balls 4/3 kg, by hand.
  const Mat3 capsule = mass_properties({Capsule{1, 1}}, 2 + 4.0 / 3).inertia;
  CHECK(near(capsule(1, 1), 1 + 8.0 / 15, 1e-14));
  CHECK(near(capsule(0, 0), 2 * (0.25 + 4.0 / 12) + 4.0 / 3 * (0.4 + 1 + 0.75), 1e-14));
}

TEST_CASE("the parallel-axis theorem turns a rod about its center into a rod about its end") {
  const MassProperties rod = mass_properties({Box{Vec3(1e-6, 1, 1e-6)}}, 3);
  CHECK(near(rod.inertia(0, 0), 3 * 4.0 / 12, 1e-9));
  CHECK(near(inertia_about(rod, Vec3(0, 1, 0))(0, 0), 3 * 4.0 / 3, 1e-9));
}

TEST_CASE("an offset moves the center of mass and turns the inertia") {
  Shape shape{Box{Vec3(1, 2, 3)}};
  shape.offset.position = Vec3(1, 0, -2);
  shape.offset.rotation = Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5));  // a quarter turn about z: x and y change places
  const MassProperties properties = mass_properties(shape, 12);
  CHECK(properties.center == Vec3(1, 0, -2));
  CHECK(near(Vec3(properties.inertia.diagonal()), Vec3(4 * (1 + 9), 4 * (4 + 9), 4 * (1 + 4)), 1e-14));
}

TEST_CASE("sizes that no solid can have are refused by name") {
  CHECK_THROWS_WITH_AS(validate(Sphere{0}), "radius of a sphere must be positive and finite, but is 0",
                       std::invalid_argument);
  CHECK_THROWS_AS(validate(Box{Vec3(1, -1, 1)}), std::invalid_argument);
  CHECK_THROWS_AS(validate(Capsule{1, -0.1}), std::invalid_argument);
  CHECK_THROWS_AS(validate(Plane{Vec3(0, 2, 0), 0}), std::invalid_argument);
  CHECK_THROWS_AS((void)mass_properties({Plane{}}, 1), std::invalid_argument);
  CHECK_THROWS_AS((void)mass_properties({Sphere{}}, 0), std::invalid_argument);
}

TEST_CASE("bounds touch the shape on every side") {
  Pose pose;
  pose.position = Vec3(1, 2, 3);
  pose.rotation = Quat(std::cos(0.125 * test::pi), 0, 0, std::sin(0.125 * test::pi));  // 45 degrees
  const Bounds box = bounds({Box{Vec3(1, 1, 1)}}, pose);
  CHECK(near(box.high, Vec3(1 + std::sqrt(2.0), 2 + std::sqrt(2.0), 4), 1e-14));
  const Bounds capsule = bounds({Capsule{0.5, 1}}, pose);
  CHECK(near(capsule.low, Vec3(0.5 - std::sqrt(0.5), 1.5 - std::sqrt(0.5), 2.5), 1e-14));
}

TEST_CASE("a turned cylinder has a cylinder's mass properties, and an open surface has none") {
  const auto edge = [](Vec2 from, Vec2 to) { return keyed_curve<Vec2>({{0, from, Ease::linear()}, {1, to}}); };
  // A cylinder of radius 1 and height 2 about y: m r^2 / 2, m (3 r^2 + h^2) / 12.
  const Curve<Vec2> wall = edge({1, 0}, {1, 2});
  const MassProperties cylinder = mass_properties(lathe(wall, {.segments = 500}), 3);
  CHECK(cylinder.mass == 3);
  CHECK(test::near(cylinder.center, Vec3(0, 1, 0), 1e-12));
  CHECK(test::near(cylinder.inertia, Mat3(Vec3(3 * 7.0 / 12, 1.5, 3 * 7.0 / 12).asDiagonal()), 1e-4));
  CHECK_THROWS_WITH_AS((void)mass_properties(lathe(wall, {.caps = false}), 3), doctest::Contains("open"),
                       std::invalid_argument);
  SurfaceMesh inside_out = lathe(wall);
  for (std::size_t i = 0; i < inside_out.triangles.size(); i += 3)
    std::swap(inside_out.triangles[i], inside_out.triangles[i + 1]);
  CHECK_THROWS_WITH_AS((void)mass_properties(inside_out, 3), doctest::Contains("outwards"), std::invalid_argument);
}
