#include <doctest/doctest.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <random>

#include "physics/joints/joint_scene.h"

namespace tweenfall::jointed {

namespace {

/// A door of 20 kg on a vertical hinge at its edge.
struct Door {
  World world;
  BodyId body;
  JointId hinge;
  explicit Door(const HingeJoint& kind, const WorldSettings& settings = weightless) : world(settings) {
    body = add_box(world, Vec3(0.5, 1, 0), Vec3(0.5, 1, 0.02), 20);
    hinge = join(world, {}, body, Vec3(0, 1, 0), kind, Vec3(0, 1, 0));
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 240); ++i) world.step(1.0 / 240);
  }
};

}  // namespace

TEST_CASE("a hard limit stops a door there, and a soft one gives way as its spring says") {
  Door hard(HingeJoint{.limits = Limits{-0.2, 1}});
  hard.world.apply_impulse(hard.body, Vec3(0, 0, -40), Vec3(1, 1, 0));
  double most = 0;
  for (int i = 0; i < 240 * 3; ++i) {
    hard.world.step(1.0 / 240);
    most = std::max(most, hard.world.reading(hard.hinge).position[0]);
  }
  CHECK(most == doctest::Approx(1).epsilon(1e-4));
  CHECK(hard.world.reading(hard.hinge).position[0] == doctest::Approx(1).epsilon(1e-4));

  Door soft(HingeJoint{.limits = Limits{0, 0.1, 0.5, 0}});
  const double speed = 0.6;
  const double inertia = 20 * (1.0 / 3 + 0.02 * 0.02 / 3);
  soft.world.apply_impulse(soft.body, Vec3(0, 0, -inertia * speed), Vec3(1, 1, 0));
  most = 0;
  for (int i = 0; i < 240 * 3; ++i) {
    soft.world.step(1.0 / 240);
    most = std::max(most, soft.world.reading(soft.hinge).position[0]);
  }
  // A spring of 0.5 Hz on the door's moment: it goes in by its speed divided by the angular frequency.
  CHECK(most == doctest::Approx(0.1 + speed / pi).epsilon(1e-2));
}

TEST_CASE("motors reach their speed, hold their position and give no more than their greatest force") {
  Door fast(HingeJoint{.motor = Motor{.speed = 3}});
  fast.run(0.1);
  CHECK(fast.world.reading(fast.hinge).rate[0] == doctest::Approx(3).epsilon(1e-6));

  const double inertia = 20 * (1.0 / 3 + 0.02 * 0.02 / 3);
  Door weak(HingeJoint{.motor = Motor{.speed = 3, .max_force = 5}});
  weak.run(1);
  CHECK(weak.world.reading(weak.hinge).rate[0] == doctest::Approx(5 / inertia).epsilon(1e-6));
  CHECK(weak.world.reading(weak.hinge).torque.y() == doctest::Approx(5).epsilon(1e-6));

  Door held(HingeJoint{.motor = Motor{.position = 2.5, .hz = 2, .zeta = 1}});
  held.run(3);
  CHECK(held.world.reading(held.hinge).position[0] == doctest::Approx(2.5).epsilon(1e-5));

  // An elevator: a slider that is held against gravity sags by g / w^2.
  World world(awake);
  const BodyId lift = add_box(world, Vec3(0, 0, 0), Vec3(1, 0.1, 1), 100);
  const JointId slider =
      join(world, {}, lift, Vec3(0, 0, 0), SliderJoint{.motor = Motor{.position = 1.0, .hz = 2}}, Vec3(0, 1, 0));
  for (int i = 0; i < 240 * 4; ++i) world.step(1.0 / 240);
  const double turning = 2 * pi * 2;
  CHECK(world.reading(slider).position[0] == doctest::Approx(1 - g / (turning * turning)).epsilon(1e-4));
  world.set_joint(slider, SliderJoint{.motor = Motor{.speed = 0.5}});
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  CHECK(world.reading(slider).rate[0] == doctest::Approx(0.5).epsilon(1e-6));
  CHECK(world.reading(slider).force.y() == doctest::Approx(100 * g).epsilon(1e-6));
}

TEST_CASE("a hinge counts whole turns") {
  Door door(HingeJoint{.motor = Motor{.speed = -7}});
  door.run(4);
  CHECK(door.world.reading(door.hinge).position[0] == doctest::Approx(-28).epsilon(1e-2));
  Door stopped(HingeJoint{.limits = Limits{-10, 10}, .motor = Motor{.speed = -7, .max_force = 1000}});
  stopped.run(4);
  CHECK(stopped.world.reading(stopped.hinge).position[0] == doctest::Approx(-10).epsilon(1e-4));
}

