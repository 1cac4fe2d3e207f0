#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

Quat turned_by(const Vec3& axis, double angle) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}

bool holds(const Cylinder& c, const Vec3& p) {
  return std::abs(p.y()) <= c.half_height && Vec2(p.x(), p.z()).norm() <= c.radius;
}
bool holds(const Cone& c, const Vec3& p) {
  return std::abs(p.y()) <= c.half_height &&
         Vec2(p.x(), p.z()).norm() <= c.radius * (c.half_height - p.y()) / (2 * c.half_height);
}
/// Some ball on the way from one to the other contains it.
bool holds(const TaperedCapsule& c, const Vec3& p) {
  for (int i = 0; i <= 400; ++i) {
    const double share = i / 400.0, radius = c.bottom_radius + share * (c.top_radius - c.bottom_radius);
    if ((p - Vec3(0, (2 * share - 1) * c.half_height, 0)).norm() <= radius) return true;
  }
  return false;
}

/// Sums over a fine grid, by symmetry over the half-plane of radius and height.
template <class Turned>
MassProperties counted(const Turned& solid, double reach) {
  constexpr int parts = 300;
  const double cell = reach / parts;
  double volume = 0, first = 0, along = 0, across = 0;
  for (int i = 0; i < parts; ++i)
    for (int k = -parts; k < parts; ++k) {
      const double r = (i + 0.5) * cell, y = (k + 0.5) * cell;
      if (!holds(solid, Vec3(r, y, 0))) continue;
      const double ring = 2 * test::pi * r * cell * cell;
      volume += ring;
      first += ring * y;
      along += ring * r * r;
      across += ring * (0.5 * r * r + y * y);
    }
  MassProperties result;
  result.mass = volume;
  result.center = Vec3(0, first / volume, 0);
  across -= first * first / volume;
  result.inertia = Vec3(across, along, across).asDiagonal();
  return result;
}

template <class Turned>
void check_mass(const Turned& solid, double reach) {
  const MassProperties counted_ones = counted(solid, reach);
  const MassProperties told = mass_properties({solid}, volume(solid));
  CHECK(std::abs(volume(solid) / counted_ones.mass - 1) < 3e-3);
  CHECK(near(told.center, counted_ones.center, 3e-3 * reach));
  CHECK((told.inertia - counted_ones.inertia).cwiseAbs().maxCoeff() < 6e-3 * told.inertia.cwiseAbs().maxCoeff());
}

WorldSettings wakeful() {
  WorldSettings settings;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  return settings;
}

BodySettings floor_of(double friction) {
  return {.shape = {Plane{}}, .friction = friction, .fixed = true};
}

BodySettings standing(const Solid& solid, const Vec3& position, const Quat& rotation = Quat(1, 0, 0, 0)) {
  BodySettings body{.shape = {solid}, .friction = 0.5};
  body.motion.pose.position = position;
  body.motion.pose.rotation = rotation;
  return body;
}

double energy_of(const World& world, BodyId id, double pull) {
  const Twist twist = world.twist(id);
  const MassProperties& mass = world.mass(id);
  const Motion motion = world.motion(id);
  const Mat3 axes = motion.pose.rotation.toRotationMatrix();
  const Vec3 center = motion.pose.position + axes * mass.center;
  return 0.5 * mass.mass * twist.linear.squaredNorm() +
         0.5 * twist.angular.dot(axes * mass.inertia * axes.transpose() * twist.angular) +
         mass.mass * pull * center.y();
}

}  // namespace

TEST_CASE("cylinders, cones and tapered capsules weigh what their closed forms say") {
  // Goldstein, Classical Mechanics: tables of moments.
  const MassProperties cylinder = mass_properties({Cylinder{0.3, 0.7}}, 2);
  CHECK(near(volume(Solid{Cylinder{0.3, 0.7}}), test::pi * 0.09 * 1.4, 1e-15));
  CHECK(cylinder.center == Vec3(0, 0, 0));
  CHECK(near(cylinder.inertia(1, 1), 0.5 * 2 * 0.09, 1e-14));
  CHECK(near(cylinder.inertia(0, 0), 2 * (3 * 0.09 + 1.4 * 1.4) / 12, 1e-14));
  const MassProperties cone = mass_properties({Cone{0.3, 0.7}}, 2);
  CHECK(near(volume(Solid{Cone{0.3, 0.7}}), test::pi * 0.09 * 1.4 / 3, 1e-15));
  CHECK(near(cone.center, Vec3(0, -0.7 + 1.4 / 4, 0), 1e-15));
  CHECK(near(cone.inertia(1, 1), 0.3 * 2 * 0.09, 1e-14));
  CHECK(near(cone.inertia(2, 2), 2 * (3.0 / 20 * 0.09 + 3.0 / 80 * 1.4 * 1.4), 1e-14));
  // With equal radii it is a capsule.
  const MassProperties even = mass_properties({TaperedCapsule{0.2, 0.2, 0.6}}, 3);
  const MassProperties capsule = mass_properties({Capsule{0.2, 0.6}}, 3);
  CHECK(near(volume(Solid{TaperedCapsule{0.2, 0.2, 0.6}}), volume(Solid{Capsule{0.2, 0.6}}), 1e-15));
  CHECK(near(even.inertia, capsule.inertia, 1e-14));
  // Nearly swallowed, it is the greater ball.
  const MassProperties swallowed = mass_properties({TaperedCapsule{0.5, 0.25, 0.125000001}}, 3);
  CHECK(near(swallowed.center, Vec3(0, -0.125, 0), 1e-6));
  CHECK(near(swallowed.inertia, mass_properties({Sphere{0.5}}, 3).inertia, 1e-6));
}

