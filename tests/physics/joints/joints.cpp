#include <doctest/doctest.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

#include "physics/joints/joint_scene.h"

namespace tweenfall::jointed {

namespace {

/// Greatest gap of all joints.
double widest_gap(const World& world) {
  double widest = 0;
  for (const JointId& joint : world.joints()) widest = std::max(widest, world.reading(joint).gap);
  return widest;
}

}  // namespace

TEST_CASE("a rod on a hinge swings with the period of the physical pendulum and keeps its energy") {
  World world(awake);
  const BodyId rod = world.add({.shape = {Box{Vec3(0.05, 0.5, 0.05)}},
                                .mass = 2,
                                .motion = {.pose = {.position = Vec3(0.5 * std::sin(0.1), 2 - 0.5 * std::cos(0.1), 0),
                                                    .rotation = exp_map(Vec3(0, 0, 0.1))}}});
  const JointId hinge = join(world, {}, rod, Vec3(0, 2, 0), HingeJoint{});
  const double inertia = 2.0 / 12 * (1 + 0.01) + 2 * 0.25;
  // Small swings, to the second order in the angle.
  const double period = 2 * pi * std::sqrt(inertia / (2 * g * 0.5)) * (1 + 0.01 / 16);
  const double swing_energy = 2 * g * 0.5 * (1 - std::cos(0.1));
  const double before = energy_of(world);
  double first = 0, latest = 0, gap = 0;
  int crossings = 0;
  double last = world.reading(hinge).position[0];
  for (int i = 0; i < 240 * 10; ++i) {
    world.step(1.0 / 240);
    const double angle = world.reading(hinge).position[0];
    if (last < -0.1 && angle >= -0.1) {  // its zero is where it began
      latest = world.time() - (angle + 0.1) / (angle - last) / 240;
      if (crossings++ == 0) first = latest;
    }
    last = angle;
    gap = std::max(gap, world.reading(hinge).gap);
  }
  REQUIRE(crossings >= 5);
  CHECK((latest - first) / (crossings - 1) == doctest::Approx(period).epsilon(1e-5));
  CHECK(gap < 1e-6);
  CHECK(std::abs(energy_of(world) - before) < 0.005 * swing_energy);
}

TEST_CASE("a conical pendulum on a ball joint turns at sqrt(g / h)") {
  World world(awake);
  const double reach = 0.6, height = 0.8;
  const double turning = std::sqrt(g / height);
  const BodyId bob = world.add({.shape = {Sphere{0.01}},
                                .mass = 1,
                                .motion = {.pose = {.position = Vec3(reach, -height, 0)},
                                           .twist = {Vec3(0, 0, -reach * turning), Vec3(0, turning, 0)}}});
  const JointId ball = join(world, {}, bob, Vec3(0, 0, 0), BallJoint{});
  for (int i = 0; i < 240 * 5; ++i) world.step(1.0 / 240);
  const Vec3 at = world.motion(bob).pose.position;
  CHECK(at.norm() == doctest::Approx(1).epsilon(1e-6));
  CHECK(at.y() == doctest::Approx(-height).epsilon(2e-3));
  const double angle = turning * 5;
  CHECK(std::remainder(std::atan2(-at.z(), at.x()) - angle, 2 * pi) == doctest::Approx(0).epsilon(2e-2));
  // The tension carries the weight and turns the bob.
  CHECK(world.reading(ball).force.norm() == doctest::Approx(g / height).epsilon(2e-3));
}

TEST_CASE("bodies that joints alone hold together fly with their center of mass on a parabola and keep their momenta") {
  for (const double dt : {1.0 / 30, 1.0 / 240}) {
    World world(awake);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<BodyId> links;
    for (int i = 0; i < 6; ++i) {
      links.push_back(add_box(world, Vec3(0.4 * i, 10, 0), Vec3(0.2, 0.05, 0.08), 1 + i));
      if (i > 0) join(world, links[i - 1], links[i], Vec3(0.4 * i - 0.2, 10, 0), BallJoint{});
    }
    for (const BodyId& link : links)
      world.apply_impulse(link, Vec3(any(random), any(random), any(random)), world.motion(link).pose.position);
    double mass = 0;
    const auto center = [&] {
      mass = 0;
      Vec3 sum = Vec3::Zero();
      for (const BodyId& link : links) {
        sum += world.mass(link).mass * world.motion(link).pose.position;
        mass += world.mass(link).mass;
      }
      return Vec3(sum / mass);
    };
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (const BodyId& link : links) sum += world.mass(link).mass * world.twist(link).linear;
      return sum;
    };
    const auto spin = [&] {
      Vec3 sum = Vec3::Zero();
      const Vec3 middle = center();
      for (const BodyId& link : links) {
        const Motion motion = world.motion(link);
        const Mat3 turn = motion.pose.rotation.toRotationMatrix();
        sum += world.mass(link).mass * (motion.pose.position - middle).cross(world.twist(link).linear) +
               turn * world.mass(link).inertia * turn.transpose() * world.twist(link).angular;
      }
      return sum;
    };
    const Vec3 start = center(), before = momentum(), spun = spin();
    const int steps = static_cast<int>(std::lround(1 / dt));
    for (int i = 0; i < steps; ++i) world.step(dt);
    const Vec3 parabola = start + before / mass - Vec3(0, 0.5 * g, 0);
    CHECK((center() - parabola).norm() < 1e-9);
    CHECK((momentum() - before + Vec3(0, mass * g, 0)).norm() < 1e-10);
    CAPTURE(dt);
    CHECK((spin() - spun).norm() < 0.02 * spun.norm());
    CHECK(widest_gap(world) < 1e-3);
  }
}

