#include <tweenfall/curves/elementary.h>
#include <tweenfall/physics/mass_properties.h>

#include <limits>

#include "support.h"

using namespace tweenfall;
using test::near;
using test::pi;

namespace {

/// Whether each number is as near as its error claims, and that error is small.
void check_within(const WeighedProperties& weighed, const MassProperties& expected, double most) {
  const MassProperties& is = weighed.properties;
  const double size = std::sqrt(expected.inertia.trace() / expected.mass);
  CHECK(weighed.mass_error <= most * expected.mass);
  CHECK(std::abs(is.mass - expected.mass) <= weighed.mass_error + 1e-13 * expected.mass);
  CHECK((is.center - expected.center).cwiseAbs().maxCoeff() <= weighed.center_error + 1e-13 * size);
  CHECK((is.inertia - expected.inertia).cwiseAbs().maxCoeff() <=
        weighed.inertia_error + 1e-13 * expected.mass * size * size);
  CHECK(weighed.evaluations > 0);
}

Density of(std::function<double(const Vec3&)> at) {
  return Density(std::move(at));
}

}  // namespace

TEST_CASE("every solid of an even density that is told as a function weighs as by its closed form") {
  test::Random random(7);
  const SurfaceMesh tetrahedron{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.1, 1}},
                                .triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  const std::vector<Solid> solids = {Sphere{0.3},
                                     Box{{1, 0.2, 0.5}},
                                     Capsule{0.4, 0.7},
                                     Capsule{0.4, 0},
                                     Cylinder{0.5, 0.1},
                                     Cone{0.3, 0.9},
                                     TaperedCapsule{0.4, 0.2, 0.5},
                                     Hull{ConvexHull(tetrahedron)},
                                     Compound({{Sphere{0.2}}, {Box{{0.1, 0.1, 0.1}}}})};
  for (const Solid& solid : solids) {
    CAPTURE(kind_name(solid));
    Shape shape{solid};
    shape.offset.position = random.vector(2);
    shape.offset.rotation = random.rotation();
    const Quadrature rough{.tolerance = 1e-7};
    const WeighedProperties told = weigh(shape, of([](const Vec3&) { return 700.0; }), rough);
    check_within(told, mass_properties(shape, 700 * volume(solid)), 1e-7);
    const WeighedProperties even = weigh(shape, Density(700));
    CHECK(even.properties.mass == 700 * volume(solid));
    CHECK(even.mass_error == 0);
    CHECK(even.evaluations == 0);
  }
  check_within(weigh(tetrahedron, of([](const Vec3&) { return 2.0; })), mass_properties(tetrahedron, 1.0 / 3), 1e-9);
  const Ellipsoid ellipsoid{{1, 0.5, 0.2}};
  check_within(weigh(ellipsoid, of([](const Vec3&) { return 3.0; }), {.tolerance = 1e-7}),
               mass_properties(ellipsoid, 3 * volume(ellipsoid)), 1e-7);
}

TEST_CASE("a bar that grows heavier along its way balances where the integral says") {
  // rho = a + b x over -h to h: c = b h^2 / (3 a), and the moment about an axis across at x = 0 is m h^2 / 3 as if
  // even.
  const Box bar{{2, 0.1, 0.1}};
  const WeighedProperties weighed = weigh(Shape{bar}, of([](const Vec3& r) { return 100 + 40 * r.x(); }));
  CHECK(near(weighed.properties.mass, 100 * volume(bar), 1e-12));
  CHECK(near(weighed.properties.center, Vec3(40.0 * 4 / 300, 0, 0), 1e-14));
  const double across = weighed.properties.mass * (4 + 0.01) / 3;
  CHECK(near(moment_about(weighed.properties, {0, 0, 0}, {0, 1, 0}), across, 1e-12));
  // From zero at one end: the center is two thirds of the way.
  const WeighedProperties wedge = weigh(Shape{bar}, of([](const Vec3& r) { return 2 + r.x(); }));
  CHECK(near(wedge.properties.center.x(), -2 + 4 * 2.0 / 3, 1e-13));
  // exp(x) times cos(y): sinh and sin, elementary integrals.
  const WeighedProperties curved =
      weigh(Shape{Box{{1, 1, 1}}}, of([](const Vec3& r) { return elementary::exp(r.x()) * elementary::cos(r.y()); }));
  const double mass = 8 * std::sinh(1.0) * std::sin(1.0);
  CHECK(std::abs(curved.properties.mass - mass) <= curved.mass_error);
  CHECK(curved.mass_error < 1.0000001e-9 * mass);
  CHECK(near(curved.properties.mass, mass, 1e-12));
  // Integral of x exp(x) over -1 to 1 is 2 / e; that of exp(x) 2 sinh 1.
  CHECK(near(curved.properties.center, Vec3(std::exp(-1.0) / std::sinh(1.0), 0, 0), 1e-12));
}