TEST_CASE("masses of turned solids agree with sums over a fine grid") {
  check_mass(Cylinder{0.4, 0.9}, 1);
  check_mass(Cone{0.8, 0.6}, 1);
  check_mass(TaperedCapsule{0.35, 0.1, 0.5}, 1);
  check_mass(TaperedCapsule{0.1, 0.3, 0.2}, 1);
}

TEST_CASE("sizes of turned solids that cannot be are refused with words") {
  CHECK_THROWS_WITH(validate(Cylinder{0, 1}), "radius of a cylinder must be positive and finite, but is 0");
  CHECK_THROWS_WITH(validate(Cone{1, -2}), "half height of a cone must be positive and finite, but is -2");
  CHECK_THROWS_WITH(
      validate(TaperedCapsule{0.5, 0.25, 0.125}),
      "the bottom ball of a tapered capsule, of radius 0.5, contains its other ball, of radius 0.25 and 0.25 "
      "m away; set them farther apart, or make it a sphere");
  CHECK_NOTHROW(validate(TaperedCapsule{0.5, 0.25, 0.126}));
  CHECK_NOTHROW(validate(TaperedCapsule{0.25, 0.25, 1e-9}));
}

TEST_CASE("bounds of turned solids touch them on all six sides") {
  test::Random random(4);
  for (const Solid& solid : {Solid{Cylinder{0.4, 0.2}}, Solid{Cone{0.3, 0.6}}, Solid{TaperedCapsule{0.3, 0.1, 0.5}}})
    for (int i = 0; i < 50; ++i) {
      Pose pose;
      pose.rotation = random.rotation();
      pose.position = random.vector(3);
      const Shape shape{solid};
      const Bounds box = bounds(shape, pose);
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
          // A wall exactly there is just touched, and no more.
          const Vec3 normal = -side * Vec3::Unit(axis);
          const double at = side > 0 ? box.high[axis] : box.low[axis];
          const Manifold met = collide(shape, pose, {Plane{normal, normal[axis] * at}}, {}, 1e-9);
          REQUIRE(met.count > 0);
          for (int k = 0; k < met.count; ++k) CHECK(met.points[static_cast<std::size_t>(k)].penetration < 1e-12);
        }
    }
}

TEST_CASE("a cylinder stands on its end for ten seconds on a plane, a box, a hull and a cylinder") {
  const std::vector<Vec3> corners = {{-1, 0, -1},  {1, 0, -1},  {1, 0, 1},  {-1, 0, 1},
                                     {-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}};
  Pose below;
  below.position = {0, -0.5, 0};
  const std::vector<Shape> grounds = {
      {Plane{}}, {Box{{1, 0.5, 1}}, below}, {Hull{ConvexHull(corners)}}, {Cylinder{1, 0.5}, below}};
  for (const double scale : {1e-3, 1.0, 1e3})
    for (std::size_t i = 0; i < grounds.size(); ++i) {
      if (scale != 1 && i == 2) continue;
      Shape ground = grounds[i];
      if (auto* box = std::get_if<Box>(&ground.solid)) box->half_extents *= scale;
      if (auto* cylinder = std::get_if<Cylinder>(&ground.solid)) *cylinder = {scale, 0.5 * scale};
      ground.offset.position *= scale;
      WorldSettings settings = wakeful();
      settings.gravity *= scale;
      World world(settings);
      world.add({.shape = ground, .friction = 0.5, .fixed = true});
      const BodyId body =
          world.add(standing(Cylinder{0.2 * scale, 0.5 * scale}, {0.1 * scale, 0.5 * scale, -0.2 * scale}));
      for (int k = 0; k < 600; ++k) world.step(1.0 / 60);
      const Motion motion = world.motion(body);
      CAPTURE(i);
      CAPTURE(scale);
      CHECK(near(Vec3(motion.pose.position / scale), Vec3(0.1, 0.5, -0.2), 2e-4));
      CHECK((motion.pose.rotation * Vec3(0, 1, 0)).y() > 1 - 1e-8);
      CHECK(world.twist(body).linear.norm() < 1e-6 * scale);
      REQUIRE(world.contacts().size() == 1);
      CHECK(world.contacts()[0].manifold.count == 4);
    }
}