TEST_CASE("a chain of twenty links with a ball of fifty times a link's mass hangs by the sum of the weights") {
  World world(awake);
  std::vector<BodyId> links;
  std::vector<JointId> joints;
  for (int i = 0; i < 20; ++i) {
    links.push_back(add_box(world, Vec3(0.1 + 0.2 * i, 0, 0), Vec3(0.1, 0.02, 0.02), 1));
    joints.push_back(join(world, i == 0 ? BodyId{} : links[static_cast<std::size_t>(i - 1)], links.back(),
                          Vec3(0.2 * i, 0, 0), BallJoint{}));
  }
  const BodyId ball = add_ball(world, Vec3(4.2, 0, 0), 0.2, 50);
  joints.push_back(join(world, links.back(), ball, Vec3(4, 0, 0), BallJoint{}));
  double widest = 0;
  const double before = energy_of(world);
  for (int i = 0; i < 240 * 4; ++i) {
    world.step(1.0 / 240);
    widest = std::max(widest, widest_gap(world));
    // Of some 2,000 J of fall.
    REQUIRE(energy_of(world) < before + 2);
  }
  CHECK(widest < 5e-5);
  // When hanging at rest, each joint carries everything below it.
  World hung(awake);
  std::vector<JointId> carried;
  BodyId above{};
  for (int i = 0; i < 20; ++i) {
    const BodyId link = add_box(hung, Vec3(0, -0.1 - 0.2 * i, 0), Vec3(0.02, 0.1, 0.02), 1);
    carried.push_back(join(hung, above, link, Vec3(0, -0.2 * i, 0), BallJoint{}));
    above = link;
  }
  carried.push_back(join(hung, above, add_ball(hung, Vec3(0, -4.2, 0), 0.2, 50), Vec3(0, -4, 0), BallJoint{}));
  for (int i = 0; i < 240 * 4; ++i) hung.step(1.0 / 240);
  for (int i = 0; i <= 20; ++i)
    CHECK(hung.reading(carried[static_cast<std::size_t>(i)]).force.y() == doctest::Approx((70 - i) * g).epsilon(1e-6));
  CHECK(widest_gap(hung) < 1e-7);
}

