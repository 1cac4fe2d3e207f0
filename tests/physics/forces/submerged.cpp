#include "shapes/submerged.h"

#include <tweenfall/curves/rotation.h>

#include <cmath>

#include "physics/scene.h"
#include "shapes/shadow.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

shapes::Submerged under(const Solid& solid, const Vec3& normal, double level) {
  return shapes::submerged({solid, {}}, normal, level);
}

std::vector<Solid> round_and_flat_solids() {
  const std::vector<Vec3> wedge{
      {-0.4, -0.3, -0.5}, {0.6, -0.3, -0.5}, {0.5, 0.7, -0.4}, {-0.4, -0.2, 0.5}, {0.3, 0.5, 0.6}};
  Pose aside;
  aside.position = Vec3(0.3, -0.1, 0.2);
  aside.rotation = exp_map(Vec3(0.3, 0.8, -0.4));
  return {Sphere{0.7},
          Box{Vec3(0.3, 0.5, 0.9)},
          Capsule{0.3, 0.6},
          Cylinder{0.4, 0.7},
          Cone{0.6, 0.5},
          TaperedCapsule{0.5, 0.2, 0.45},
          TaperedCapsule{0.2, 0.5, 0.45},
          Hull{ConvexHull(wedge)},
          Compound({{Box{Vec3(0.1, 0.4, 0.2)}, {}}, {Cone{0.3, 0.3}, aside}})};
}

}  // namespace

TEST_CASE("what is under a plane has the volumes of textbooks") {
  // Caps of a ball, pi h^2 (3 r - h) / 3; a corner of a box, a b c / 6; a tip of a cone, by the cube of its height.
  CHECK(near(under(Sphere{2}, Vec3(0, 0, 1), -1.5).volume, pi * 0.25 * (6 - 0.5) / 3, 1e-14));
  CHECK(near(under(Sphere{2}, Vec3(0, 0, 1), 0).center, Vec3(0, 0, -0.75), 1e-14));
  const Vec3 to_corner = Vec3(1, 1, 1).normalized();
  CHECK(near(under(Box{Vec3(1, 1, 1)}, to_corner, -2 / std::sqrt(3.0)).volume, 1.0 / 6, 1e-13));
  CHECK(near(under(Box{Vec3(1, 1, 1)}, to_corner, -2 / std::sqrt(3.0)).center, Vec3(-0.75, -0.75, -0.75), 1e-13));
  const double cone = pi * 0.36 / 3;
  CHECK(near(under(Cone{0.6, 0.5}, Vec3(0, -1, 0), -0.2).volume, cone * 0.027, 1e-13));
  CHECK(near(under(Cone{0.6, 0.5}, Vec3(0, -1, 0), -0.2).center, Vec3(0, 0.5 - 0.75 * 0.3, 0), 1e-12));
  // A lying cylinder: a segment of its circle, r^2 acos(d / r) - d sqrt(r^2 - d^2), along its whole length.
  const double segment = 0.16 * std::acos(0.25) - 0.1 * std::sqrt(0.16 - 0.01);
  CHECK(near(under(Cylinder{0.4, 0.7}, Vec3(1, 0, 0), -0.1).volume, 1.4 * segment, 1e-13));
  // A hoof of a cylinder, cut from a diameter of its base to its top: 2/3 r^2 h. Its center lies 3/16 pi r off the
  // axis.
  const Vec3 slant = Vec3(1.4, -0.4, 0).normalized();
  const shapes::Submerged hoof = under(Cylinder{0.4, 0.7}, -slant, -slant.dot(Vec3(0, -0.7, 0)));
  CHECK(near(hoof.volume, 2.0 / 3 * 0.16 * 1.4, 1e-11));
  CHECK(near(hoof.center.x(), 3 * pi / 16 * 0.4, 1e-10));
  // A lying capsule with a third of its diameter submerged: cylinder and ball, each cut at h = 0.2.
  const double across = 0.09 * std::acos(1.0 / 3) - 0.1 * std::sqrt(0.09 - 0.01);
  CHECK(near(under(Capsule{0.3, 0.6}, Vec3(0, 0, 1), -0.1).volume, 1.2 * across + pi * 0.04 * (0.9 - 0.2) / 3, 1e-11));
}