TEST_CASE("a joint breaks at its load and not below") {
  for (const double share : {0.99, 1.01}) {
    World world(awake);
    const BodyId load = add_ball(world, Vec3(0, -1, 0), 0.1, 10);
    const JointFrames frames = joint_frames(Pose{}, world.motion(load).pose, Vec3(0, 0, 0));
    const JointId joint =
        world.add_joint({.b = load, .frame_a = frames.a, .frame_b = frames.b, .break_force = 10 * g / share});
    bool told = false;
    for (int i = 0; i < 240; ++i) {
      world.step(1.0 / 240);
      for (const JointId& broken : world.broken_joints()) told = told || broken == joint;
    }
    CAPTURE(share);
    CHECK(world.contains(joint) == (share < 1));
    CHECK(told == (share > 1));
    CHECK((world.motion(load).pose.position.y() < -4) == (share > 1));
  }
  // By torque: a beam that sticks out.
  for (const double share : {0.99, 1.01}) {
    World world(awake);
    const BodyId beam = add_box(world, Vec3(1, 0, 0), Vec3(1, 0.1, 0.1), 2);
    const JointFrames frames = joint_frames(Pose{}, world.motion(beam).pose, Vec3(0, 0, 0));
    const JointId weld = world.add_joint(
        {.b = beam, .frame_a = frames.a, .frame_b = frames.b, .kind = FixedJoint{}, .break_torque = 2 * g * 1 / share});
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    CHECK(world.contains(weld) == (share < 1));
  }
}

TEST_CASE("a swing stays in its elliptic cone and a twist within its limits, whatever pushes them") {
  World world(weightless);
  const BodyId limb = add_box(world, Vec3(0.3, 0, 0), Vec3(0.3, 0.05, 0.08), 3);
  const SwingTwistJoint kind{.swing_y = 1.0, .swing_z = 0.4, .twist = {-0.3, 0.6}};
  const JointId joint = join(world, {}, limb, Vec3(0, 0, 0), kind, Vec3(1, 0, 0), Vec3(0, 1, 0));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double beyond = 0, twisted = 0, gap = 0, swung_y = 0, swung_z = 0;
  for (int i = 0; i < 240 * 20; ++i) {
    if (i % 24 == 0)
      world.apply_impulse(limb, 2 * Vec3(any(random), any(random), any(random)),
                          Vec3(0.5, any(random) * 0.1, any(random) * 0.1));
    world.step(1.0 / 240);
    const JointReading reading = world.reading(joint);
    swung_y = std::max(swung_y, std::abs(reading.position[1]));
    swung_z = std::max(swung_z, std::abs(reading.position[2]));
    beyond = std::max(beyond, std::hypot(reading.position[1] / 1.0, reading.position[2] / 0.4) - 1);
    twisted = std::max({twisted, reading.position[0] - 0.6, -0.3 - reading.position[0]});
    gap = std::max(gap, reading.gap);
  }
  CHECK(beyond < 0.02);
  CHECK(twisted < 0.01);
  CHECK(gap < 1e-4);
  // The limit was there.
  CHECK(swung_y > 0.9);
  CHECK(swung_z > 0.35);
}

TEST_CASE("a joint's rates are the derivatives of its coordinates") {
  const auto worst = [](const JointKind& kind, double dt) {
    World world(weightless);
    const BodyId a = add_box(world, Vec3(0, 0, 0), Vec3(0.3, 0.2, 0.1), 2);
    const BodyId b = add_box(world, Vec3(0.8, 0.1, 0), Vec3(0.3, 0.05, 0.08), 3);
    const JointId joint = join(world, a, b, Vec3(0.4, 0, 0), kind, Vec3(1, 0.2, 0.1), Vec3(0, 1, 0));
    world.apply_impulse(a, Vec3(0.3, 1, -1), Vec3(0.1, 0.2, 0.2));
    world.apply_impulse(b, Vec3(0.3, 1, 0.5), Vec3(0.9, 0.1, 0.2));
    for (int i = 0; i < 10; ++i) world.step(1.0 / 240);
    double off = 0;
    for (int i = 0; i < 20; ++i) {
      const JointReading before = world.reading(joint);
      world.step(dt);
      const JointReading after = world.reading(joint);
      for (std::size_t k = 0; k < static_cast<std::size_t>(before.coordinates); ++k)
        off = std::max(
            off, std::abs((after.position[k] - before.position[k]) / dt - 0.5 * (after.rate[k] + before.rate[k])));
    }
    return off;
  };
  const SwingTwistJoint limb{.swing_y = 3, .swing_z = 3, .twist = {-3, 3}};
  for (const JointKind& kind :
       std::initializer_list<JointKind>{HingeJoint{}, SliderJoint{}, UniversalJoint{}, limb, WheelJoint{.hz = 0},
                                        DistanceJoint{{0.1, 5}}, SpringJoint{.length = 0.5, .stiffness = 1}}) {
    CAPTURE(kind.index());
    CHECK(worst(kind, 1e-4) < 5e-3);
  }
}