TEST_CASE("a slider moves along its axis alone, under the share of gravity that lies along it") {
  World world(awake);
  const Vec3 axis = Vec3(1, -1, 0).normalized();
  const BodyId body = add_box(world, Vec3(0, 0, 0), Vec3(0.3, 0.1, 0.2), 3);
  const JointId slider = join(world, {}, body, Vec3(0.2, 0.1, 0), SliderJoint{}, axis);
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  const double way = 0.5 * g * std::sqrt(0.5);
  CHECK(world.reading(slider).position[0] == doctest::Approx(way).epsilon(1e-3));
  CHECK(world.reading(slider).rate[0] == doctest::Approx(2 * way).epsilon(1e-9));
  CHECK((world.motion(body).pose.position - axis * world.reading(slider).position[0]).norm() < 1e-7);
  CHECK(std::abs(world.motion(body).pose.rotation.w()) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a weld carries force and torque and lets nothing move") {
  World world(awake);
  const BodyId body = add_box(world, Vec3(1, 0, 0), Vec3(0.5, 0.1, 0.1), 4);
  const JointId weld = join(world, {}, body, Vec3(0.5, 0, 0), FixedJoint{});
  for (int i = 0; i < 240; ++i) world.step(1.0 / 240);
  CHECK((world.motion(body).pose.position - Vec3(1, 0, 0)).norm() < 1e-7);
  CHECK((world.reading(weld).force - Vec3(0, 4 * g, 0)).norm() < 1e-6);
  CHECK((world.reading(weld).torque - Vec3(0, 0, 4 * g * 0.5)).norm() < 1e-6);
}

TEST_CASE("a rod keeps its length, and a rope keeps only from being longer") {
  World world(awake);
  const BodyId bob = add_ball(world, Vec3(3, 0, 0), 0.1, 2);
  join(world, {}, bob, Vec3(0, 0, 0), BallJoint{});
  const BodyId on_rope = add_ball(world, Vec3(1, 0, 5), 0.1, 2);
  const JointId rope =
      world.add_joint({.b = on_rope, .frame_a = {.position = Vec3(0, 0, 5)}, .kind = DistanceJoint{{0, 2}}});
  const BodyId on_rod = add_ball(world, Vec3(1.5, 0, 9), 0.1, 2);
  const JointId rod =
      world.add_joint({.b = on_rod, .frame_a = {.position = Vec3(0, 0, 9)}, .kind = DistanceJoint{{1.5, 1.5}}});
  double longest = 0, rod_off = 0;
  bool fell_free = true;
  for (int i = 0; i < 240 * 5; ++i) {
    world.step(1.0 / 240);
    longest = std::max(longest, world.reading(rope).position[0]);
    rod_off = std::max(rod_off, std::abs(world.reading(rod).position[0] - 1.5));
    const double time = world.time();
    // Straight down until the rope is taut: 1^2 + (g t^2 / 2)^2 = 2^2.
    if (0.5 * g * time * time < std::sqrt(3.0) - 0.05)
      fell_free = fell_free && std::abs(world.motion(on_rope).pose.position.y() + 0.5 * g * time * time) < 1e-3;
  }
  CHECK(fell_free);
  CHECK(longest < 2 + 1e-4);
  CHECK(rod_off < 1e-5);
  CHECK(world.reading(rod).gap < 1e-5);
}

TEST_CASE("a universal joint passes one turn on with the rates of Hooke's joint") {
  // Two shafts at an angle b: tan(out) = tan(in) / cos(b), so that w_out/w_in swings between cos(b) and 1/cos(b).
  World world(weightless);
  const double bend = 0.5;
  const Vec3 along(std::cos(bend), std::sin(bend), 0);
  const BodyId in = add_box(world, Vec3(-0.5, 0, 0), Vec3(0.4, 0.05, 0.05), 1);
  const BodyId out = world.add({.shape = {Box{Vec3(0.4, 0.05, 0.05)}},
                                .mass = 1,
                                .motion = {.pose = {.position = 0.5 * along, .rotation = exp_map(Vec3(0, 0, bend))}}});
  join(world, {}, in, Vec3(-0.5, 0, 0), HingeJoint{.motor = Motor{.speed = 2}}, Vec3(1, 0, 0));
  const JointId held = join(world, {}, out, 0.5 * along, HingeJoint{}, along);
  // x along the shaft that drives, y along the axis of the other's fork.
  const Vec3 fork(0, 0, 1);
  const Pose in_pose = world.motion(in).pose, out_pose = world.motion(out).pose;
  // The cross piece's axes: the first is a fork on `in` across its shaft, the second one on `out` across its own.
  const Vec3 first = Vec3(0, 1, 0);
  const JointFrames a = joint_frames(in_pose, out_pose, Vec3(0, 0, 0), first, fork);
  const JointFrames b = joint_frames(in_pose, out_pose, Vec3(0, 0, 0), along.cross(fork), fork);
  world.add_joint({.a = in, .b = out, .frame_a = a.a, .frame_b = b.b, .kind = UniversalJoint{}});
  double least = 1e9, most = 0;
  for (int i = 0; i < 240 * 4; ++i) {
    world.step(1.0 / 240);
    if (i < 240) continue;
    least = std::min(least, world.reading(held).rate[0]);
    most = std::max(most, world.reading(held).rate[0]);
  }
  CHECK(least == doctest::Approx(2 * std::cos(bend)).epsilon(1e-2));
  CHECK(most == doctest::Approx(2 / std::cos(bend)).epsilon(1e-2));
  CHECK(widest_gap(world) < 1e-3);
}

TEST_CASE("a pulley is Atwood's machine: the bodies accelerate by g (m1 - m2) / (m1 + m2)") {
  World world(awake);
  const BodyId light = add_ball(world, Vec3(-1, -2, 0), 0.1, 1);
  const BodyId heavy = add_ball(world, Vec3(1, -2, 0), 0.1, 3);
  const JointId rope = world.add_joint(
      {.a = light, .b = heavy, .kind = PulleyJoint{.pulley_a = Vec3(-1, 0, 0), .pulley_b = Vec3(1, 0, 0)}});
  for (int i = 0; i < 120; ++i) world.step(1.0 / 240);
  CHECK(world.twist(heavy).linear.y() == doctest::Approx(-g / 2 * 0.5).epsilon(1e-6));
  CHECK(world.twist(light).linear.y() == doctest::Approx(g / 2 * 0.5).epsilon(1e-6));
  CHECK(world.reading(rope).position[0] == doctest::Approx(4).epsilon(1e-6));
  CHECK(world.reading(rope).force.norm() == doctest::Approx(2 * 1 * 3 * g / 4).epsilon(1e-4));
}

TEST_CASE("gears turn by their ratio, for whole turns too") {
  World world(weightless);
  const BodyId small = add_box(world, Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.05), 1);
  const BodyId large = add_box(world, Vec3(1, 0, 0), Vec3(0.3, 0.3, 0.05), 5);
  const JointId first = join(world, {}, small, Vec3(0, 0, 0), HingeJoint{.motor = Motor{.speed = 5}});
  const JointId second = join(world, {}, large, Vec3(1, 0, 0), HingeJoint{});
  const JointFrames frames =
      joint_frames(world.motion(small).pose, world.motion(large).pose, Vec3(0, 0, 0), Vec3(0, 0, 1));
  world.add_joint({.a = small, .b = large, .frame_a = frames.a, .frame_b = frames.b, .kind = GearJoint{1.0 / 3}});
  for (int i = 0; i < 240 * 6; ++i) world.step(1.0 / 240);
  CHECK(world.reading(first).rate[0] == doctest::Approx(5).epsilon(1e-6));
  CHECK(world.reading(second).rate[0] == doctest::Approx(-5.0 / 3).epsilon(1e-6));
  CHECK(world.reading(second).position[0] == doctest::Approx(-world.reading(first).position[0] / 3).epsilon(1e-4));
  CHECK(world.reading(first).position[0] > 4 * pi);
}

