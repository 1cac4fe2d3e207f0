#include <tweenfall/curves/rotation.h>

#include <algorithm>

#include "physics/joints/joint_scene.h"
#include "processor_time.h"
#include "support.h"

namespace tweenfall::jointed {

namespace {

/// A disk on a massless rod whose other end is a ball joint in the world's origin.
/// Source of all expected values: Goldstein, Classical Mechanics, 3rd edition, 5.7, the heavy symmetrical top.
struct Top {
  static constexpr double mass = 2, reach = 0.4, radius = 0.3, half = 0.03;
  static constexpr double along = 0.5 * mass * radius * radius;  ///< moment about its axis
  static constexpr double across =                               ///< and perpendicular to it, about the joint
      mass * (3 * radius * radius + 4 * half * half) / 12 + mass * reach * reach;

  World world{awake};
  BodyId disk;
  JointId joint;
  double spin, start;  ///< about its axis, rad/s; cosine of its tilt

  Top(double tilt, double spin_of_it, double precession) : spin(spin_of_it), start(std::cos(tilt)) {
    const Vec3 axis(std::sin(tilt), start, 0);
    const Vec3 angular = Vec3(0, precession, 0) + (spin - precession * start) * axis;
    disk = world.add({.shape = {Cylinder{radius, half}},
                      .mass = mass,
                      .motion = {.pose = {.position = reach * axis, .rotation = exp_map(Vec3(0, 0, -tilt))},
                                 .twist = {angular.cross(reach * axis), angular}}});
    joint = world.add_joint({.b = disk, .frame_b = {.position = Vec3(0, -reach, 0)}});
  }
  [[nodiscard]] Vec3 axis() const { return world.motion(disk).pose.rotation * Vec3(0, 1, 0); }
  /// Without nutation: m g r = along spin W - across W^2 cos(tilt), the slower of the two solutions.
  [[nodiscard]] static double steady(double tilt, double spin) {
    const double torque = mass * g * reach, whole = along * spin, turning = across * std::cos(tilt);
    return 2 * torque / (whole + std::sqrt(whole * whole - 4 * turning * torque));
  }
};

/// What a released top does: how far it sinks, and how long it takes to come up again.
struct Nutation {
  double lowest = 0;            ///< cosine of its tilt
  double period = 0, turn = 0;  ///< s, and rad about the vertical meanwhile
};

/// (du/dt)^2 = (start - u) (b (1 - u^2) - a^2 (start - u)) for the cosine u, solved and integrated here.
Nutation nutation_of(const Top& top) {
  const double a = Top::along * top.spin / Top::across, b = 2 * Top::mass * g * Top::reach / Top::across;
  double low = -1, high = top.start;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (b * (1 - middle * middle) < a * a * (top.start - middle) ? low : high) = middle;
  }
  Nutation nutation{low};
  const double third = a * a / b - low;
  constexpr int parts = 1000;
  for (int i = 0; i < parts; ++i) {
    const double u = 0.5 * (top.start + low) + 0.5 * (top.start - low) * std::cos(pi * (i + 0.5) / parts);
    const double time = 2 * pi / parts / std::sqrt(b * (third - u));
    nutation.period += time;
    nutation.turn += time * a * (top.start - u) / (1 - u * u);
  }
  return nutation;
}

/// How far its axis turns about the vertical, its least and greatest tilt, and the greatest change of its energy.
struct Course {
  double turn = 0, least = 10, greatest = 0, strayed = 0, spun = 0;
  int dips = 0;
  double first_dip = 0, last_dip = 0;  ///< s
};
Course course_of(Top& top, double time, double dt) {
  Course course;
  const double energy = energy_of(top.world);
  Vec3 axis = top.axis();
  double tilt = std::acos(axis.y()), rate = 0;
  while (top.world.time() < time - 0.5 * dt) {
    top.world.step(dt);
    const Vec3 next = top.axis();
    course.turn += std::remainder(std::atan2(-next.z(), next.x()) - std::atan2(-axis.z(), axis.x()), 2 * pi);
    axis = next;
    const double now = std::acos(axis.y());
    if (rate > 0 && now <= tilt) {
      // The approximate top of a parabola through the last three.
      course.last_dip = top.world.time() - dt * (1.5 - rate / (rate + tilt - now));
      if (course.dips++ == 0) course.first_dip = course.last_dip;
    }
    rate = now - tilt;
    tilt = now;
    course.least = std::min(course.least, tilt);
    course.greatest = std::max(course.greatest, tilt);
    course.strayed = std::max(course.strayed, std::abs(energy_of(top.world) - energy));
    course.spun = std::max(course.spun, std::abs(top.world.twist(top.disk).angular.dot(axis) - top.spin));
  }
  return course;
}

}  // namespace