TEST_CASE("a cylinder that leans more than its edge tips over, and one that leans less stands up again") {
  const double edge = std::atan2(0.2, 0.5);
  for (const bool over : {false, true}) {
    const double lean = over ? edge + 0.05 : edge - 0.05;
    World world(wakeful());
    world.add(floor_of(1));
    const double height = 0.5 * std::cos(lean) + 0.2 * std::sin(lean);
    const BodyId body = world.add(standing(Cylinder{0.2, 0.5}, {0, height, 0}, turned_by({0.3, 0, 1}, lean)));
    for (int k = 0; k < 600; ++k) world.step(1.0 / 120);
    const double up = (world.motion(body).pose.rotation * Vec3(0, 1, 0)).y();
    CAPTURE(over);
    if (over)
      CHECK(std::abs(up) < 1e-3);
    else
      CHECK(up > 0.9999);
  }
}

TEST_CASE("a cylinder rolls down a slope at two thirds of a slide's acceleration, and straight") {
  const double slope = 0.3;
  for (const bool on_box : {false, true}) {
    World world(wakeful());
    const Quat tilt = turned_by({0, 0, 1}, -slope);
    BodySettings ground = floor_of(0.8);
    if (on_box) {
      ground.shape = {Box{{50, 0.5, 50}}, {}};
      ground.shape.offset.position = {0, -0.5, 0};
    }
    ground.motion.pose.rotation = tilt;
    world.add(ground);
    BodySettings rod =
        standing(Cylinder{0.25, 0.6}, tilt * Vec3(0, 0.25, 0), tilt * turned_by({1, 0, 0}, test::pi / 2));
    rod.friction = 0.8;
    const BodyId body = world.add(rod);
    const double h = 1.0 / 240;
    for (int k = 0; k < 480; ++k) world.step(h);
    const Vec3 down = tilt * Vec3(1, 0, 0), velocity = world.twist(body).linear;
    CAPTURE(on_box);
    CHECK(std::abs(velocity.dot(down) / (2.0 / 3 * 9.81 * std::sin(slope) * 2) - 1) < 1e-4);
    CHECK((velocity - velocity.dot(down) * down).norm() < 1e-5);
    CHECK(std::abs((world.motion(body).pose.rotation * Vec3(0, 1, 0)).dot(Vec3(0, 0, 1))) > 1 - 1e-9);
    CHECK(std::abs((tilt.conjugate() * world.motion(body).pose.position).y() - 0.25) < 1e-5);
  }
}

TEST_CASE("a cone stands on its base, and lies on its side at the half angle of its tip") {
  World world(wakeful());
  world.add(floor_of(0.5));
  const Cone cone{0.3, 0.5};
  const BodyId upright = world.add(standing(cone, {0, 0.5, 0}));
  // Along its side the axis rises from the tip by the half angle.
  const double half_angle = std::atan2(0.3, 1.0);
  const Vec3 axis(std::cos(half_angle), std::sin(half_angle), 0);
  const Quat lying = Quat::FromTwoVectors(Vec3(0, -1, 0), axis);
  const BodyId side = world.add(standing(cone, Vec3(3, 0, 0) + 0.5 * axis, lying));
  for (int k = 0; k < 600; ++k) world.step(1.0 / 60);
  CHECK(near(world.motion(upright).pose.position, Vec3(0, 0.5, 0), 2e-4));
  CHECK((world.motion(upright).pose.rotation * Vec3(0, 1, 0)).y() > 1 - 1e-8);
  const Vec3 down = world.motion(side).pose.rotation * Vec3(0, -1, 0);
  CHECK(std::abs(down.y() - std::sin(half_angle)) < 1e-3);
  CHECK(near(world.motion(side).pose.position, Vec3(Vec3(3, 0, 0) + 0.5 * axis), 2e-3));
}

