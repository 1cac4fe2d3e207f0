#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>
#include <tweenfall/physics/mass_properties.h>

#include <limits>

#include "support.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

/// A unit tetrahedron with its corner at the origin, wound outwards.
SurfaceMesh corner() {
  return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

Vec3 diagonal(const MassProperties& properties) {
  return properties.inertia.diagonal();
}

}  // namespace

TEST_CASE("the lecture's two balls on a rod balance 0.4 m from the lighter one") {
  // 1 kg at 0 and 2 kg at 0.6 m; I = sum m r^2 about the center of mass.
  const MassProperties rod = mass_properties(std::vector<PointMass>{{1, {0, 0, 0}}, {2, {0.6, 0, 0}}});
  CHECK(rod.mass == 3);
  CHECK(near(rod.center, Vec3(0.4, 0, 0), 1e-15));
  CHECK(near(diagonal(rod), Vec3(0, 0.16 + 2 * 0.04, 0.24), 1e-15));
  CHECK(near(moment_about(rod, {0, 5, 0}, {0, 2, 0}), 2 * 0.36, 1e-15));
  CHECK(near(moment_about(rod, rod.center, {1, 1, 0}), 0.12, 1e-15));
  CHECK_THROWS_WITH((void)mass_properties(std::vector<PointMass>{{1, {0, 0, 0}}, {-2, {0.6, 0, 0}}}),
                    "point 1 of a system: mass must be positive and finite, but is -2");
  CHECK_THROWS_AS((void)mass_properties(std::span<const PointMass>()), std::invalid_argument);
}

TEST_CASE("cylinder, cone and ellipsoid are those of the tables") {
  // Goldstein, Poole, Safko, Classical Mechanics; Beer and Johnston, Vector Mechanics for Engineers, inside back cover.
  const MassProperties cylinder = mass_properties(Shape{Cylinder{0.5, 1}}, 12);
  CHECK(near(diagonal(cylinder), Vec3(3 * 0.25 + 4, 1.5, 3 * 0.25 + 4), 1e-14));
  const MassProperties cone = mass_properties(Shape{Cone{0.5, 1}}, 20);
  CHECK(near(cone.center, Vec3(0, -0.5, 0), 1e-15));
  CHECK(near(diagonal(cone), Vec3(3 * (0.25 + 1), 6 * 0.25, 3 * (0.25 + 1)), 1e-14));
  const MassProperties ellipsoid = mass_properties(Ellipsoid{{1, 2, 3}}, 5);
  CHECK(near(diagonal(ellipsoid), Vec3(13, 10, 5), 1e-14));
  CHECK(near(volume(Ellipsoid{{1, 2, 3}}), 8 * pi, 1e-14));
  CHECK_THROWS_WITH((void)mass_properties(Ellipsoid{{1, 0, 3}}, 5),
                    "semi-axis y of an ellipsoid must be positive and finite, but is 0");
}

TEST_CASE("solids that are none have no mass") {
  CHECK_THROWS_WITH((void)mass_properties(Shape{Sphere{-1}}, 1),
                    "radius of a sphere must be positive and finite, but is -1");
  CHECK_THROWS_WITH((void)mass_properties(Shape{Box{{0.5, 0, 0.5}}}, 1),
                    "half extent y of a box must be positive and finite, but is 0");
  CHECK_THROWS_AS((void)mass_properties(Shape{Cone{1, 0}}, 1), std::invalid_argument);
}

TEST_CASE("a tetrahedron's tensor is the published one, as a mesh and as a hull") {
  // Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor, 2004: of the unit corner at density 1 the
  // integral of x^2 is 1/60 and of x y 1/120, about the corner.
  const MassProperties mesh = mass_properties(corner(), 1.0 / 6);
  CHECK(near(mesh.center, Vec3(0.25, 0.25, 0.25), 1e-15));
  const Mat3 about = inertia_about(mesh, {0, 0, 0});
  CHECK(near(about(0, 0), 2.0 / 60, 1e-15));
  CHECK(near(about(0, 1), -1.0 / 120, 1e-15));
  const MassProperties hull = mass_properties(Shape{Hull{ConvexHull(corner())}}, 1.0 / 6);
  CHECK(near(hull.inertia, mesh.inertia, 1e-14));
}

TEST_CASE("parts together are the whole, wherever they are told from") {
  test::Random random(4);
  for (int i = 0; i < 20; ++i) {
    Pose place;
    place.position = random.vector(3);
    place.rotation = random.rotation();
    // A bar in two unequal pieces.
    Shape left{Box{{0.2, 0.3, 0.4}}}, right{Box{{0.6, 0.3, 0.4}}};
    left.offset.position = {-0.6, 0, 0};
    right.offset.position = {0.2, 0, 0};
    const MassProperties parts[] = {moved(mass_properties(left, 1), place), moved(mass_properties(right, 3), place)};
    const MassProperties together = mass_properties(parts);
    const MassProperties whole = moved(mass_properties(Shape{Box{{0.8, 0.3, 0.4}}}, 4), place);
    CHECK(near(together.center, whole.center, 1e-14));
    CHECK(near(together.inertia, whole.inertia, 1e-14));
    const PrincipalAxes principal = principal_axes(together);
    CHECK(near(principal.moments, Vec3(4 * 0.25 / 3, 4 * 0.73 / 3, 4 * 0.8 / 3), 1e-14));
  }
}

