#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/joint.h>
#include <tweenfall/physics/world.h>

#include <functional>
#include <numbers>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double pi = std::numbers::pi;

using Way = std::function<Motion(double time)>;

/// Up and down by `height` about 0, lowest at the time 0.
Way lift_of(double period, double height) {
  return [=](double time) {
    const double w = 2 * pi / period;
    Motion motion;
    motion.pose.position.y() = -height * std::cos(w * time);
    motion.twist.linear.y() = height * w * std::sin(w * time);
    return motion;
  };
}

/// Turning about an axis through the origin.
Way turning_about(const Vec3& axis, const std::function<Sample<double>(double time)>& angle) {
  return [=](double time) {
    const Sample<double> now = angle(time);
    Motion motion;
    motion.pose.rotation = exp_map(axis * now.value);
    motion.twist.angular = axis * now.rate;
    return motion;
  };
}

Way table_at(double spin) {
  return turning_about(Vec3(0, 1, 0), [=](double time) {
    Sample<double> angle;
    angle.value = spin * time;
    angle.rate = spin;
    return angle;
  });
}

/// A world with one body that follows a path, and its riders.
struct Ride {
  World world{{.sleep_after = std::numeric_limits<double>::infinity()}};
  Way way;
  double h;
  BodyId carrier;
  int steps = 0;

  Ride(const Shape& shape, Way goes, double rate) : way(std::move(goes)), h(1 / rate) {
    carrier = world.add({.shape = shape, .mass = 10.0, .friction = 0.8, .drive = Drive::keyed(), .motion = way(0)});
  }
  /// As if it were part of the carrier.
  BodyId add(const Shape& shape, const Vec3& place, double mass = 1) {
    const Motion start = way(0);
    Motion motion;
    motion.pose.rotation = start.pose.rotation;
    motion.pose.position = start.pose.position + start.pose.rotation * place;
    motion.twist = start.twist;
    motion.twist.linear += start.twist.angular.cross(start.pose.rotation * place);
    return world.add({.shape = shape, .mass = mass, .friction = 0.8, .motion = motion});
  }
  [[nodiscard]] double time() const { return steps * h; }
  /// Mean force of the carrier on what touches it, N.
  Vec3 step() {
    world.set_target(carrier, way(++steps * h));
    world.step(h);
    Vec3 impulse = Vec3::Zero();
    for (const Contact& contact : world.contacts())
      if (contact.a == carrier || contact.b == carrier)
        impulse += contact.a == carrier ? contact.total_impulse : Vec3(-contact.total_impulse);
    return impulse / h;
  }
};

Shape cube(double half) {
  return {Box{Vec3(half, half, half)}};
}

}  // namespace

TEST_CASE("an elevator's floor bears what it lifts and brakes, from the first step on, to a thousandth of the weight") {
  for (const double rate : {60.0, 240.0})
    for (const Vec2& up_and_down : {Vec2(2, 0.5), Vec2(1.6, 0.5), Vec2(2, 0.9)})
      for (const Shape& shape : {cube(0.25), Shape{Sphere{0.25}}, Shape{Capsule{0.1, 0.15}}})
        // Separate islands behave alike anyway: so many steps are made with only one.
        for (const int riders : {rate == 60 ? 9 : 1}) {
          CAPTURE(rate);
          const double period = up_and_down.x(), height = up_and_down.y();
          CAPTURE(period);
          CAPTURE(height);
          CAPTURE(shape.solid.index());
          CAPTURE(riders);
          Ride ride({Box{{9, 0.5, 5}}}, lift_of(period, height), rate);
          const double mass = 5.0 * riders;
          for (int i = 0; i < riders; ++i) ride.add(shape, Vec3(-4 + i, 0.75, 0), 5);
          double worst = 0;
          while (ride.time() < 2 * period) {
            const double before = ride.way(ride.time()).twist.linear.y();
            const double force = ride.step().y();
            const double after = ride.way(ride.time()).twist.linear.y();
            worst = std::max(worst, std::abs(force / mass - (9.81 + (after - before) / ride.h)) / 9.81);
          }
          CHECK(worst < 1e-3);
        }
}

TEST_CASE("under a stack of ten an elevator's floor bears all of them, within half a hundredth") {
  Ride ride({Box{{9, 0.5, 5}}}, lift_of(2, 0.5), 240);
  for (int i = 0; i < 10; ++i) ride.add(cube(0.25), Vec3(0, 0.75 + 0.5 * i, 0));
  double worst = 0;
  while (ride.time() < 4) {
    const double before = ride.way(ride.time()).twist.linear.y();
    const double force = ride.step().y();
    const double wanted = 10 * (9.81 + (ride.way(ride.time()).twist.linear.y() - before) / ride.h);
    if (ride.time() > 0.3) worst = std::max(worst, std::abs(force - wanted) / wanted);
  }
  CHECK(worst < 5e-3);
}

TEST_CASE("what rides on a turntable stays where it is on it, and has its velocity") {
  for (const double rate : {30.0, 60.0, 240.0})
    for (const double spin : {1.0, -2.5}) {
      CAPTURE(rate);
      CAPTURE(spin);
      Ride ride({Box{{3, 0.5, 3}}}, table_at(spin), rate);
      const BodyId near = ride.add(cube(0.1), Vec3(1, 0.6, 0));
      const BodyId far = ride.add({Cylinder{0.1, 0.1}}, Vec3(-0.6, 0.6, -0.9));
      while (ride.time() < 10) ride.step();
      const Motion table = ride.way(ride.time());
      for (const auto& [body, place] : {std::pair{near, Vec3(1, 0.6, 0)}, {far, Vec3(-0.6, 0.6, -0.9)}}) {
        const Vec3 there = table.pose.rotation * place;
        CHECK((ride.world.motion(body).pose.position - there).norm() < 1e-3 * std::abs(spin) * 30 / rate);
        CHECK((ride.world.twist(body).linear - table.twist.angular.cross(there)).norm() < 2e-3 * 30 / rate);
      }
    }
}