TEST_CASE("a swing-twist joint turns its limb toward a rotation by its spring") {
  World world(weightless);
  const BodyId limb = add_box(world, Vec3(0.3, 0, 0), Vec3(0.3, 0.05, 0.08), 3);
  const Quat wanted = exp_map(Vec3(0.2, 0.5, -0.3));
  const SwingTwistJoint kind{.swing_y = 2, .swing_z = 2, .twist = {-1, 1}, .toward = wanted, .hz = 3};
  const JointId joint = join(world, {}, limb, Vec3(0, 0, 0), kind, Vec3(1, 0, 0), Vec3(0, 1, 0));
  for (int i = 0; i < 240 * 3; ++i) world.step(1.0 / 240);
  const JointSettings& settings = world.joint(joint);
  const Quat now = settings.frame_a.rotation.conjugate() * world.motion(limb).pose.rotation * settings.frame_b.rotation;
  CHECK(log_map(now * wanted.conjugate()).norm() < 1e-6);
}

TEST_CASE("a cart rolls on its wheels as fast as its motor turns them, and rests on its suspension") {
  World world(awake);
  world.add({.shape = {Plane{}}, .friction = 1, .fixed = true});
  const BodyId cart = add_box(world, Vec3(0, 0.7, 0), Vec3(0.8, 0.1, 0.3), 40);
  std::vector<JointId> wheels;
  for (const double x : {-0.6, 0.6})
    for (const double z : {-0.4, 0.4}) {
      const BodyId wheel = world.add(
          {.shape = {Sphere{0.3}}, .mass = 5, .friction = 1, .motion = {.pose = {.position = Vec3(x, 0.5, z)}}});
      wheels.push_back(join(world, cart, wheel, Vec3(x, 0.5, z),
                            WheelJoint{.hz = 3, .zeta = 0.7, .motor = Motor{.speed = -2, .max_force = 40}},
                            Vec3(0, 0, 1), Vec3(0, 1, 0)));
    }
  for (int i = 0; i < 240 * 6; ++i) world.step(1.0 / 240);
  CHECK(world.twist(cart).linear.x() == doctest::Approx(0.6).epsilon(1e-2));
  CHECK(std::abs(world.twist(cart).linear.z()) < 1e-3);
  double carried = 0;
  for (const JointId& wheel : wheels) {
    CHECK(world.reading(wheel).gap < 1e-4);
    carried += world.reading(wheel).force.y();
  }
  // The wheels carry the cart.
  CHECK(carried == doctest::Approx(-40 * g).epsilon(1e-2));
}

TEST_CASE("jointed bodies pass through each other unless told otherwise") {
  for (const bool collide : {false, true}) {
    World world(weightless);
    const BodyId a = add_ball(world, Vec3(0, 0, 0), 0.5, 1);
    const BodyId b = add_ball(world, Vec3(0.8, 0, 0), 0.5, 1);
    const JointId joint = world.add_joint({.a = a, .b = b, .kind = DistanceJoint{{0, 2}}, .collide = collide});
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    CHECK((world.reading(joint).position[0] > 0.95) == collide);
    world.remove_joint(joint);
    for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
    CHECK((world.motion(b).pose.position - world.motion(a).pose.position).norm() > 0.95);
  }
}

TEST_CASE("what hangs on a joint falls asleep together and wakes when either end is moved") {
  World world;
  std::vector<BodyId> links;
  for (int i = 0; i < 3; ++i) {
    links.push_back(add_box(world, Vec3(0, -0.5 - i, 0), Vec3(0.1, 0.5, 0.1), 1));
    join(world, i == 0 ? BodyId{} : links[static_cast<std::size_t>(i - 1)], links.back(), Vec3(0, -i, 0), BallJoint{});
  }
  for (int i = 0; i < 240 * 2; ++i) world.step(1.0 / 240);
  for (const BodyId& link : links) REQUIRE(world.asleep(link));
  world.apply_impulse(links[2], Vec3(1, 0, 0), Vec3(0, -3, 0));
  world.step(1.0 / 240);
  for (const BodyId& link : links) CHECK_FALSE(world.asleep(link));
  for (int i = 0; i < 240 * 60 && !world.asleep(links[0]); ++i) world.step(1.0 / 240);
  world.remove(links[0]);
  CHECK(world.joints().size() == 1);
  world.step(1.0 / 240);
  CHECK_FALSE(world.asleep(links[1]));
}

