#include <tweenfall/physics/planar_world.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double flat_step = 1.0 / 60;

BodyId add_ground(planar::World& world, double friction = 0.5) {
  return world.add({.shape = {planar::HalfPlane{}}, .friction = friction, .fixed = true});
}

void run(planar::World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step(flat_step);
}

double total_energy(const planar::World& world) {
  double energy = world.kinetic_energy();
  for (const BodyId body : world.bodies())
    if (!world.is_fixed(body)) energy += world.mass(body).mass * 9.81 * world.motion(body).position.y();
  return energy;
}

}  // namespace

TEST_CASE("in a plane what nothing touches flies by x + v t + g t^2 / 2 and spins evenly") {
  planar::World world;
  planar::BodySettings body{.shape = {planar::Box{Vec2(0.3, 0.1)}}};
  body.motion = {Vec2(1, 2), 0.5, Vec2(3, 4), 7};
  const BodyId id = world.add(body);
  run(world, 600);
  const double t = 10;
  const planar::Motion motion = world.motion(id);
  CHECK(near(motion.position, Vec2(1 + 3 * t, 2 + 4 * t - 0.5 * 9.81 * t * t), 1e-13));
  CHECK(near(motion.velocity, Vec2(3, 4 - 9.81 * t), 1e-13));
  CHECK(near(motion.angle, 0.5 + 7 * t, 1e-13));
  CHECK(motion.spin == 7);
}

TEST_CASE("in a plane the center of mass goes straight where the node's origin swings about it") {
  planar::World world({.gravity = {0, 0}});
  const Vec2 center(0.4, 0);
  planar::BodySettings body{.shape = {planar::Polygon{.corners = {{0.3, -0.1}, {0.5, -0.1}, {0.5, 0.1}, {0.3, 0.1}}}}};
  body.motion = {.velocity = Vec2(1, 0), .spin = 2};
  const BodyId id = world.add(body);
  // v + w x r
  const Vec2 expected(1, 2 * center.x());
  CHECK(near(world.mass(id).center, center, 1e-15));
  for (int i = 0; i < 60; ++i) {
    REQUIRE(near(world.center_velocity(id), expected, 1e-13));
    world.step(flat_step);
  }
}

TEST_CASE("in a plane damping leaves exp(-c t), and a force gives a = F / m") {
  planar::World world({.gravity = {0, 0}});
  const BodyId damped =
      world.add({.linear_damping = 0.7, .angular_damping = 0.3, .motion = {.velocity = Vec2(2, 0), .spin = 5}});
  const BodyId pushed = world.add({.mass = 4.0, .motion = {.position = Vec2(0, 9)}});
  for (int i = 0; i < 120; ++i) {
    world.apply_force(pushed, Vec2(8, 0), world.motion(pushed).position);
    world.step(flat_step);
  }
  CHECK(near(world.motion(damped).velocity.x(), 2 * std::exp(-1.4), 1e-12));
  CHECK(near(world.motion(damped).spin, 5 * std::exp(-0.6), 1e-12));
  CHECK(near(world.motion(pushed).velocity.x(), 4, 1e-12));
  CHECK(near(world.motion(pushed).position.x(), 4, 1e-12));
}

TEST_CASE("in a plane a ball rises again to e^2 of its height, at the time of the closed form") {
  for (const double e : {0.5, 0.8, 1.0}) {
    planar::World world({.sleep_after = inf});
    add_ground(world);
    const BodyId ball = world.add({.restitution = e, .motion = {.position = Vec2(0, 5.5)}});
    const double fall = std::sqrt(2 * 5 / 9.81), speed = 9.81 * fall;
    for (int i = 1; i <= 150; ++i) {
      world.step(flat_step);
      const double t = i * flat_step;
      // From the first blow to the second.
      if (t < fall || t > fall + 2 * e * speed / 9.81) continue;
      const double after = t - fall;
      CAPTURE(e);
      CAPTURE(t);
      CHECK(near(world.motion(ball).position.y() - 0.5, e * speed * after - 0.5 * 9.81 * after * after, 1e-9));
      CHECK(near(world.motion(ball).velocity.y(), e * speed - 9.81 * after, 1e-9));
    }
  }
}