TEST_CASE("what rides on a turntable for a minute is a tenth of a millimeter from its place on it") {
  Ride ride({Cylinder{2, 0.5}}, table_at(1), 60);
  const BodyId rider = ride.add(cube(0.1), Vec3(1, 0.6, 0));
  while (ride.time() < 60) ride.step();
  const Quat turn = ride.way(ride.time()).pose.rotation;
  CHECK((ride.world.motion(rider).pose.position - turn * Vec3(1, 0.6, 0)).norm() < 1e-4);
}

TEST_CASE("a stack of four rides on a turntable within three millimeters in five seconds") {
  Ride ride({Box{{3, 0.5, 3}}}, table_at(1), 60);
  std::vector<BodyId> stack;
  stack.reserve(4);
  for (int i = 0; i < 4; ++i) stack.push_back(ride.add(cube(0.2), Vec3(1, 0.7 + 0.4 * i, 0)));
  while (ride.time() < 5) ride.step();
  for (const BodyId body : stack) {
    const Vec3 at = ride.world.motion(body).pose.position;
    CHECK(std::hypot(at.x(), at.z()) == doctest::Approx(1).epsilon(0.003));
  }
}

TEST_CASE("a ball that rolls on a turntable goes in a circle, by two sevenths of the table's turn") {
  // Source: Weltner, Stable circular orbits of freely moving balls on rotating discs, American Journal of Physics 47,
  // 1979.
  for (const Vec2& bound : {Vec2(60, 4e-3), Vec2(240, 3e-4)}) {
    const double rate = bound.x(), most = bound.y();
    CAPTURE(rate);
    const double spin = 2, radius = 0.2;
    Ride ride({Box{{9, 0.5, 9}}}, table_at(spin), rate);
    const Vec3 start(1, 0.5 + radius, 0), velocity(0, 0, 0.3);
    const Vec3 slip = Vec3(0, spin, 0).cross(start) - velocity;
    const BodyId ball = ride.world.add(
        {.shape = {Sphere{radius}},
         .mass = 1.0,
         .friction = 0.8,
         .motion = {.pose = {.position = start}, .twist = {velocity, Vec3(-slip.z(), 0, slip.x()) / radius}}});
    const double around = 2.0 / 7 * spin;
    double worst = 0;
    while (ride.time() < 5) {
      ride.step();
      const Vec3 gained = exp_map(Vec3(0, around * ride.time(), 0)) * velocity - velocity;
      const Vec3 there = start - Vec3(0, 1 / around, 0).cross(gained);
      worst = std::max(worst, (ride.world.motion(ball).pose.position - there).norm());
    }
    CHECK(worst < most);
  }
}

TEST_CASE("a box on a seesaw goes with it, and the seesaw bears its weight and what turns it") {
  for (const double rate : {60.0, 240.0}) {
    CAPTURE(rate);
    Ride ride({Box{{3, 0.1, 1}}},
              turning_about(Vec3(0, 0, 1),
                            [](double time) {
                              Sample<double> angle;
                              angle.value = 0.25 * std::sin(2 * time);
                              angle.rate = 0.5 * std::cos(2 * time);
                              return angle;
                            }),
              rate);
    const Vec3 place(1, 0.2, 0);
    const BodyId box = ride.add(cube(0.1), place);
    const auto velocity = [&] {
      const Motion board = ride.way(ride.time());
      return Vec3(board.twist.angular.cross(board.pose.rotation * place));
    };
    double off = 0, force_off = 0;
    while (ride.time() < 6) {
      const Vec3 before = velocity();
      const Vec3 force = ride.step();
      const Vec3 wanted = (velocity() - before) / ride.h + Vec3(0, 9.81, 0);
      off = std::max(off, (ride.world.motion(box).pose.position - ride.way(ride.time()).pose.rotation * place).norm());
      force_off = std::max(force_off, (force - wanted).norm() / wanted.norm());
    }
    CHECK(off < 1e-4);
    CHECK(force_off < 2e-3);
  }
}

TEST_CASE("what a weld held to a hand on its way leaves it with the hand's velocity") {
  for (const double rate : {60.0, 240.0}) {
    CAPTURE(rate);
    Ride ride(cube(0.1),
              turning_about(Vec3(0, 0, 1),
                            [](double time) {
                              Sample<double> angle;
                              angle.value = 1.5 * time * time;
                              angle.rate = 3 * time;
                              return angle;
                            }),
              rate);
    const Vec3 place(0.5, 1, 0);
    const BodyId box = ride.add(cube(0.2), place);
    const JointId weld = ride.world.add_joint({.a = ride.carrier,
                                               .b = box,
                                               .frame_a = {.position = Vec3(0.25, 0.5, 0)},
                                               .frame_b = {.position = Vec3(-0.25, -0.5, 0)},
                                               .kind = FixedJoint{}});
    while (ride.time() < 1) ride.step();
    ride.world.remove_joint(weld);
    const Motion hand = ride.way(ride.time());
    const Vec3 there = hand.pose.rotation * place;
    CHECK((ride.world.twist(box).linear - hand.twist.angular.cross(there)).norm() < 1e-5);
    CHECK((ride.world.twist(box).angular - hand.twist.angular).norm() < 1e-8);
    CHECK((ride.world.motion(box).pose.position - there).norm() < 1e-5);
  }
}