TEST_CASE("a copy of a jointed world steps to the same bits, and a far one changes none") {
  const auto build = [](World& world, double x) {
    world.add({.shape = {Box{Vec3(4, 0.5, 4)}}, .fixed = true, .motion = {.pose = {.position = Vec3(x, -0.5, 0)}}});
    BodyId last{};
    for (int i = 0; i < 5; ++i) {
      const BodyId link = add_box(world, Vec3(x + 0.5 * i, 2, 0), Vec3(0.25, 0.1, 0.1), 1);
      if (i > 0)
        join(world, last, link, Vec3(x + 0.5 * i - 0.25, 2, 0),
             SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.8, .twist = {-0.2, 0.2}}, Vec3(1, 0, 0));
      last = link;
    }
    return last;
  };
  World alone(awake), both(awake);
  const BodyId one = build(alone, 0);
  const BodyId same = build(both, 0);
  build(both, 1000);
  for (int i = 0; i < 300; ++i) {
    alone.step(1.0 / 120);
    both.step(1.0 / 120);
    if (i == 150) {
      World copy(alone);
      alone = copy;
    }
  }
  CHECK(alone.motion(one).pose.position == both.motion(same).pose.position);
  CHECK(alone.motion(one).pose.rotation.coeffs() == both.motion(same).pose.rotation.coeffs());
  World copy(alone);
  for (int i = 0; i < 50; ++i) {
    alone.step(1.0 / 120);
    copy.step(1.0 / 120);
    REQUIRE(alone.state_hash() == copy.state_hash());
  }
}

TEST_CASE("two jointed bodies fall through air to the same bits beside a weight on a pulley") {
  World alone(awake), beside(awake);
  std::array<BodyId, 2> firsts;
  for (World* world : {&alone, &beside}) {
    const BodyId first = add_box(*world, Vec3(0, 50, 0), Vec3(0.2, 0.1, 0.1), 1);
    const BodyId second = add_box(*world, Vec3(0.5, 50, 0), Vec3(0.2, 0.1, 0.1), 3);
    world->add_force(Drag{.linear = 0.5}, {.bodies = {first, second}});
    join(*world, first, second, Vec3(0.25, 50, 0), HingeJoint{}, Vec3(0, 0, 1));
    firsts[world == &alone ? 0 : 1] = first;
  }
  JointSettings pulley{.b = add_box(beside, Vec3(300, 0, 0), Vec3(0.2, 0.2, 0.2), 1)};
  pulley.frame_a.position = Vec3(302, 0, 0);
  pulley.kind = PulleyJoint{.pulley_a = Vec3(302, 5, 0), .pulley_b = Vec3(300, 5, 0)};
  beside.add_joint(pulley);
  for (int i = 0; i < 30; ++i) {
    alone.step(1.0 / 60);
    beside.step(1.0 / 60);
    REQUIRE(beside.motion(firsts[1]).pose.position == alone.motion(firsts[0]).pose.position);
  }
}

TEST_CASE("joints that contradict each other, and motors against each other, stay finite") {
  World world(awake);
  const BodyId a = add_box(world, Vec3(0, 0, 0), Vec3(0.2, 0.2, 0.2), 1);
  const BodyId b = add_box(world, Vec3(1, 0, 0), Vec3(0.2, 0.2, 0.2), 1e-3);
  join(world, {}, a, Vec3(0, 0, 0), FixedJoint{});
  join(world, a, b, Vec3(0.5, 0, 0), HingeJoint{.motor = Motor{.speed = 100}});
  join(world, a, b, Vec3(0.5, 0, 0), HingeJoint{.motor = Motor{.speed = -100}});
  world.add_joint({.a = a, .b = b, .kind = DistanceJoint{{5, 5}}});
  world.add_joint({.a = a, .b = b, .kind = DistanceJoint{{1, 1}}});
  world.add_joint({.b = b, .frame_a = {.position = Vec3(1e6, 0, 0)}, .kind = FixedJoint{}});
  for (int i = 0; i < 240 * 4; ++i) world.step(1.0 / 240);
  CHECK(world.motion(b).pose.position.allFinite());
  CHECK(world.motion(b).pose.position.norm() < 2e6);
}