TEST_CASE("in a plane two discs part as momentum, energy and the line of their centers say") {
  planar::World world({.gravity = {0, 0}});
  // They meet off center: at that moment the line of centers is at 30 degrees to the path.
  planar::BodySettings disc{.mass = 1.0, .friction = 0, .restitution = 1};
  const BodyId still = world.add(disc);
  disc.mass = 3.0;
  disc.motion.position = Vec2(-3, std::sin(pi / 6));
  disc.motion.velocity = Vec2(7, 0);
  const BodyId moving = world.add(disc);
  run(world, 60);
  const Vec2 normal(std::cos(pi / 6), -std::sin(pi / 6));
  // The impulse along the normal: (1 + e) m1 m2 / (m1 + m2) times the closing speed.
  const Vec2 impulse = 2 * 0.75 * 7 * std::cos(pi / 6) * normal;
  CHECK(near(world.motion(still).velocity, Vec2(impulse), 1e-8));
  CHECK(near(world.motion(moving).velocity, Vec2(Vec2(7, 0) - impulse / 3), 1e-8));
  CHECK(near(world.kinetic_energy(), 0.5 * 3 * 49, 1e-12));
}

TEST_CASE("in a plane a cradle hands its blow on, one ball for one and two for two") {
  for (const int struck : {1, 2}) {
    planar::World world({.gravity = {0, 0}});
    std::vector<BodyId> balls;
    for (int i = 0; i < 5; ++i) {
      planar::BodySettings ball{.friction = 0, .restitution = 1};
      ball.motion.position = Vec2(i < struck ? i - 3 : i, 0);
      if (i < struck) ball.motion.velocity = Vec2(2, 0);
      balls.push_back(world.add(ball));
    }
    run(world, 120);
    for (int i = 0; i < 5; ++i) {
      CAPTURE(struck);
      CAPTURE(i);
      CHECK(near(world.motion(balls[static_cast<std::size_t>(i)]).velocity.x(), i >= 5 - struck ? 2 : 0, 1e-9));
    }
  }
}

TEST_CASE("in a plane a box stays below atan(mu) and slides by g (sin - mu cos) above") {
  const double friction = 0.5, critical = std::atan(friction);
  for (const double tilt : {critical - 0.02, critical + 0.1}) {
    planar::World world({.gravity = 9.81 * Vec2(std::sin(tilt), -std::cos(tilt)), .sleep_after = inf});
    add_ground(world, friction);
    const BodyId box =
        world.add({.shape = {planar::Box{}}, .friction = friction, .motion = {.position = Vec2(0, 0.5)}});
    run(world, 60);
    const planar::Motion before = world.motion(box);
    run(world, 60);
    const planar::Motion after = world.motion(box);
    if (tilt < critical) {
      CHECK(std::abs(after.position.x() - before.position.x()) < 1e-6);
    } else {
      const double acceleration = 9.81 * (std::sin(tilt) - friction * std::cos(tilt));
      CHECK(near(after.velocity.x() - before.velocity.x(), acceleration, 2e-3));
    }
  }
}

TEST_CASE("in a plane a disc rolls down by 2/3 g sin without slip") {
  const double tilt = 0.3;
  planar::World world({.gravity = 9.81 * Vec2(std::sin(tilt), -std::cos(tilt)), .sleep_after = inf});
  add_ground(world, 1);
  const BodyId disc = world.add({.friction = 1, .motion = {.position = Vec2(0, 0.5)}});
  run(world, 120);
  CHECK(near(world.motion(disc).velocity.x(), 2.0 / 3 * 9.81 * std::sin(tilt) * 2, 1e-2));
  CHECK(near(world.motion(disc).spin, -2 * world.motion(disc).velocity.x(), 1e-4));
}

