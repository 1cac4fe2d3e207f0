#include "physics/scene.h"

using namespace tweenfall;
using test::near;

TEST_CASE("a dropped ball rises to e^2 times its height at every bounce") {
  for (const double dt : {1.0 / 240, 1.0 / 60})
    for (test::Scene& scene : test::scenes("bounce_e")) {
      CAPTURE(scene.file["name"].get<std::string>());
      CAPTURE(dt);
      scene.dt = dt;
      const auto& last = scene.file["bodies"].back();
      const double e = last["restitution"], gravity = -scene.file["gravity"][1].get<double>();
      const double radius = scene.file["shapes"][last["shape"].get<std::size_t>()]["radius"];
      const BodyId ball = scene.bodies.back();
      const double start = scene.world.motion(ball).pose.position.y();
      // The slab's upper side is at 0, so it touches with its center at its radius; then two apexes.
      std::vector<double> apexes;
      double top = 0;
      bool rising = false;
      for (int i = 0; i < static_cast<int>(8 / dt) && apexes.size() < 2; ++i) {
        scene.step();
        const Motion motion = scene.world.motion(ball);
        const double speed = motion.twist.linear.y();
        CHECK(motion.pose.position.y() > radius - 1e-3);
        if (rising && speed <= 0) apexes.push_back(top);
        rising = speed > 0;
        if (rising) top = motion.pose.position.y() + speed * speed / (2 * gravity);
      }
      if (e == 0) {
        CHECK(apexes.empty());
        CHECK(near(scene.world.motion(ball).pose.position.y(), radius, 1e-3));
        continue;
      }
      REQUIRE(apexes.size() == 2);
      CHECK(near(apexes[0], radius + (start - radius) * e * e, 1e-6));
      CHECK(near(apexes[1], radius + (start - radius) * e * e * e * e, 1e-6));
    }
}

TEST_CASE("a keyed wall gives a free ball (1 + e) V - e v") {
  for (const double e : {0.0, 0.5, 1.0}) {
    WorldSettings settings;
    settings.gravity = Vec3::Zero();
    World world(settings);
    BodySettings wall;
    wall.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
    wall.drive = Drive::keyed();
    wall.restitution = e;
    const BodyId pusher = world.add(wall);
    BodySettings ball;
    ball.shape.solid = Sphere{0.25};
    ball.friction = 0;
    ball.motion.pose.position = Vec3(1, 0, 0);
    ball.motion.twist.linear = Vec3(-0.5, 0, 0);
    const BodyId body = world.add(ball);
    for (int i = 1; i <= 240; ++i) {
      Motion target;
      target.pose.position = Vec3(3.0 * i / 240, 0, 0);
      target.twist.linear = Vec3(3, 0, 0);
      world.set_target(pusher, target);
      world.step(1.0 / 240);
      CHECK(world.motion(pusher).pose.position == target.pose.position);
      CHECK(world.twist(pusher).linear == target.twist.linear);
    }
    CHECK(near(world.twist(body).linear.x(), (1 + e) * 3 + e * 0.5, 1e-6));
    const double gained = world.mass(body).mass * (world.twist(body).linear.x() + 0.5);
    CHECK(near(-world.reaction(pusher).x(), gained, 1e-9));
  }
}

TEST_CASE("a keyed hammer at 3 m/s sends a resting ball off at 3.0, 4.5 and 6.0 m/s") {
  for (const auto& pair : {std::pair{0.0, 3.0}, std::pair{0.5, 4.5}, std::pair{1.0, 6.0}})
    for (const double dt : {1.0 / 240, 1.0 / 60}) {
      const double e = pair.first, speed = pair.second;
      CAPTURE(e);
      CAPTURE(dt);
      World world;
      world.add({.shape = {Plane{}}, .friction = 0, .fixed = true});
      BodySettings hammer;
      hammer.shape.solid = Box{Vec3(0.2, 0.2, 0.2)};
      hammer.drive = Drive::keyed();
      hammer.motion.pose.position = Vec3(-1.013, 0.3, 0);
      const BodyId keyed = world.add(hammer);
      BodySettings puck;
      puck.shape.solid = Sphere{0.25};
      puck.friction = 0;
      puck.restitution = e;
      puck.motion.pose.position = Vec3(0, 0.25, 0);
      const BodyId ball = world.add(puck);
      const int steps = static_cast<int>(0.8 / dt);
      for (int i = 1; i <= steps; ++i) {
        Motion target;
        target.pose.position = Vec3(-1.013 + 3 * i * dt, 0.3, 0);
        target.twist.linear = Vec3(3, 0, 0);
        world.set_target(keyed, target);
        world.step(dt);
        CHECK(world.motion(keyed).pose.position == target.pose.position);
      }
      CHECK(near(world.twist(ball).linear, Vec3(speed, 0, 0), 1e-6 / speed));
    }
}

