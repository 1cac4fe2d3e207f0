#include "physics/scenarios.h"

#include <cmath>

namespace tweenfall::test {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

Hull wedge() {
  const std::vector<Vec3> points{{-0.3, -0.2, -0.2}, {0.3, -0.2, -0.2}, {-0.3, -0.2, 0.2},
                                 {0.3, -0.2, 0.2},   {-0.3, 0.25, 0.2}, {0.3, 0.25, 0.2}};
  return Hull{ConvexHull(points)};
}

BodySettings solid_at(const Solid& solid, const Vec3& place, double friction = 0.5) {
  BodySettings body;
  body.shape.solid = solid;
  body.motion.pose.position = place;
  body.friction = friction;
  return body;
}

void add_floor(World& world) {
  world.add({.shape = {Plane{}}, .fixed = true});
}

/// A heap of all solids that a keyed box pushes around; bodies come, go, change hands and are struck.
Scenario heap(const std::string& name, double restitution) {
  const auto make = [restitution] {
    World world;
    add_floor(world);
    BodySettings pusher = solid_at(Box{Vec3(0.2, 0.5, 2)}, Vec3(-3, 0.5, 0));
    pusher.drive = Drive::keyed();
    world.add(pusher);
    for (BodySettings& body : mixed_bodies(5, 30)) {
      if (restitution >= 0) body.restitution = restitution;
      world.add(body);
    }
    return world;
  };
  const auto step = [](World& world, int n) {
    const std::vector<BodyId> bodies = world.bodies();
    if (n < 120) {
      Motion target;
      target.pose.position = Vec3(-3 + 2 * (n + 1) / 120.0, 0.5, 0);
      target.twist.linear = Vec3(2, 0, 0);
      world.set_target(bodies[1], target);
    }
    if (n == 60) world.set_drive(bodies[5], Drive::keyed());
    if (n == 75) world.set_drive(bodies[6], {.hz = 3, .zeta = 0.7, .max_force = 200});
    if (n == 90) world.set_drive(bodies[5], Drive::free());
    if (n == 100) world.remove(bodies[9]);
    if (n == 101) world.remove(bodies[20]);
    if (n == 110) world.add(solid_at(Sphere{0.2}, Vec3(0, 3, 0)));
    if (n == 130) world.apply_impulse(bodies[12], Vec3(0, 3, 1), world.motion(bodies[12]).pose.position);
    if (n == 140) world.apply_force(bodies[13], Vec3(0, 90, 0), world.motion(bodies[13]).pose.position);
    world.step(1.0 / 120);
  };
  return {name, 200, make, step};
}

/// A wall of boxes that falls asleep and is struck by a ball; two lone piles beside it are not.
Scenario sleepers() {
  const auto make = [] {
    World world({.sleep_after = 0.3});
    add_floor(world);
    for (int row = 0; row < 4; ++row)
      for (int i = 0; i < 4; ++i)
        world.add(solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0.51 * i + 0.25 * (row % 2), 0.25 + 0.5 * row, 0)));
    for (int i = 0; i < 3; ++i) world.add(solid_at(Box{Vec3(0.3, 0.2, 0.3)}, Vec3(8, 0.2 + 0.4 * i, 0)));
    for (int i = 0; i < 3; ++i) world.add(solid_at(wedge(), Vec3(-8, 0.25 + 0.55 * i, 0)));
    return world;
  };
  const auto step = [](World& world, int n) {
    if (n == 70) {
      BodySettings ball = solid_at(Sphere{0.3}, Vec3(0.7, 0.8, -4));
      ball.motion.twist.linear = Vec3(0, 1, 9);
      world.add(ball);
    }
    if (n == 120) world.wake(world.bodies()[18]);
    world.step(1.0 / 60);
  };
  return {"boxes that sleep, and a ball that wakes some", 170, make, step};
}

/// Soft and stiff springs, drags, driven bodies, and steps of uneven lengths.
Scenario springs() {
  const auto make = [] {
    World world;
    add_floor(world);
    std::vector<BodyId> chain;
    chain.reserve(6);
    for (int i = 0; i < 6; ++i)
      chain.push_back(world.add(solid_at(Box{Vec3(0.2, 0.1, 0.1)}, Vec3(0.6 * i, 1.2, 0.02 * i))));
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      world.add_force(Spring{.a = chain[i],
                             .b = chain[i + 1],
                             .anchor_a = Vec3(0.2, 0, 0),
                             .anchor_b = Vec3(-0.2, 0, 0),
                             .rest_length = 0.15,
                             .stiffness = i % 2 == 0 ? 300.0 : 4e6,
                             .damping = 2});
    world.add_force(Spring{.a = chain[0], .anchor_b = Vec3(-0.5, 3, 0), .rest_length = 1, .stiffness = 500});
    world.add_force(Drag{.linear = 0.1, .quadratic = 0.2, .angular = 0.01});
    BodySettings driven = solid_at(Sphere{0.3}, Vec3(1, 0.4, 1));
    driven.drive = {.hz = 4, .zeta = 0.5, .max_force = 300};
    world.add(driven);
    return world;
  };
  const auto step = [](World& world, int n) {
    const std::vector<BodyId> bodies = world.bodies();
    Motion target;
    target.pose.position = Vec3(1.5 - std::abs(0.01 * n - 1), 0.4, 1 - 0.01 * n);
    world.set_target(bodies.back(), target);
    if (n == 100) world.remove_force(1);
    if (n == 130) world.remove(bodies[2]);
    world.step(n % 7 == 3 ? 1e-4 : n % 5 == 0 ? 1.0 / 60 : 1.0 / 240);
  };
  return {"springs, drags and a driven ball in uneven steps", 220, make, step};
}