TEST_CASE("in a plane rolling friction slows a disc by c g / (r (1 + k)), and holds it on slopes of up to c / r") {
  // About the point of contact: (k m r^2 + m r^2) a / r = c m g. It stops after v / a, v^2 / (2 a) away.
  const double radius = 0.5, resistance = 0.03, a = resistance * 9.81 / (1.5 * radius);
  planar::World world({.sleep_after = inf});
  add_ground(world);
  planar::BodySettings disc{.shape = {planar::Circle{radius}}, .rolling_friction = resistance};
  disc.motion = {Vec2(0, radius), 0, Vec2(1, 0), -1 / radius};
  const BodyId rolling = world.add(disc);
  for (int i = 1; i <= 120; ++i) {
    world.step(flat_step);
    CHECK(near(world.motion(rolling).velocity.x(), 1 - a * i * flat_step, 1e-9));
  }
  run(world, 120);
  CHECK(near(world.motion(rolling).position.x(), 0.5 / a, 0.01));
  CHECK(std::abs(world.motion(rolling).velocity.x()) < 1e-9);
  // Given for the ground, or for a disc and for what it rolls on: the larger counts. The same at 1 and 1e6 kg, and at
  // 1e-3 m.
  for (const double size : {0.001, 1.0}) {
    for (const double mass : {1.0, 1e6}) {
      for (const double steep : {0.9, 1.2}) {
        const double c = 0.1 * size, slope = std::atan(steep * 0.1);
        planar::World tilted({.gravity = 9.81 * Vec2(std::sin(slope), -std::cos(slope)), .sleep_after = inf});
        tilted.add({.shape = {planar::HalfPlane{}}, .friction = 1, .rolling_friction = c, .fixed = true});
        const BodyId body = tilted.add({.shape = {planar::Circle{size}},
                                        .mass = mass,
                                        .friction = 1,
                                        .rolling_friction = 0.5 * c,
                                        .motion = {.position = Vec2(0, size)}});
        run(tilted, 60);
        const double before = tilted.motion(body).velocity.x();
        run(tilted, 60);
        const double pull = 9.81 * (std::sin(slope) - 0.1 * std::cos(slope)) / 1.5;
        CAPTURE(size);
        CAPTURE(mass);
        CAPTURE(steep);
        CHECK(near(tilted.motion(body).velocity.x() - before, steep < 1 ? 0 : pull, 1e-6));
        if (steep < 1) CHECK(std::abs(before) < 1e-6);
      }
    }
  }
  CHECK_THROWS_WITH_AS(world.add({.rolling_friction = -1}), doctest::Contains("rolling friction must lie in 0"),
                       std::invalid_argument);
}

TEST_CASE("in a plane a pyramid of twenty rows stands, presses with its weight, and falls asleep") {
  planar::World world({.sleep_after = 4});
  const BodyId ground = add_ground(world, 0.6);
  BodyId top;
  const int rows = 20;
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < rows - row; ++i)
      top = world.add({.shape = {planar::Box{}},
                       .mass = 1.0,
                       .friction = 0.6,
                       .motion = {.position = Vec2(0.55 * row + 1.1 * i, 0.5 + row)}});
  const double middle = world.motion(top).position.x();
  run(world, 180);
  CHECK(std::abs(world.motion(top).position.x() - middle) < 0.02);
  CHECK(world.motion(top).position.y() > rows - 0.6);
  double weight = 0;
  for (const planar::Contact& contact : world.contacts())
    if (contact.a == ground || contact.b == ground) weight += contact.impulse;
  CHECK(near(weight, 210 * 9.81 * flat_step, 1e-3));
  run(world, 400);
  CHECK(world.asleep(top));
  // A blow wakes all.
  world.apply_impulse(top, Vec2(30, 0), world.motion(top).position);
  run(world, 2);
  CHECK_FALSE(world.asleep(world.bodies()[1]));
}

TEST_CASE("in a plane contacts are told where bodies are at the end of the step, keyed ones too") {
  planar::World world({.gravity = Vec2(-9.81, 0)});
  planar::BodySettings pusher{.shape = {planar::Box{Vec2(0.2, 0.5)}}, .drive = Drive::keyed()};
  const BodyId keyed = world.add(pusher);
  planar::BodySettings box{.shape = {planar::Box{Vec2(0.3, 0.3)}}, .mass = 1};
  box.motion.position = Vec2(0.5, 0);
  const BodyId pushed = world.add(box);
  int told = 0;
  for (int step = 1; step <= 60; ++step) {
    world.set_target(keyed, {.position = Vec2(step / 120.0, 0), .velocity = Vec2(2, 0)});
    world.step(1.0 / 240);
    for (const planar::Contact& contact : world.contacts())
      for (int i = 0; i < contact.manifold.count; ++i) {
        const planar::ContactPoint& point = contact.manifold.points[static_cast<std::size_t>(i)];
        const double face = world.motion(keyed).position.x() + 0.2, other = world.motion(pushed).position.x() - 0.3;
        // The box turns by little.
        CHECK(near(point.position.x(), 0.5 * (face + other), 1e-3));
        CHECK(near(point.penetration, face - other, 1e-3));
        ++told;
      }
  }
  CHECK(told > 60);
}