TEST_CASE("a gyroscope on a ball joint turns about the vertical at its closed rate, and neither sinks nor slows") {
  for (const double rate : {60.0, 240.0})
    for (const double spin : {50.0, 200.0})
      for (const double tilt : {pi / 3, pi / 2}) {
        CAPTURE(rate);
        CAPTURE(spin);
        CAPTURE(tilt);
        const double expected = Top::steady(tilt, spin);
        Top top(tilt, spin, expected);
        const double start = energy_of(top.world);
        const Course course = course_of(top, 60, 1 / rate);
        const bool fine = rate > 100;
        const double share = course.turn / (60 * expected) - 1, sunk = course.greatest - tilt,
                     risen = tilt - course.least;
        MESSAGE(share, " of the way, sinks ", sunk, ", rises ", risen, " rad, energy by ", course.strayed, " J");
        CHECK(std::abs(share) < (fine ? 1e-3 : 1e-2));
        CHECK(sunk < (fine ? 1e-3 : 1e-2));
        CHECK(risen < (fine ? 1e-3 : 2e-2));
        CHECK(course.strayed < (fine ? 2e-4 : 2e-2) * start);
        CHECK(course.spun < (fine ? 1e-4 : 1e-2) * spin);
      }
}

TEST_CASE("a gyroscope that is let go nods as deep and as often as the closed form says, for minutes") {
  for (const double spin : {50.0, 200.0})
    for (const double tilt : {pi / 3, pi / 2}) {
      CAPTURE(spin);
      CAPTURE(tilt);
      Top top(tilt, spin, 0);
      const Nutation nutation = nutation_of(top);
      const double start = energy_of(top.world);
      const Course course = course_of(top, 120, 1.0 / 240);
      REQUIRE(course.dips > 100);
      const double period = (course.last_dip - course.first_dip) / (course.dips - 1);
      MESSAGE("every ", period, " s (", nutation.period, "), energy by ", course.strayed, " J");
      CHECK(course.greatest - tilt == doctest::Approx(std::acos(nutation.lowest) - tilt).epsilon(0.01));
      CHECK(course.least > tilt - 1e-3);
      CHECK(period == doctest::Approx(nutation.period).epsilon(2e-3));
      CHECK(course.turn / 120 == doctest::Approx(nutation.turn / nutation.period).epsilon(2e-3));
      CHECK(course.strayed < 4e-4 * start);
    }
}

TEST_CASE("what swings on a taut rope, or over pulleys, keeps its energy as on a rod") {
  const double swing = 2 * g * 3 * (1 - std::cos(1.0));
  for (const bool rope : {true, false})
    for (const double rate : {60.0, 240.0}) {
      CAPTURE(rope);
      CAPTURE(rate);
      World world(awake);
      const BodyId bob = add_ball(world, Vec3(3 * std::sin(1.0), -3 * std::cos(1.0), 0), 0.1, 2);
      const BodyId other = add_ball(world, Vec3(5, -3, 0), 0.1, 2.4);
      if (rope)
        world.add_joint({.b = bob, .kind = DistanceJoint{{0, 3}}});
      else
        world.add_joint({.a = bob, .b = other, .kind = PulleyJoint{Vec3(0, 0, 0), Vec3(5, 0, 0)}});
      if (rope) world.remove(other);
      const double before = energy_of(world);
      double strayed = 0;
      for (int i = 0; i < 20 * static_cast<int>(rate); ++i) {
        world.step(1 / rate);
        strayed = std::max(strayed, std::abs(energy_of(world) - before));
      }
      CHECK(strayed < 0.6 / rate * swing);
    }
}

TEST_CASE("a torque that makes a gyroscope faster at once than anything turns takes no longer than others") {
  for (const double torque : {1e9, 1e13, 1e20}) {
    CAPTURE(torque);
    Top top(0.3, 30, 0);
    top.world.apply_torque(top.disk, Vec3(0, torque, torque));
    const double begin = test::processor_seconds();
    try {
      for (int i = 0; i < 10; ++i) top.world.step(1.0 / 240);
    } catch (const NotFinite& fault) {
      CHECK(!fault.cause.empty());
    }
    CHECK(test::processor_seconds() - begin < 0.5);
  }
}

}  // namespace tweenfall::jointed
