#include <tweenfall/physics/mass_properties.h>
#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

/// Rods and plates of half a length, and a part of it in thickness.
Solid thin_solid(int kind, double thin, double length) {
  switch (kind) {
    case 0:
      return Box{Vec3(thin, length, thin)};
    case 1:
      return Cylinder{thin, length};
    case 2:
      return Cone{thin, length};
    case 3:
      return Capsule{thin, length};
    case 4:
      return TaperedCapsule{thin, 0.4 * thin, length};
    case 5:
      return Box{Vec3(length, thin, length)};
    case 6:
      return Cylinder{length, thin};
    case 7:
      return Box{Vec3(length, thin, 0.1 * length)};
    default:
      return Compound({Shape{Box{Vec3(thin, length, thin)}}, Shape{Capsule{thin, 0.5 * length}}});
  }
}

}  // namespace

TEST_CASE("rods and plates however thin fall in a heap of balls and boxes, and gain no energy") {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double ratio : {3e-2, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-12})
      for (int kind = 0; kind < 9; ++kind) {
        CAPTURE(scale);
        CAPTURE(ratio);
        CAPTURE(kind);
        test::Random random(static_cast<std::uint64_t>(7 + kind));
        World world({.gravity = Vec3(0, -9.81 * scale, 0), .push_out_speed = 0.5 * scale});
        world.add({.shape = {Plane{}}, .fixed = true});
        std::vector<BodyId> bodies;
        bodies.reserve(6);
        for (int i = 0; i < 6; ++i) {
          Pose pose;
          pose.position = Vec3(random.between(-0.5, 0.5), 1.7 + 2.6 * i, random.between(-0.5, 0.5)) * scale;
          pose.rotation = random.rotation();
          const Solid solid = i % 2 == 0 ? thin_solid(kind, ratio * scale, scale)
                              : i == 1   ? Solid(Sphere{0.3 * scale})
                                         : Solid(Box{Vec3(0.3, 0.3, 0.3) * scale});
          bodies.push_back(world.add({.shape = {solid}, .mass = 1.0, .motion = {.pose = pose}}));
        }
        const auto energy = [&] {
          double sum = world.kinetic_energy();
          for (const BodyId body : bodies) {
            const Pose pose = world.motion(body).pose;
            sum += 9.81 * scale * (pose.position + pose.rotation * world.mass(body).center).y();
          }
          return sum;
        };
        const double whole = energy();
        double last = whole, most = 0, gained = 0;
        for (int i = 0; i < 150; ++i) {
          world.step(1.0 / 60);
          const double now = energy();
          gained = std::max(gained, now - last);
          most = std::max(most, now);
          last = now;
        }
        CHECK(most < (1 + 1e-9) * whole);
        // Of what has been lost, a body that is pushed out of another one gets a little back.
        CHECK(gained < 0.03 * whole);
      }
}

TEST_CASE("the least moment of a needle is raised, that of a rod is not") {
  World world;
  const auto moments_of = [&](const Solid& solid) {
    return principal_axes(world.mass(world.add({.shape = {solid}, .mass = 2}))).moments;
  };
  // m (b^2 + c^2) / 3 with half extents
  CHECK(moments_of(Box{Vec3(0.01, 1, 0.01)})[0] == doctest::Approx(2 * 2e-4 / 3).epsilon(1e-12));
  const Vec3 needle = moments_of(Box{Vec3(1e-3, 1, 1e-3)});
  CHECK(needle[2] == doctest::Approx(2 * (1 + 1e-6) / 3).epsilon(1e-12));
  CHECK(needle[0] == doctest::Approx(1e-4 * needle[2]).epsilon(1e-9));
  // It is saved and loaded as it is, also where it was given.
  BodySettings given{.shape = {Capsule{1e-3, 1}}};
  given.mass_properties = mass_properties({Capsule{1e-3, 1}}, 2);
  given.motion.twist.angular = Vec3(1, 2, 3);
  world.add(given);
  World loaded;
  loaded.load(world.save());
  for (World* each : {&world, &loaded}) each->step(0.1);
  CHECK(loaded.state_hash() == world.state_hash());
}

TEST_CASE("a cone flatter than a thousandth is refused") {
  World world;
  world.add({.shape = {Cone{1, 1e-3}}});
  CHECK_THROWS_WITH(world.add({.shape = {Cone{2, 1e-3}}}),
                    "half height of a cone must be at least a thousandth of its radius, but is 0.001 of 2: use a "
                    "cylinder");
}