TEST_CASE("in a plane a keyed body has its target's numbers exactly, pushes, and is handed over with its velocity") {
  planar::World world;
  add_ground(world);
  planar::BodySettings pusher{.shape = {planar::Box{Vec2(0.2, 0.5)}}, .drive = Drive::keyed()};
  pusher.motion.position = Vec2(-2, 0.6);
  const BodyId keyed = world.add(pusher);
  const BodyId box = world.add({.shape = {planar::Box{}}, .motion = {.position = Vec2(0, 0.5)}});
  for (int i = 1; i <= 120; ++i) {
    const double t = i * flat_step;
    const planar::Motion target{Vec2(-2 + t, 0.6), 0.1 * t, Vec2(1, 0), 0.1};
    world.set_target(keyed, target);
    world.step(flat_step);
    const planar::Motion motion = world.motion(keyed);
    REQUIRE((motion.position == target.position && motion.angle == target.angle && motion.velocity == target.velocity &&
             motion.spin == target.spin));
  }
  CHECK(world.motion(box).position.x() > 0.6);
  CHECK(world.reaction(keyed).x() < 0);
  world.set_drive(keyed, Drive::free());
  CHECK(world.motion(keyed).velocity == Vec2(1, 0));
  CHECK(world.motion(keyed).spin == 0.1);
  world.set_drive(keyed, Drive::keyed());
  world.step(flat_step);
  CHECK(world.motion(keyed).velocity == Vec2(0, 0));
}

TEST_CASE("in a plane a driven body comes to its target as a critically damped spring does") {
  planar::World world({.gravity = {0, 0}});
  const BodyId body = world.add({.drive = {.hz = 1, .zeta = 1}});
  for (int i = 0; i < 120; ++i) {
    world.set_target(body, {Vec2(1, 0), 0.5, Vec2(0, 0), 0});
    world.step(1.0 / 240);
  }
  // 1 - (1 + w t) exp(-w t); the pull is implicit and of first order.
  const double w = 2 * pi, part = 1 - (1 + 0.5 * w) * std::exp(-0.5 * w);
  CHECK(near(world.motion(body).position.x(), part, 5e-3));
  CHECK(near(world.motion(body).angle, 0.5 * part, 5e-3));
}

TEST_CASE("in a plane a hinge lets a rod swing with its closed period, a rod keeps its length") {
  for (const bool hinged : {true, false}) {
    planar::World world({.sub_steps = 8, .sleep_after = inf});
    planar::BodySettings bob{.shape = {planar::Box{Vec2(0.5, 0.05)}}, .mass = 2.0};
    const double small = 0.02;
    // About one end: I = m L^2 / 3, so T = 2 pi sqrt(2 L / 3 g). On a rod a point: T = 2 pi sqrt(L / g).
    bob.motion.angle = -pi / 2 + small;
    bob.motion.position = 0.5 * Vec2(std::sin(small), -std::cos(small));
    if (!hinged)
      bob = {.shape = {planar::Circle{0.01}}, .motion = {.position = Vec2(std::sin(small), -std::cos(small))}};
    const BodyId body = world.add(bob);
    planar::JointSettings joint{.b = body};
    if (hinged)
      joint.anchor_b = Vec2(-0.5, 0);
    else
      joint.kind = planar::Distance{{1, 1}};
    const JointId id = world.add_joint(joint);
    const double length = hinged ? (1 + 0.01) / 3 / 0.5 : 1, period = 2 * pi * std::sqrt(length / 9.81);
    // A quarter period later it hangs straight.
    double crossed = 0, before = 0;
    for (int i = 1; i <= 240 && crossed == 0; ++i) {
      before = world.motion(body).position.x();
      world.step(1.0 / 240);
      const double x = world.motion(body).position.x();
      if (x <= 0) crossed = (i - 1 + before / (before - x)) / 240;
    }
    CAPTURE(hinged);
    CHECK(near(crossed, 0.25 * period, 5e-3));
    CHECK(world.reading(id).gap < 1e-4);
  }
}