TEST_CASE("a rolling tapered capsule goes around the point in which its side meets the floor") {
  // Its side lies on the floor; the tip of the cone that it is a part of stays in place.
  const TaperedCapsule capsule{0.3, 0.15, 0.5};
  const double sine = (0.3 - 0.15) / 1.0, from_tip = 0.3 / sine;  // from the tip to the bottom ball's center
  const double rise = std::asin(sine);
  const Vec3 out(std::cos(rise), std::sin(rise), 0);
  BodySettings settings = standing(capsule, out * (from_tip - 0.5), Quat::FromTwoVectors(Vec3(0, -1, 0), out));
  settings.friction = 1;
  // Rolling: the line on the floor is at rest, and the axis goes around the tip at 1 rad/s.
  settings.motion.twist.angular = Vec3(-std::cos(rise) / std::sin(rise), 0, 0);
  settings.motion.twist.linear = settings.motion.twist.angular.cross(settings.motion.pose.position);
  const double radius = settings.motion.pose.position.x();
  const double turn = 2 * test::pi * radius / settings.motion.twist.linear.norm();
  double gain = 1;
  for (const int steps : {960, 3840}) {
    World world(wakeful());
    world.add(floor_of(1));
    const BodyId body = world.add(settings);
    const double before = energy_of(world, body, 9.81);
    double most_off = 0;
    for (int k = 0; k < steps; ++k) {
      world.step(turn / steps);
      const Vec3 p = world.motion(body).pose.position;
      most_off = std::max(most_off, std::abs(Vec2(p.x(), p.z()).norm() - radius));
    }
    CAPTURE(steps);
    CHECK(most_off < 6e-4);
    CHECK(near(world.motion(body).pose.position, settings.motion.pose.position, 20.0 / steps));
    // The error from turning its spin is of first order in the step.
    const double gained = std::abs(energy_of(world, body, 9.81) / before - 1);
    CHECK(gained < 5e-3);
    CHECK(gained < 0.3 * gain);
    gain = gained;
  }
}

TEST_CASE("points of a standing cylinder keep their numbers from step to step") {
  World world(wakeful());
  world.add(floor_of(0.5));
  world.add({.shape = {Box{{1, 0.5, 1}}}, .fixed = true, .motion = {.pose = {.position = {5, 0, 0}}}});
  (void)world.add(standing(Cylinder{0.2, 0.5}, {0, 0.5, 0}));
  (void)world.add(standing(Cylinder{0.2, 0.5}, {5, 1, 0}));
  for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
  const std::vector<Contact> before(world.contacts().begin(), world.contacts().end());
  REQUIRE(before.size() == 2);
  for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t point = 0; point < 4; ++point)
      CHECK(world.contacts()[i].manifold.points[point].feature == before[i].manifold.points[point].feature);
}

TEST_CASE("a gas of turned solids in a box never gains energy at restitution 1") {
  for (const Solid& solid :
       {Solid{Cylinder{0.15, 0.2}}, Solid{Cone{0.2, 0.2}}, Solid{TaperedCapsule{0.18, 0.1, 0.15}}}) {
    WorldSettings settings = wakeful();
    settings.gravity = Vec3::Zero();
    World world(settings);
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0})
        world.add({.shape = {Plane{-side * Vec3::Unit(axis), -1.2}}, .friction = 0, .restitution = 1, .fixed = true});
    test::Random random(11);
    std::vector<BodyId> bodies;
    double before = 0;
    for (int i = 0; i < 27; ++i) {
      BodySettings body = standing(solid, 0.75 * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1), random.rotation());
      body.friction = 0;
      body.restitution = 1;
      body.motion.twist.linear = random.vector(2);
      body.motion.twist.angular = random.vector(2);
      bodies.push_back(world.add(body));
    }
    for (const BodyId id : bodies) before += energy_of(world, id, 0);
    double most = 0, at_end = 0;
    for (int k = 0; k < 1200; ++k) {
      world.step(1.0 / 240);
      at_end = 0;
      for (const BodyId id : bodies) at_end += energy_of(world, id, 0);
      most = std::max(most, at_end);
    }
    CAPTURE(solid.index());
    CHECK(most < 1.01 * before);
    CHECK(at_end > 0.5 * before);
    for (const BodyId id : bodies) CHECK(world.motion(id).pose.position.cwiseAbs().maxCoeff() < 1.25);
  }
}

TEST_CASE("a fast cylinder does not pass through a thin wall, whichever way it flies") {
  test::Random random(23);
  for (int i = 0; i < 30; ++i) {
    World world({.gravity = {0, 0, 0}});
    world.add({.shape = {Box{{0.005, 5, 5}}}, .fixed = true});
    const Solid solid = i % 3 == 0   ? Solid{Cylinder{0.1, 0.3}}
                        : i % 3 == 1 ? Solid{Cone{0.2, 0.2}}
                                     : Solid{TaperedCapsule{0.1, 0.05, 0.2}};
    BodySettings body = standing(solid, {-3, 0, 0}, random.rotation());
    body.motion.twist.linear = {30, 0, 0};
    body.motion.twist.angular = random.vector(20);
    const BodyId id = world.add(body);
    for (int k = 0; k < 60; ++k) world.step(1.0 / 60);
    CAPTURE(i);
    CHECK(world.motion(id).pose.position.x() < 0);
  }
}