TEST_CASE("balls that meet off center keep momentum and energy when elastic, and keep the speed along the contact") {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  World world(settings);
  BodySettings ball;
  ball.shape.solid = Sphere{0.5};
  ball.friction = 0;
  ball.restitution = 1;
  ball.mass = 2;
  ball.motion.twist.linear = Vec3(4, 0, 0);
  const BodyId a = world.add(ball);
  ball.mass = 3;
  ball.motion.pose.position = Vec3(2.013, 0.6, 0);
  ball.motion.twist.linear = Vec3(-1, 0, 0);
  const BodyId b = world.add(ball);
  const double energy = world.kinetic_energy();
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  const Vec3 va = world.twist(a).linear, vb = world.twist(b).linear;
  CHECK(near(Vec3(2 * va + 3 * vb), Vec3(5, 0, 0), 1e-12));
  CHECK(near(world.kinetic_energy(), energy, 1e-9));
  // They touch with centers 1 apart, 0.6 across: the normal is (0.8, 0.6). j = 2 * 5 * 0.8 / (1/2 + 1/3).
  const double impulse = 8 / (0.5 + 1.0 / 3);
  CHECK(near(va, Vec3(4 - 0.8 * impulse / 2, -0.6 * impulse / 2, 0), 1e-6));
  CHECK(near(vb, Vec3(-1 + 0.8 * impulse / 3, 0.6 * impulse / 3, 0), 1e-6));
}

TEST_CASE("a fast ball does not pass a thin wall") {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  World world(settings);
  BodySettings wall;
  wall.shape.solid = Box{Vec3(0.005, 1, 1)};
  wall.fixed = true;
  world.add(wall);
  BodySettings bullet;
  bullet.shape.solid = Sphere{0.01};
  bullet.motion.pose.position = Vec3(-3.3, 0, 0);
  bullet.motion.twist.linear = Vec3(300, 0, 0);
  const BodyId body = world.add(bullet);
  for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
  CHECK(near(world.motion(body).pose.position.x(), -0.015, 1e-4));
}

TEST_CASE("a ball that wobbles about a center of mass beside its middle does not swing into a wall") {
  // Its middle circles 0.3 m from what it spins about; the wall is in reach from the side only.
  for (const double spin : {5.0, 20.0, 60.0, 90.0})
    for (const double start : {0.0, 1.2, 1.7, 2.0, 4.4}) {
      CAPTURE(spin);
      CAPTURE(start);
      World world(WorldSettings{.gravity = Vec3::Zero()});
      world.add({.shape = {Box{{0.5, 5, 5}}}, .fixed = true, .motion = {.pose = {.position = {1, 0, 0}}}});
      BodySettings toy{.shape = {Sphere{0.2}}, .motion = {.twist = {.angular = {0, 0, spin}}}};
      toy.mass_properties = MassProperties{1, {0.3, 0, 0}, 0.05 * Mat3::Identity()};
      toy.motion.pose.rotation = Quat(Eigen::AngleAxisd(start, Vec3::UnitZ()));
      toy.motion.pose.position = -(toy.motion.pose.rotation * Vec3(0.3, 0, 0)) + Vec3(0.1, 0, 0);
      toy.motion.twist.linear = Vec3(0, 0, spin).cross(toy.motion.pose.position - Vec3(0.1, 0, 0));
      const BodyId ball = world.add(toy);
      double deepest = 0;
      for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        deepest = std::max(deepest, world.motion(ball).pose.position.x() + 0.2 - 0.5);
      }
      CHECK(deepest < 1e-3);
    }
}

TEST_CASE("the last of a row of balls takes all speed, and the row never gains energy and keeps its momentum") {
  for (test::Scene& scene : test::scenes("newton_cradle")) {
    CAPTURE(scene.file["name"].get<std::string>());
    const auto momentum = [&scene] {
      Vec3 sum = Vec3::Zero();
      for (const BodyId body : scene.bodies) sum += scene.world.mass(body).mass * scene.world.twist(body).linear;
      return sum;
    };
    const double energy = scene.world.kinetic_energy();
    const Vec3 start = momentum(), coming = scene.world.twist(scene.bodies.front()).linear;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      CHECK(scene.world.kinetic_energy() <= energy * (1 + 1e-12));
    }
    CHECK(near(momentum(), start, 1e-12));
    CHECK(near(scene.world.twist(scene.bodies.back()).linear, coming, 1e-6));
  }
}