TEST_CASE("in a plane limits and motors of a hinge hold, and jointed bodies pass through each other") {
  planar::World world({.gravity = {0, 0}});
  const BodyId a = world.add({.shape = {planar::Box{}}, .fixed = true}), b = world.add({.shape = {planar::Box{}}});
  world.add_joint({.a = a, .b = b, .kind = planar::Hinge{Limits{-inf, 1}, Motor{.speed = 2, .max_force = 4000}}});
  run(world, 15);
  CHECK(near(world.motion(b).spin, 2, 1e-6));
  CHECK(world.contacts().empty());
  run(world, 60);
  CHECK(near(world.motion(b).angle, 1, 2e-2));
}

TEST_CASE("in a plane sensors tell who is in them, groups who meets") {
  planar::World world({.gravity = {0, 0}});
  const BodyId sensor = world.add({.shape = {planar::Box{}}, .sensor = true, .fixed = true});
  const BodyId ball =
      world.add({.shape = {planar::Circle{0.1}}, .motion = {.position = Vec2(-1, 0), .velocity = Vec2(1, 0)}});
  planar::BodySettings wall{.shape = {planar::Box{}}, .fixed = true, .groups = 2};
  world.add(wall);
  world.set_groups(ball, 1, 1);
  int inside = 0, began = 0;
  for (int i = 0; i < 120; ++i) {
    world.step(flat_step);
    for (const SensorOverlap& overlap : world.sensor_overlaps()) {
      CHECK((overlap.sensor == sensor && overlap.body == ball));
      ++inside;
      began += overlap.began ? 1 : 0;
    }
  }
  CHECK(began == 1);
  CHECK(std::abs(inside - 72) <= 2);  // 1.2 m at 1 m/s
  CHECK(near(world.motion(ball).velocity.x(), 1, 1e-15));
}

TEST_CASE("in a plane nothing that is dropped gains energy, and a fast ball does not pass a thin wall") {
  Random random(3);
  planar::World world({.sleep_after = inf});
  add_ground(world);
  for (int i = 0; i < 60; ++i) {
    planar::BodySettings body{.friction = random.between(0, 1), .restitution = 0.3 * (i % 3)};
    const std::vector<planar::Outline> outlines{planar::Box{Vec2(random.between(0.1, 0.4), random.between(0.1, 0.4))},
                                                planar::Capsule{random.between(0.1, 0.2), random.between(0, 0.4)},
                                                planar::Circle{random.between(0.1, 0.3)},
                                                planar::Polygon{{Vec2(-0.3, -0.2), Vec2(0.4, -0.1), Vec2(0, 0.4)}}};
    body.shape.outline = outlines[static_cast<std::size_t>(i % 4)];
    body.motion = {Vec2(1.1 * (i % 8), 1 + 1.2 * (i / 8)), random.between(0, 6), Vec2(random.between(-2, 2), 0), 3};
    world.add(body);
  }
  double before = total_energy(world);
  for (int i = 0; i < 240; ++i) {
    world.step(flat_step);
    const double now = total_energy(world);
    CAPTURE(i);
    // Removing overlap lifts it a little.
    REQUIRE(now < before + 2e-3 * std::abs(before));
    before = std::min(before, now);
  }
  planar::World range({.gravity = {0, 0}});
  range.add({.shape = {planar::Box{Vec2(0.01, 5)}}, .fixed = true});
  const BodyId bullet = range.add({.shape = {planar::Circle{0.02}},
                                   .restitution = 1,
                                   .motion = {.position = Vec2(-7, 0.3), .velocity = Vec2(900, 0)}});
  run(range, 2);
  CHECK(near(range.motion(bullet).velocity.x(), -900, 1e-6));
  CHECK(range.motion(bullet).position.x() < -0.02);
}

TEST_CASE("a plane that was moved from answers as empty or throws, and takes another") {
  planar::World world;
  const BodyId body = add_ground(world);
  planar::World other = std::move(world);
  CHECK(!world.contains(body));
  CHECK(world.time() == 0);
  CHECK(world.contacts().empty());
  CHECK_THROWS_AS(world.step(0.1), std::logic_error);
  CHECK_THROWS_AS(world.add({}), std::logic_error);
  CHECK_THROWS_AS((void)world.motion(body), std::logic_error);
  CHECK_THROWS_AS((void)world.save(), std::logic_error);
  planar::World copy = world;
  CHECK_THROWS_AS(copy.step(0.1), std::logic_error);
  world = other;
  world.step(0.1);
  CHECK(world.contains(body));
}