TEST_CASE("balls and rods whose density varies with the distance have their closed forms") {
  // rho = 1 - r / R: M = pi R^3 / 3, I = 4/15 M R^2.
  const double radius = 1.5;
  const WeighedProperties ball =
      weigh(Shape{Sphere{radius}}, of([&](const Vec3& r) { return 1 - r.norm() / radius; }), {.tolerance = 1e-8});
  CHECK(near(ball.properties.mass, pi * radius * radius * radius / 3, 1e-11));
  CHECK(near(ball.properties.inertia(1, 1) / (ball.properties.mass * radius * radius), 4.0 / 15, 1e-11));
  // rho = k s about a cylinder's axis: I = 3/5 M R^2.
  const WeighedProperties rod =
      weigh(Shape{Cylinder{0.5, 2}}, of([](const Vec3& r) { return std::hypot(r.x(), r.z()); }), {.tolerance = 1e-8});
  CHECK(near(rod.properties.mass, 2 * pi * 4 * 0.125 / 3, 1e-11));
  CHECK(near(rod.properties.inertia(1, 1), 0.6 * rod.properties.mass * 0.25, 1e-11));
}

TEST_CASE("a planet of a heavy core in a light mantle has the moment of its two layers") {
  // 8/15 pi (rho_core r^5 + rho_mantle (R^5 - r^5)); the jump is found by halving across it alone.
  const double core = 0.546;
  const WeighedProperties planet =
      weigh(Shape{Sphere{1}}, of([&](const Vec3& r) { return r.norm() < core ? 11.0 : 4.5; }), {.tolerance = 1e-5});
  const double fifth = core * core * core * core * core;
  MassProperties expected;
  expected.mass = 4 * pi / 3 * (11 * core * core * core + 4.5 * (1 - core * core * core));
  expected.inertia = 8 * pi / 15 * (11 * fifth + 4.5 * (1 - fifth)) * Mat3::Identity();
  check_within(planet, expected, 1e-5);
  CHECK(planet.evaluations < 300000);
}

TEST_CASE("a density is asked in the frame of the node, and only in the solid") {
  Shape shape{Capsule{0.2, 0.5}};
  shape.offset.position = {3, 0, 0};
  shape.offset.rotation = Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5));  // its length along -x
  double least = 9, most = 0;
  const WeighedProperties weighed = weigh(shape, of([&](const Vec3& r) {
                                            least = std::min(least, r.x());
                                            most = std::max(most, r.x());
                                            CHECK(std::hypot(r.y(), r.z()) < 0.2);
                                            return r.x();
                                          }),
                                          {.tolerance = 1e-4});
  CHECK(least > 2.3);
  CHECK(most < 3.7);
  // Linear: mass as if it were even, center displaced by the second moment divided by the mass.
  const MassProperties even = mass_properties(shape, 3 * volume(shape.solid));
  const double along = 0.5 * (even.inertia.trace() - 2 * even.inertia(0, 0)) / even.mass;
  CHECK(near(weighed.properties.mass, even.mass, 1e-9));
  CHECK(near(weighed.properties.center, Vec3(3 + along / 3, 0, 0), 1e-9));
}

TEST_CASE("densities that cannot be are refused with the place, and rough ones end with the error they have") {
  CHECK_THROWS_WITH(Density(-1), "density must be positive and finite, but is -1");
  CHECK_THROWS_WITH(Density(std::function<double(const Vec3&)>()), "a density must hold a number or a function");
  CHECK_THROWS_WITH((void)weigh(Shape{Box{}}, of([](const Vec3& r) { return r.x(); })),
                    doctest::Contains("density must be finite and not negative, but is -0."));
  CHECK_THROWS_WITH((void)weigh(Shape{Box{}}, of([](const Vec3&) { return std::numeric_limits<double>::quiet_NaN(); })),
                    doctest::Contains("but is nan kg/m^3 at ("));
  CHECK_THROWS_WITH((void)weigh(Shape{Box{}}, of([](const Vec3&) { return 0.0; })),
                    "a density must give some mass, but this one gives 0 kg");
  CHECK_THROWS_WITH((void)weigh(Shape{Plane{}}, Density(1)),
                    "a plane has no mass: only fixed and keyed bodies can be of this shape");
  CHECK_THROWS_AS((void)weigh(Shape{Plane{}}, of([](const Vec3&) { return 1.0; })), std::invalid_argument);
  CHECK_THROWS_AS((void)weigh(Shape{Sphere{-1}}, Density(1)), std::invalid_argument);
  CHECK_THROWS_AS((void)weigh(Shape{Box{}}, of([](const Vec3&) { return 1.0; }), {.tolerance = 0}),
                  std::invalid_argument);
  // Dust: no quadrature can follow it, and it says so.
  const WeighedProperties dust =
      weigh(Shape{Box{}}, of([](const Vec3& r) { return r.x() * 1e4 - std::floor(r.x() * 1e4) < 0.5 ? 1.0 : 0.0; }),
            {.tolerance = 1e-12, .most_evaluations = 20000});
  CHECK(dust.evaluations < 21000);
  CHECK(dust.mass_error > 1e-6);
  CHECK(std::abs(dust.properties.mass - 0.5) < 3 * dust.mass_error);
  // The largest and the smallest possible.
  for (const double size : {1e-6, 1e6}) {
    const WeighedProperties scaled = weigh(Shape{Sphere{size}}, of([](const Vec3&) { return 2.0; }));
    CHECK(near(scaled.properties.mass / (size * size * size), 8 * pi / 3, 1e-9));
  }
}