TEST_CASE("a spring of any stiffness swings or rests, and carries what hangs on it") {
  for (const double stiffness : {10.0, 1e4, 1e9}) {
    World world(awake);
    const BodyId bob = add_ball(world, Vec3(0, -1, 0), 0.1, 1);
    const JointId spring =
        world.add_joint({.b = bob, .kind = SpringJoint{.length = 1, .stiffness = stiffness, .damping = 2}});
    for (int i = 0; i < 240 * 20; ++i) world.step(1.0 / 240);
    CAPTURE(stiffness);
    CHECK(world.reading(spring).position[0] == doctest::Approx(1 + g / stiffness).epsilon(1e-6));
    CHECK(world.reading(spring).force.y() == doctest::Approx(g).epsilon(1e-4));
  }
}

TEST_CASE("what a joint cannot be is refused with its reason") {
  World world;
  const BodyId body = add_ball(world, Vec3(0, 0, 0), 1, 1);
  const BodyId other = add_ball(world, Vec3(3, 0, 0), 1, 1);
  const BodyId floor = world.add({.shape = {Plane{}}, .fixed = true});
  const auto with = [&](const JointKind& kind) { return JointSettings{.a = body, .b = other, .kind = kind}; };
  CHECK_THROWS_WITH_AS(world.add_joint({.a = body, .b = body}), "a joint needs two bodies, but both are the same",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = body}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.a = floor, .b = body}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add_joint(with(HingeJoint{.limits = Limits{1, -1}})),
                       "limits of a hinge must be in order, but the low one is 1 and the high one -1",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(HingeJoint{.limits = Limits{NAN, 1}})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(HingeJoint{.motor = Motor{.speed = HUGE_VAL}})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(SliderJoint{.motor = Motor{.max_force = -1}})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(DistanceJoint{{-2, -1}})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(SwingTwistJoint{.swing_y = 4})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(SwingTwistJoint{.twist = {-4, 0}})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(PulleyJoint{.ratio = 0})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(GearJoint{.ratio = 0})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint(with(SpringJoint{.stiffness = -1})), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.b = body, .frame_b = {.position = Vec3(NAN, 0, 0)}}), std::invalid_argument);
  CHECK_THROWS_AS(world.add_joint({.b = body, .break_force = -1}), std::invalid_argument);
  CHECK(world.joints().empty());
  const JointId joint = world.add_joint(with(BallJoint{}));
  CHECK_THROWS_AS(world.set_joint(joint, HingeJoint{}), std::invalid_argument);
  world.remove(other);
  CHECK_FALSE(world.contains(joint));
  CHECK_THROWS_AS(static_cast<void>(world.reading(joint)), std::invalid_argument);
}

}  // namespace tweenfall::jointed