TEST_CASE("an island that rebounds leaves nothing to one solved after it that has no contacts") {
  const auto add_pair = [](World& world) {
    const BodyId a = world.add({.shape = {Box{{0.1, 0.1, 0.1}}}, .motion = {.pose = {.position = {20, 5, 0}}}});
    const BodyId b = world.add({.shape = {Box{{0.1, 0.1, 0.1}}},
                                .motion = {.pose = {.position = {21, 5, 0}}, .twist = {.linear = {0, 1, 0}}}});
    world.add_joint({.a = a, .b = b, .frame_a = {.position = {1, 0, 0}}});
    return b;
  };
  World world, alone;
  world.add({.shape = {Plane{}}, .fixed = true});
  for (int i = 0; i < 40; ++i)
    world.add({.shape = {Box{{0.2, 0.2, 0.2}}},
               .restitution = 0.9,
               .motion = {.pose = {.position = {0.1 * (i % 3), 0.3 + 0.42 * i, 0.05 * (i % 2)}}}});
  const BodyId swings = add_pair(world), same = add_pair(alone);
  for (int n = 0; n < 100; ++n) {
    world.step(1.0 / 120);
    alone.step(1.0 / 120);
    REQUIRE(world.motion(swings).pose.position == alone.motion(same).pose.position);
  }
}

namespace {

/// The state of a row of balls of a kilogram at restitution 1 after two seconds.
std::vector<double> row_after_blow(double gap, double rate, int coming, int resting) {
  World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
  std::vector<BodyId> balls;
  for (int i = 0; i < coming + resting; ++i) {
    BodySettings ball;
    ball.shape.solid = Sphere{0.5};
    ball.mass = 1;
    ball.friction = 0;
    ball.restitution = 1;
    const bool comes = i < coming;
    ball.motion.pose.position.x() = (1 + gap) * (i - coming) - (comes ? 1 : 0);
    if (comes) ball.motion.twist.linear.x() = 3;
    balls.push_back(world.add(ball));
  }
  const double energy = world.kinetic_energy();
  for (int i = 0; i < 2 * rate; ++i) {
    world.step(1 / rate);
    CHECK(world.kinetic_energy() <= energy * (1 + 1e-12));
  }
  std::vector<double> speeds;
  speeds.reserve(balls.size());
  for (const BodyId ball : balls) speeds.push_back(world.twist(ball).linear.x());
  return speeds;
}

}  // namespace

TEST_CASE("of five balls that touch, or nearly, as many fly off as came, and the others rest, at any rate") {
  for (const double gap : {0.0, 1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 0.01})
    for (const double rate : {30.0, 60.0, 100.0, 240.0, 1000.0})
      for (int coming = 1; coming < (gap > 1e-3 ? 2 : 5); ++coming) {
        CAPTURE(gap);
        CAPTURE(rate);
        CAPTURE(coming);
        const std::vector<double> speeds = row_after_blow(gap, rate, coming, 5 - coming);
        for (std::size_t i = 0; i < 5; ++i) CHECK(near(speeds[i], static_cast<int>(i) < 5 - coming ? 0 : 3, 1e-6));
      }
}

TEST_CASE("a ball that meets two at once sends both off alike") {
  World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
  BodySettings ball;
  ball.shape.solid = Sphere{0.5};
  ball.mass = 1;
  ball.friction = 0;
  ball.restitution = 1;
  ball.motion.pose.position = Vec3(-2, 0, 0);
  ball.motion.twist.linear = Vec3(3, 0, 0);
  const BodyId cue = world.add(ball);
  ball.motion.twist.linear = Vec3::Zero();
  ball.motion.pose.position = Vec3(0, 0, 0.5);
  const BodyId left = world.add(ball);
  ball.motion.pose.position = Vec3(0, 0, -0.5);
  const BodyId right = world.add(ball);
  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  // Normals at 30 degrees; u = 3 / (1 + 2 c^2) * 2 c each, with c^2 = 3 / 4.
  const double c = std::sqrt(0.75), each = 3 * 2 * c / (1 + 2 * c * c);
  CHECK(near(world.twist(cue).linear, Vec3(3 - 2 * c * each, 0, 0), 1e-6));
  CHECK(near(world.twist(left).linear, Vec3(c * each, 0, 0.5 * each), 1e-6));
  CHECK(near(world.twist(right).linear, Vec3(c * each, 0, -0.5 * each), 1e-6));
}

