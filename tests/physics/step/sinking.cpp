#include <tweenfall/physics/world.h>

#include "physics/grounds.h"

using namespace tweenfall;
using namespace tweenfall::test::grounds;

namespace {

/// How far the lowest point of a solid is from a plane through the origin, by the closed form of its support, m.
double height_over(const Solid& solid, const Pose& pose, const Vec3& up) {
  const Vec3 local = pose.rotation.conjugate() * up;
  const double across = std::hypot(local.x(), local.z());
  double reach = 0;
  if (const auto* box = std::get_if<Box>(&solid)) reach = local.cwiseAbs().dot(box->half_extents);
  if (const auto* cylinder = std::get_if<Cylinder>(&solid))
    reach = std::abs(local.y()) * cylinder->half_height + cylinder->radius * across;
  if (const auto* cone = std::get_if<Cone>(&solid))
    reach = std::max(-local.y() * cone->half_height, local.y() * cone->half_height + cone->radius * across);
  if (const auto* capsule = std::get_if<Capsule>(&solid))
    reach = std::abs(local.y()) * capsule->half_height + capsule->radius;
  if (const auto* drop = std::get_if<TaperedCapsule>(&solid))
    reach =
        std::max(drop->top_radius - local.y() * drop->half_height, drop->bottom_radius + local.y() * drop->half_height);
  if (const auto* hull = std::get_if<Hull>(&solid))
    for (const Vec3& vertex : hull->convex.vertices()) reach = std::max(reach, -local.dot(vertex));
  return up.dot(pose.position) - reach;
}

std::vector<Shape> floors() {
  const auto below = [](const Vec3& half) {
    Shape box{Box{half}};
    box.offset.position = Vec3(0, -half.y(), 0);
    return box;
  };
  std::vector<Shape> tiles;
  for (int x = -6; x < 6; ++x)
    for (int z = -3; z < 3; ++z) {
      tiles.push_back(below({0.5, 0.25, 0.5}));
      tiles.back().offset.position += Vec3(x + 0.5, 0, z + 0.5);
    }
  return {{Plane{}},
          below({20, 0.5, 20}),
          below({20, 0.02, 20}),
          {TriangleMesh(flat_floor(20, 20))},
          {HeightField(41, std::vector<double>(std::size_t{41} * 41, 0.0), 1, 1)},
          {Compound(tiles)}};
}

std::vector<Solid> tumblers() {
  return {Cylinder{0.15, 0.15},
          Cylinder{0.05, 0.3},
          Cylinder{0.15, 0.01},
          Cone{0.15, 0.15},
          TaperedCapsule{0.12, 0.06, 0.15},
          Capsule{0.1, 0.15},
          Box{{0.15, 0.15, 0.15}},
          Box{{0.2, 0.02, 0.15}},
          one_of_each()[3]};
}

/// How deep bodies in any position get that fall for half a second, m.
double deepest_of_falls(const Solid& solid, const Shape& floor, double speed, double spin, double tilt, double lean,
                        int falls) {
  const Quat turn(Eigen::AngleAxisd(tilt, Vec3(0, 0, 1)));
  const Vec3 up = turn * Vec3(0, 1, 0);
  double deepest = 0;
  for (int i = 0; i < falls; ++i) {
    test::Random random(1000 + static_cast<std::uint64_t>(i));
    World world(wide_awake());
    world.add({.shape = floor, .fixed = true, .motion = {.pose = placed_at(Vec3::Zero(), turn)}});
    BodySettings body{.shape = {solid}};
    const Quat any = random.rotation(),
               flat = turn * Quat(Eigen::AngleAxisd(lean * random.between(0, 1), any * Vec3(1, 0, 0)));
    body.motion.pose =
        placed_at(Vec3(0.013, 0, 0.017) + up * (0.6 + random.between(0, speed / 60)), lean > 0 ? flat : any);
    body.motion.twist.linear = Vec3(0, -speed, 0);
    body.motion.twist.angular = random.vector(spin);
    const BodyId id = world.add(body);
    for (int step = 0; step < 30; ++step) {
      world.step(1.0 / 60);
      const Pose pose = world.motion(id).pose;
      const Vec3 place = turn.conjugate() * pose.position;
      if (std::max(std::abs(place.x()), 2 * std::abs(place.z())) > 5) break;  // over the edge soon
      deepest = std::max(deepest, -height_over(solid, pose, up));
    }
  }
  return deepest;
}

}  // namespace

TEST_CASE("whatever falls flat or on its rim or corner onto any floor sinks in by no more than a few millimeters") {
  for (const Shape& floor : floors())
    for (const Solid& solid : tumblers()) {
      CAPTURE(kind_name(floor.solid));
      CAPTURE(kind_name(solid));
      CHECK(deepest_of_falls(solid, floor, 4, 5, 0, 0, 12) < 0.0085);
      CHECK(deepest_of_falls(solid, floor, 4, 1, 0, 0.2, 12) < 0.0085);
    }
}

TEST_CASE("whatever is dropped onto a ramp at 15 m/s sinks in by no more than a few millimeters") {
  for (const Shape& floor : floors())
    for (const Solid& solid : tumblers()) {
      CAPTURE(kind_name(floor.solid));
      CAPTURE(kind_name(solid));
      CHECK(deepest_of_falls(solid, floor, 15, 5, test::pi / 6, 0, 12) < 0.012);
    }
}