TEST_CASE("what is under and what is over make the whole, and the level moves the volume by the area that it cuts") {
  test::Random random(7);
  for (const Solid& solid : round_and_flat_solids()) {
    const std::string kind(kind_name(solid));
    CAPTURE(kind);
    const double whole = volume(solid);
    const Vec3 middle = mass_properties({solid, {}}, 1).center;
    for (int i = 0; i < 40; ++i) {
      Vec3 normal = random.vector(1).normalized();
      if (i == 0) normal = Vec3(0, 1, 0);
      if (i == 1) normal = Vec3(0, 0, -1);
      if (i == 2) normal = Vec3(1e-9, 1, 0).normalized();
      const double level = random.between(-0.6, 0.6);
      const shapes::Submerged below = under(solid, normal, level), above = under(solid, -normal, -level);
      CHECK(near(below.volume + above.volume, whole, 1e-9 * whole));
      CHECK(near(Vec3(below.volume * below.center + above.volume * above.center), Vec3(whole * middle), 2e-9));
      // Rising by slices: the moment of the center along the normal grows by level times what is added.
      const double h = 1e-4;
      const shapes::Submerged more = under(solid, normal, level + h), less = under(solid, normal, level - h);
      const double added = more.volume - less.volume;
      CHECK(std::abs(normal.dot(more.volume * more.center - less.volume * less.center) - level * added) < 1e-7 * whole);
      CHECK(added > -1e-14);
    }
    CHECK(under(solid, Vec3(0, 1, 0), 5).volume == whole);
    CHECK(under(solid, Vec3(0, 1, 0), -5).volume == 0);
  }
}

TEST_CASE("a node's own offset of a shape carries along what is under") {
  Shape shape{Cylinder{0.4, 0.7}, {}};
  shape.offset.position = Vec3(1, 2, 3);
  shape.offset.rotation = exp_map(Vec3(0.5, -0.3, 0.9));
  const Vec3 normal = Vec3(0.2, 0.9, -0.1).normalized();
  const double level = normal.dot(shape.offset.position) + 0.1;
  const shapes::Submerged there = shapes::submerged(shape, normal, level);
  const shapes::Submerged own = under(shape.solid, shape.offset.rotation.conjugate() * normal, 0.1);
  CHECK(near(there.volume, own.volume, 1e-13));
  CHECK(near(there.center, Vec3(shape.offset.position + shape.offset.rotation * own.center), 1e-13));
}

TEST_CASE("shadows have the areas of textbooks, and their mean is a quarter of the surface") {
  CHECK(near(shapes::shadow_of({Box{Vec3(1, 2, 3)}, {}}, Vec3(0, 1, 0)), 12, 1e-14));
  CHECK(near(shapes::shadow_of({Cone{0.6, 0.5}, {}}, Vec3(1, 0, 0)), 0.6, 1e-14));
  CHECK(near(shapes::shadow_of({Cone{0.6, 0.5}, {}}, Vec3(0, 1, 0)), pi * 0.36, 1e-14));
  // Cauchy's theorem for convex solids. Surfaces: 2 pi r (r + h), pi r (r + sqrt(r^2 + h^2)), 4 pi r^2 + 2 pi r h.
  const std::pair<Solid, double> solids[] = {{Cylinder{0.4, 0.7}, 2 * pi * 0.4 * (0.4 + 1.4)},
                                             {Cone{0.6, 0.5}, pi * 0.6 * (0.6 + std::sqrt(1.36))},
                                             {Capsule{0.3, 0.6}, 4 * pi * 0.09 + 2 * pi * 0.3 * 1.2},
                                             {TaperedCapsule{0.3, 0.3, 0.6}, 4 * pi * 0.09 + 2 * pi * 0.3 * 1.2},
                                             {Box{Vec3(0.5, 0.5, 1)}, 10}};
  for (const auto& [solid, surface] : solids) {
    const std::string kind(kind_name(solid));
    CAPTURE(kind);
    // Evenly spaced in height on the sphere.
    double sum = 0;
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i) {
      const double y = (i + 0.5) / steps, across = std::sqrt(1 - y * y), angle = 2 * pi * 0.61803398875 * i;
      sum += shapes::shadow_of({solid, {}}, Vec3(across * std::cos(angle), y, across * std::sin(angle)));
    }
    CHECK(near(sum / steps, surface / 4, 2e-3));
  }
  const std::vector<Vec3> corners{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
  CHECK(
      near(shapes::shadow_of({Hull{ConvexHull(corners)}, {}}, Vec3(1, 1, 1).normalized()), 4 * std::sqrt(3.0), 1e-13));
}