TEST_CASE("a column of twenty boxes or balls that falls piece by piece overlaps by little and ends upright") {
  // Each falls onto the one before it, which the floor has only just stopped: in a step of 1/60 s by up to 10 cm.
  for (const Solid& solid : {Solid(Box{Vec3(0.5, 0.5, 0.5)}), Solid(Sphere{0.5})})
    for (const double restitution : {0.0, 0.1, 0.5})
      for (const double rate : {60.0, 220.0, 240.0, 245.0}) {
        World world({.sleep_after = std::numeric_limits<double>::infinity()});
        world.add({.shape = {Plane{}}, .restitution = restitution, .fixed = true});
        std::vector<BodyId> column;
        for (int i = 0; i < 20; ++i) {
          BodySettings piece;
          piece.shape.solid = solid;
          piece.restitution = restitution;
          piece.motion.pose.position.y() = 0.5 + i + 0.1 * (i + 1);
          column.push_back(world.add(piece));
        }
        double deepest = 0;
        for (int i = 0; i < 2 * rate; ++i) {
          world.step(1 / rate);
          double below = -0.5;
          for (const BodyId piece : column) {
            const double height = world.motion(piece).pose.position.y();
            deepest = std::max(deepest, below + 1 - height);
            below = height;
          }
        }
        CAPTURE(solid.index());
        CAPTURE(restitution);
        CAPTURE(rate);
        CHECK(deepest < (rate > 200 ? 0.002 : 0.006));
        CHECK(near(world.motion(column.back()).pose.position.y(), 19.5, 0.015));
      }
}

TEST_CASE("balls that rain into a box overlap by less than a tenth of their radius") {
  // As in a scene of 5,000 of them, in which other engines were measured when all had come to rest: 24 mm (Jolt), 33
  // (Box3D), 43 (Bullet); while they fell Bullet's overlapped by 111 mm.
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  const auto wall = [&](const Vec3& half, const Vec3& at) {
    world.add({.shape = {Box{half}}, .restitution = 0.2, .fixed = true, .motion = {.pose = {.position = at}}});
  };
  wall(Vec3(10, 1, 10), Vec3(0, -1, 0));
  for (const double side : {-1.0, 1.0}) {
    wall(Vec3(0.5, 10, 3), Vec3(side * 2, 10, 0));
    wall(Vec3(3, 10, 0.5), Vec3(0, 10, side * 2));
  }
  test::Random random(3);
  std::vector<BodyId> balls;
  for (int i = 0; i < 5 * 5 * 10; ++i) {
    BodySettings ball;
    ball.shape.solid = Sphere{0.25};
    ball.mass = 1;
    ball.restitution = 0.2;
    ball.motion.pose.position =
        Vec3(0.55 * (i % 5 - 2) + random.between(-0.02, 0.02), 1 + 0.55 * (i / 25) + random.between(-0.02, 0.02),
             0.55 * (i / 5 % 5 - 2) + random.between(-0.02, 0.02));
    balls.push_back(world.add(ball));
  }
  double deepest = 0;
  for (int i = 0; i < 90; ++i) {
    world.step(1.0 / 60);
    for (std::size_t a = 0; a < balls.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        deepest = std::max(deepest,
                           0.5 - (world.motion(balls[a]).pose.position - world.motion(balls[b]).pose.position).norm());
  }
  CHECK(deepest < 0.024);
}

TEST_CASE("a ball and a box that bounce without loss, wedged between walls, stay finite and gain no energy") {
  for (const double room : {0.9999, 1.0, 1.0001})
    for (const Solid& solid : {Solid(Sphere{0.5}), Solid(Box{Vec3(0.5, 0.5, 0.5)})}) {
      World world({.gravity = Vec3::Zero(), .push_out_speed = 0});
      for (const double side : {-1.0, 1.0})
        world.add({.shape = {Box{Vec3(1, 1, 1)}},
                   .restitution = 1,
                   .fixed = true,
                   .motion = {.pose = {.position = Vec3(side * (1 + 0.5 * room), 0, 0)}}});
      BodySettings wedged;
      wedged.shape.solid = solid;
      wedged.restitution = 1;
      wedged.friction = 0;
      wedged.mass = 1;
      wedged.motion.twist.linear = Vec3(3, 0.1, 0);
      const BodyId body = world.add(wedged);
      const double energy = world.kinetic_energy();
      for (int i = 0; i < 30; ++i) {
        world.step(1.0 / 60);
        REQUIRE(world.motion(body).pose.position.allFinite());
        CHECK(world.kinetic_energy() <= energy * (1 + 1e-9));
      }
      CAPTURE(room);
      CHECK(std::abs(world.motion(body).pose.position.x()) < 0.01);
    }
}