TEST_CASE("a dozen joints that cannot all hold stay finite") {
  World world(awake);
  world.add({.shape = {Plane{}}, .fixed = true});
  const BodyId large = add_box(world, Vec3(0, 2, 0), Vec3(0.5, 1, 2), 4000);
  const BodyId small = add_box(world, Vec3(0.5, 2.5, 0), Vec3(0.2, 0.5, 0.2), 3);
  const BodyId ball = add_ball(world, Vec3(1, 1, 1), 0.3, 0.1);
  const Vec3 point(0.3, 2, 0.1);
  join(world, large, ball, point, HingeJoint{.motor = Motor{.position = 1.0}}, Vec3(0, 1, 1));
  join(world, large, small, point, HingeJoint{.limits = Limits{-2, 0}, .motor = Motor{.speed = 2}}, Vec3(1, 0, 0));
  join(world, large, small, point, UniversalJoint{.second_motor = Motor{.speed = 1}}, Vec3(1, 0, 0), Vec3(0, 0, 1));
  join(world, large, ball, point, WheelJoint{.motor = Motor{.speed = 6}});
  join(world, large, small, point, SwingTwistJoint{.swing_y = 0.5, .swing_z = 1, .twist = {-0.3, 0.3}});
  world.add_joint({.a = ball, .b = small, .frame_b = {.position = Vec3(0, 0.5, 0)}, .kind = FixedJoint{}});
  world.add_joint({.a = large, .b = ball, .kind = GearJoint{-2}});
  world.add_joint({.a = large, .b = ball, .kind = DistanceJoint{{2, 2}}});
  world.add_joint({.b = large, .kind = SliderJoint{.motor = Motor{.position = 0.5, .max_force = 10}}});
  world.add_joint({.b = ball, .frame_a = {.position = Vec3(0, 5, 0)}, .kind = SpringJoint{1, 1e6, 3}});
  for (int i = 0; i < 1000; ++i) world.step(0.01);
  for (const BodyId& body : {large, small, ball}) {
    CHECK(world.motion(body).pose.position.norm() < 1e9);
    CHECK(world.twist(body).linear.norm() < 1e9);
  }
}

TEST_CASE("a forearm whose cone is nearly a line keeps both its widths however it falls, and its joint holds") {
  constexpr double wide = 0.8, narrow = 0.06;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double widest = 0, narrowest = 0, gap = 0;
  for (int fall = 0; fall < 40; ++fall) {
    World world(awake);
    world.add({.shape = {Plane{Vec3(0, 1, 0), 0}}, .fixed = true});
    const auto limb = [&](double x, double mass) {
      return world.add({.shape = {Capsule{0.05, 0.1}},
                        .mass = mass,
                        .motion = {.pose = {.position = Vec3(x, 1, 0), .rotation = exp_map(Vec3(0, 0, pi / 2))}}});
    };
    const BodyId upper = limb(0, 3), lower = limb(0.3, 1.5);
    const JointId elbow =
        join(world, upper, lower, Vec3(0.15, 1, 0),
             SwingTwistJoint{.swing_y = wide, .swing_z = narrow, .twist = {-0.5, 0.5}}, Vec3(1, 0, 0));
    const Quat turn = exp_map(Vec3(any(random), any(random), any(random)) * pi);
    const Vec3 spin = Vec3(any(random), any(random), any(random)) * 10;
    for (const BodyId body : {upper, lower}) {
      const Motion motion = world.motion(body);
      const Vec3 arm = turn * Vec3(motion.pose.position - Vec3(0.15, 1, 0));
      world.set_motion(body, {.pose = {Vec3(0, 1, 0) + arm, turn * motion.pose.rotation, Vec3(1, 1, 1)},
                              .twist = {Vec3(0, -15, 0) + spin.cross(arm), spin}});
    }
    for (int i = 0; i < 90; ++i) {
      world.step(1.0 / 60);
      const JointReading reading = world.reading(elbow);
      widest = std::max(widest, std::abs(reading.position[1]));
      narrowest = std::max(narrowest, std::abs(reading.position[2]));
      gap = std::max(gap, reading.gap);
    }
  }
  CHECK(widest <= wide + 0.05);
  CHECK(narrowest <= narrow + 0.05);
  CHECK(gap <= 1e-4);
}

}  // namespace tweenfall::jointed
