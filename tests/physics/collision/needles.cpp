#include <tweenfall/physics/contact.h>
#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

/// Flat ground of 10 by 10 m, in squares of half a meter.
HeightField flat_field() {
  return {21, std::vector<double>(std::size_t{21} * 21, 0.0), 0.5, 0.5};
}

Solid needle(std::uint64_t kind, double thin, double half) {
  if (kind == 0) return Capsule{thin, half};
  if (kind == 1) return Box{Vec3(thin, half, thin)};
  if (kind == 2) return Cylinder{thin, half};
  return Cone{thin, half};
}

}  // namespace

TEST_CASE("what has come through one triangle touches those beside it, and nothing comes around a border") {
  const Shape field{flat_field()}, capsule{Capsule{0.02, 0.3}};
  for (const double middle : {0.0014, 0.01, 0.05}) {
    // The center is over one triangle, and the lower tip under another: 0.1 m and 0.3 m away along x.
    for (const double x : {0.1, -0.35, 0.4, 1.9}) {
      CAPTURE(middle);
      CAPTURE(x);
      const Quat tilt(Eigen::AngleAxisd(std::numbers::pi / 2 + 0.3, Vec3(0, 0, 1)));
      const Manifold manifold = collide(field, {}, capsule, {.position = Vec3(x, middle, 0.1), .rotation = tilt});
      REQUIRE(manifold.count >= 1);
      double deepest = 0;
      for (int i = 0; i < manifold.count; ++i)
        deepest = std::max(deepest, manifold.points[static_cast<std::size_t>(i)].penetration);
      // The lower tip's ball: 0.3 sin 0.3 below the center, and its radius.
      CHECK(deepest == doctest::Approx(0.3 * std::sin(0.3) + 0.02 - middle).epsilon(1e-9));
    }
  }
  // Over the edge at x = 5 the same capsule is beside the field, with its tip below it.
  const Quat under(Eigen::AngleAxisd(std::numbers::pi / 2 - 0.9, Vec3(0, 0, 1)));
  CHECK(collide(field, {}, capsule, {.position = Vec3(5.1, 0.05, 0.1), .rotation = under}).count == 0);
}

TEST_CASE("needles that are thrown at ground without thickness stay in front of it, however fast and turning") {
  test::Random random(5);
  int through = 0, touched = 0;
  for (int i = 0; i < 300; ++i) {
    World world;
    const double friction = random.unit(), restitution = i % 2 == 0 ? 0 : random.unit();
    world.add({.shape = {flat_field()}, .friction = friction, .restitution = restitution, .fixed = true});
    const double half = random.between(0.05, 0.4), thin = std::pow(10, random.between(-3, -1.5));
    const Vec3 way = Vec3(random.between(-1, 1), random.between(-1, -0.02), random.between(-1, 1)).normalized();
    Vec3 place = Vec3(random.between(-1, 1), 0, random.between(-1, 1)) - random.between(0.6, 3) * way;
    place.y() = std::max(place.y(), 0.5);
    const BodyId body = world.add({.shape = {needle(random.bits() % 4, thin, half)},
                                   .friction = friction,
                                   .restitution = restitution,
                                   .motion = {.pose = {.position = place, .rotation = random.rotation()},
                                              .twist = {std::pow(10, random.between(0.5, 2.5)) * way,
                                                        random.vector(std::pow(10, random.between(-1, 2)))}}});
    bool met = false;
    for (int step = 0; step < 40; ++step) {
      world.step(1.0 / 60);
      const Vec3 now = world.motion(body).pose.position;
      if (std::abs(now.x()) > 4.5 || std::abs(now.z()) > 4.5) break;
      met = met || !world.contacts().empty();
      if (now.y() > -0.5 * half) continue;
      ++through;
      break;
    }
    touched += met ? 1 : 0;
  }
  CHECK(touched > 200);
  CHECK(through == 0);
}