/// Fast and fast-spinning bodies over thin walls, keyed blades among them: much is near and does not touch.
Scenario fast() {
  const auto make = [] {
    World world({.gravity = Vec3(0, -2, 0), .sleep_after = inf});
    add_floor(world);
    Random random(77);
    for (int i = 0; i < 6; ++i) {
      BodySettings wall = solid_at(Box{Vec3(0.02, 1, 2)}, Vec3(1.5 * i - 4, 1, 0));
      wall.fixed = true;
      world.add(wall);
    }
    for (BodySettings& body : mixed_bodies(78, 40)) {
      body.motion.pose.position = 3 * random.vector(1) + Vec3(0, 3.5, 0);
      body.motion.twist.linear = random.vector(25);
      body.motion.twist.angular = random.vector(30);
      body.restitution = 0.5;
      world.add(body);
    }
    BodySettings blade = solid_at(Box{Vec3(2, 0.05, 0.2)}, Vec3(0, 2.3, 0));
    blade.drive = Drive::keyed();
    world.add(blade);
    return world;
  };
  const auto step = [](World& world, int n) {
    const BodyId blade = world.bodies().back();
    Motion target = world.motion(blade);
    target.pose.rotation = Quat(Eigen::AngleAxisd(0.1 * (n + 1), Vec3(0, 1, 0)));
    target.twist.angular = Vec3(0, 6, 0);
    if (n < 100) world.set_target(blade, target);
    world.step(1.0 / 60);
  };
  return {"fast bodies, thin walls and a keyed blade", 160, make, step};
}

/// So many at one place that no pairs are kept; they then separate.
Scenario crowd() {
  const auto make = [] {
    World world;
    add_floor(world);
    Random random(3);
    for (int i = 0; i < 300; ++i) world.add(solid_at(Sphere{0.2}, random.vector(0.3) + Vec3(0, 1, 0)));
    return world;
  };
  return {"a crowd at one place", 60, make, [](World& world, int) { world.step(1.0 / 60); }};
}

/// Many small islands beside a large one.
Scenario islands() {
  const auto make = [] {
    World world;
    add_floor(world);
    Random random(12);
    for (int i = 0; i < 40; ++i)
      for (int k = 0; k < 1 + i % 4; ++k)
        world.add(solid_at(i % 3 == 0 ? Solid(wedge()) : Solid(Box{Vec3(0.2, 0.2, 0.2)}),
                           Vec3(2.0 * (i % 8), 0.3 + 0.5 * k, 5 + 2.0 * (i / 8)) + 0.05 * random.vector(1), 0.6));
    for (int row = 0; row < 9; ++row)
      for (int i = 0; i + row < 9; ++i)
        world.add(solid_at(Box{Vec3(0.25, 0.25, 0.25)}, Vec3(0.5 * i + 0.25 * row, 0.25 + 0.5 * row, 0)));
    for (int i = 0; i < 200; ++i)
      world.add(solid_at(Sphere{0.15}, Vec3(-3, 1, 0) + Vec3(0.3 * (i % 5), 0.3 * (i / 25), 0.3 * (i / 5 % 5)) +
                                           0.02 * random.vector(1)));
    return world;
  };
  const auto step = [](World& world, int n) {
    if (n == 80) {
      BodySettings ball = solid_at(Sphere{0.5}, Vec3(-6, 2, 0));
      ball.motion.twist.linear = Vec3(12, 0, 0);
      world.add(ball);
    }
    world.step(1.0 / 60);
  };
  return {"many islands", 140, make, step};
}