TEST_CASE("principal axes are those that a turn took the tensor's axes to") {
  test::Random random(9);
  for (const double size : {1e-6, 1.0, 1e6}) {
    Pose turned;
    turned.rotation = random.rotation();
    const MassProperties box = moved(mass_properties(Shape{Box{size * Vec3(3, 2, 1)}}, 3), turned);
    const PrincipalAxes found = principal_axes(box);
    CHECK(near(Vec3(found.moments / (size * size)), Vec3(5, 10, 13), 1e-13));
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = found.orientation * Vec3::Unit(i);
      CHECK(near(Vec3(box.inertia * axis / (size * size)), Vec3(found.moments[i] * axis / (size * size)), 1e-13));
    }
  }
}

TEST_CASE("an open mesh, one with a triangle turned round and one inside out are refused with the place") {
  SurfaceMesh open = corner();
  open.triangles.resize(9);
  CHECK_THROWS_WITH(
      (void)mass_properties(open, 1),
      "only a closed mesh has mass properties; this one has open edges: the edge from (1, 0, 0) to (0, 0, "
      "1) of triangle 1 has no triangle on its other side");
  SurfaceMesh turned = corner();
  std::swap(turned.triangles[9], turned.triangles[10]);
  CHECK_THROWS_WITH((void)mass_properties(turned, 1),
                    "triangles 1 and 3 of a mesh run the same way along the edge from (1, 0, 0) to (0, 0, 1): one of "
                    "them is wound inwards, or more than two meet there");
  SurfaceMesh inside_out = corner();
  for (std::size_t i = 0; i < inside_out.triangles.size(); i += 3)
    std::swap(inside_out.triangles[i], inside_out.triangles[i + 1]);
  CHECK_THROWS_WITH((void)mass_properties(inside_out, 1),
                    doctest::Contains("triangles wound outwards; this one is inside out, as its triangle"));
  SurfaceMesh fan = corner();  // a fin on an edge
  fan.positions.emplace_back(1, 1, 1);
  fan.triangles.insert(fan.triangles.end(), {1, 2, 4});
  CHECK_THROWS_WITH((void)mass_properties(fan, 1), doctest::Contains("more than two meet there"));
  SurfaceMesh flat{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {0, 1, 2, 0, 2, 1}};
  CHECK_THROWS_WITH((void)mass_properties(flat, 1), doctest::Contains("it encloses 0 m^3"));
  SurfaceMesh wrong = corner();
  wrong.triangles[7] = 9;
  CHECK(fault_of_solid(wrong) == "triangle 2 of a mesh names vertex 9, but there are only 4");
  wrong = corner();
  wrong.positions[3].z() = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of_solid(wrong) == "vertex 3 of a mesh must be finite, but is (0, 0, nan)");
  wrong.triangles.pop_back();
  CHECK(fault_of_solid(wrong) == "a triangle has three corners, but this mesh has 11 in all");
  CHECK(fault_of_solid({}) == "a mesh with mass needs triangles; this one has none");
  CHECK(fault_of_solid(corner()).empty());
}

TEST_CASE("a part of a mesh that is inside out is refused, unless it is a hollow of another") {
  const auto with = [](double size, const Vec3& place) {
    SurfaceMesh both = corner();
    for (const Vec3& vertex : corner().positions) both.positions.push_back(size * vertex + place);
    for (std::size_t i = 0; i < 12; i += 3)
      for (const std::size_t k : {1u, 0u, 2u}) both.triangles.push_back(4 + corner().triangles[i + k]);
    return both;
  };
  const MassProperties hollow = mass_properties(with(0.5, Vec3(0.1, 0.1, 0.1)), 7);
  CHECK(near(hollow.center, Vec3((8 * Vec3(0.25, 0.25, 0.25) - Vec3(0.225, 0.225, 0.225)) / 7), 1e-14));
  // One far off, and one within the other's bounds but beside it.
  for (const Vec3& place : {Vec3(5, 0, 0), Vec3(0.6, 0.6, 0.6)})
    CHECK_THROWS_WITH((void)mass_properties(with(0.2, place), 1),
                      doctest::Contains("a part of this mesh is inside out, as its triangle 4 at ("));
}

TEST_CASE("mass properties that nothing can have are refused") {
  MassProperties some = mass_properties(Shape{Box{{1, 2, 3}}}, 2);
  validate(some);
  some.inertia(0, 0) += 60;
  CHECK_THROWS_WITH(validate(some), doctest::Contains("exceed the sum of the others"));
  some.inertia = Mat3::Identity();
  some.inertia(0, 1) = 0.1;
  CHECK_THROWS_WITH(validate(some), doctest::Contains("symmetric"));
  some.inertia = -Mat3::Identity();
  CHECK_THROWS_WITH(validate(some), doctest::Contains("negative"));
  some.inertia(2, 2) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(validate(some), std::invalid_argument);
  CHECK_THROWS_WITH((void)mass_properties(std::vector<MassProperties>{some}), "part 0: inertia must be finite");
}