/// Every kind of joint, one that breaks, one that is removed, and one whose body is removed.
Scenario joints() {
  const auto make = [] {
    World world;
    add_floor(world);
    const std::vector<JointKind> kinds = {
        BallJoint{},
        HingeJoint{.limits = Limits{-1, 1}, .motor = Motor{.speed = 2, .max_force = 3}},
        SliderJoint{.motor = Motor{.position = 0.3}},
        FixedJoint{},
        DistanceJoint{{0.2, 1}},
        UniversalJoint{.first_limits = Limits{-0.5, 0.5}},
        SwingTwistJoint{.swing_y = 0.5, .swing_z = 1, .twist = {-0.5, 0.5}, .toward = Quat(1, 0, 0, 0)},
        WheelJoint{.motor = Motor{.speed = 1}},
        PulleyJoint{.pulley_a = Vec3(0, 4, 0), .pulley_b = Vec3(1, 4, 0)},
        GearJoint{2},
        SpringJoint{0.5, 300, 2}};
    BodyId last{};
    for (std::size_t i = 0; i < 2 * kinds.size(); ++i) {
      const double x = 0.7 * static_cast<double>(i);
      BodySettings settings = solid_at(Box{Vec3(0.3, 0.1, 0.15)}, Vec3(x, 2, 0), 0.6);
      settings.motion.twist.angular = Vec3(0, 0.1 * static_cast<double>(i % 3), 0);
      const BodyId body = world.add(settings);
      const bool apart = i % 5 == 0;  // chains of five
      const JointFrames frames = joint_frames(apart ? Pose{} : world.motion(last).pose, world.motion(body).pose,
                                              Vec3(x - 0.35, 2, 0), Vec3(0, 0, 1));
      world.add_joint({.a = apart ? BodyId{} : last,
                       .b = body,
                       .frame_a = frames.a,
                       .frame_b = frames.b,
                       .kind = kinds[i % kinds.size()],
                       .break_force = i == 3 ? 2000.0 : HUGE_VAL,
                       .collide = i % 4 == 0});
      last = body;
    }
    return world;
  };
  const auto step = [](World& world, int n) {
    if (n == 40) world.remove_joint(world.joints()[5]);
    if (n == 60) world.remove(world.bodies()[8]);
    if (n == 70) world.set_drive(world.bodies()[11], Drive::keyed());
    world.step(1.0 / 60);
  };
  return {"joints", 120, make, step};
}

/// One island of several hundred contacts: boxes, hulls and balls that slide, stick and rebound on a moving floor.
Scenario large_island() {
  const auto make = [] {
    World world;
    BodySettings floor = solid_at(Box{Vec3(20, 0.5, 20)}, Vec3(0, -0.5, 0));
    floor.drive = Drive::keyed();
    world.add(floor);
    Random random(31);
    for (int row = 0; row < 16; ++row)
      for (int i = 0; i + row < 16; ++i) {
        const Solid solids[] = {Box{Vec3(0.25, 0.25, 0.25)}, Sphere{0.25}, Box{Vec3(0.25, 0.25, 0.3)}, wedge()};
        BodySettings body = solid_at(solids[row > 9        ? (i + row) % 4
                                            : row % 3 == 2 ? 2
                                                           : 0],
                                     Vec3(0.505 * i + 0.25 * row, 0.25 + 0.5 * row, 0.01 * random.unit()), 0.4);
        body.restitution = i % 3 == 0 ? 0.4 : 0;
        world.add(body);
      }
    return world;
  };
  const auto step = [](World& world, int n) {
    Motion target;
    target.pose.position = Vec3(0.002 * (n + 1), -0.5, 0);
    target.twist.linear = Vec3(0.12, 0, 0);
    world.set_target(world.bodies()[0], target);
    if (n == 20) {
      BodySettings ball = solid_at(Sphere{0.6}, Vec3(-4, 2, 0));
      ball.motion.twist.linear = Vec3(20, 0, 0);
      ball.restitution = 0.5;
      world.add(ball);
    }
    world.step(1.0 / 60);
  };
  return {"a large island", 60, make, step};
}

}  // namespace

std::vector<BodySettings> mixed_bodies(unsigned seed, int count) {
  Random random(seed);
  const Solid solids[] = {Sphere{0.25}, Box{Vec3(0.25, 0.2, 0.3)}, Capsule{0.15, 0.2}, wedge()};
  std::vector<BodySettings> bodies;
  for (int i = 0; i < count; ++i) {
    BodySettings body = solid_at(solids[i % 4], random.vector(0.5) + Vec3(0, 1 + 0.4 * i, 0));
    body.restitution = 0.1 * (i % 4);
    body.rolling_friction = i % 5 == 0 ? 0.01 : 0;
    body.motion.pose.rotation = random.rotation();
    bodies.push_back(body);
  }
  return bodies;
}

std::vector<Scenario> scenarios() {
  return {heap("a heap that is pushed", -1),
          heap("a heap that bounces", 0.8),
          sleepers(),
          springs(),
          fast(),
          crowd(),
          islands(),
          large_island(),
          joints()};
}

}  // namespace tweenfall::test
