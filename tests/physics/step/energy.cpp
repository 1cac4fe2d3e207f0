#include "physics/scene.h"

using namespace tweenfall;

namespace {

/// Kinetic energy plus that of height, J.
double energy_of(const World& world) {
  double sum = world.kinetic_energy();
  for (const BodyId body : world.bodies())
    if (!world.is_fixed(body)) sum += 9.81 * world.mass(body).mass * world.motion(body).pose.position.y();
  return sum;
}

}  // namespace

TEST_CASE("a box or a capsule that tumbles and bounces at restitution 1 never has more energy than at the start") {
  constexpr double degree = 3.14159265358979323846 / 180;
  const Solid solids[] = {Box{Vec3(0.15, 0.1, 0.25)}, Capsule{0.1, 0.2}, Box{Vec3(0.3, 0.05, 0.1)}};
  for (const Solid& solid : solids)
    for (const double rate : {60.0, 240.0, 100.0})
      for (const Vec3& spin : {Vec3(120, 40, 250), Vec3(-300, 500, 20), Vec3(0, 0, 90), Vec3(900, 100, -700)})
        for (const double friction : {0.0, 0.5}) {
          World world({.sleep_after = std::numeric_limits<double>::infinity()});
          world.add({.shape = {Plane{}}, .friction = friction, .fixed = true});
          BodySettings body;
          body.shape.solid = solid;
          body.mass = 1;
          body.friction = friction;
          body.restitution = 1;
          body.motion.pose.position = Vec3(0, 1, 0);
          body.motion.twist.angular = degree * spin;
          const BodyId tumbling = world.add(body);
          CAPTURE(solid.index());
          CAPTURE(rate);
          CAPTURE(spin);
          CAPTURE(friction);
          const double start = energy_of(world);
          double most = 0, deepest = 1;
          for (int i = 0; i < static_cast<int>(4 * rate); ++i) {
            world.step(1 / rate);
            most = std::max(most, energy_of(world));
            deepest = std::min(deepest, bounds(world.shape(tumbling), world.motion(tumbling).pose).low.y());
          }
          CHECK(most / start - 1 <= 1e-9);
          CHECK(deepest > (rate < 200 ? -0.1 : -0.025));
          if (friction == 0) CHECK(energy_of(world) > 0.5 * start);
        }
}

TEST_CASE("a gas of 27 boxes or capsules at restitution 1 keeps its energy within a percent and never gains any") {
  for (const Solid& solid : {Solid(Box{Vec3(0.25, 0.2, 0.3)}), Solid(Capsule{0.2, 0.2})}) {
    World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
    for (int wall = 0; wall < 6; ++wall) {
      Vec3 inward = Vec3::Zero();
      inward[wall % 3] = wall < 3 ? 1 : -1;
      BodySettings plane;
      plane.shape.solid = Plane{};
      plane.fixed = true;
      plane.friction = 0;
      plane.motion.pose = {.position = -3 * inward, .rotation = Quat::FromTwoVectors(Vec3(0, 1, 0), inward)};
      world.add(plane);
    }
    test::Random random(1);
    const auto any = [&] { return Vec3(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)); };
    for (int i = 0; i < 27; ++i) {
      BodySettings body;
      body.shape.solid = solid;
      body.mass = 1;
      body.friction = 0;
      body.restitution = 1;
      body.motion.pose.position = 1.5 * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      body.motion.twist = {any(), any()};
      world.add(body);
    }
    const double start = world.kinetic_energy();
    double most = 0, farthest = 0;
    for (int i = 0; i < 10 * 240; ++i) {
      world.step(1.0 / 240);
      most = std::max(most, world.kinetic_energy());
    }
    for (const BodyId body : world.bodies())
      if (!world.is_fixed(body)) farthest = std::max(farthest, world.motion(body).pose.position.cwiseAbs().maxCoeff());
    CAPTURE(solid.index());
    CHECK(most <= start * (1 + 1e-9));
    CHECK(world.kinetic_energy() > 0.99 * start);
    CHECK(farthest < 3);
  }
}

TEST_CASE("a gas of 64 balls at restitution 1 keeps its energy for 20 s") {
  World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
  for (int wall = 0; wall < 6; ++wall) {
    Vec3 normal = Vec3::Zero();
    normal[wall / 2] = wall % 2 == 0 ? -1 : 1;
    world.add({.shape = {Plane{normal, -2}}, .friction = 0, .restitution = 1, .fixed = true});
  }
  test::Random random(64);
  for (int i = 0; i < 64; ++i)
    world.add({.shape = {Sphere{0.2}},
               .mass = 1,
               .friction = 0,
               .restitution = 1,
               .motion = {.pose = {.position = Vec3(i % 4, i / 4 % 4, i / 16) - Vec3(1.5, 1.5, 1.5)},
                          .twist = {.linear = random.vector(3)}}});
  const double start = world.kinetic_energy();
  double most = start;
  for (int i = 0; i < 20 * 240; ++i) {
    world.step(1.0 / 240);
    most = std::max(most, world.kinetic_energy());
  }
  CHECK(most <= start * (1 + 1e-9));
  CHECK(world.kinetic_energy() > start * (1 - 1e-9));
}

TEST_CASE("what meets while it falls freely gains no energy by it, in no step") {
  const Solid solids[] = {Sphere{0.1}, Capsule{0.05, 0.1}, Box{Vec3(0.2, 0.05, 0.1)}, Cylinder{0.1, 0.1}};
  for (const Solid& solid : solids)
    for (const double rate : {120.0, 60.0})
      for (const double restitution : {1.0, 0.6})
        for (const double speed : {2.0, 5.0})
          for (const int tilt : {0, 1, 2}) {
            World world({.sleep_after = std::numeric_limits<double>::infinity()});
            BodySettings body;
            body.shape.solid = solid;
            body.mass = 0.7;
            body.friction = 0.2 * (tilt % 2);
            body.restitution = restitution;
            body.motion.pose.position = Vec3(-0.3, 0, 0);
            body.motion.twist.linear = Vec3(speed, 0.3, 0);
            world.add(body);
            body.mass = 1.1;
            body.motion.pose.position = Vec3(0.3, 0.03 * tilt, 0);
            body.motion.pose.rotation =
                Quat(std::cos(0.2 * tilt), 0, 0.6 * std::sin(0.2 * tilt), 0.8 * std::sin(0.2 * tilt));
            body.motion.twist = {Vec3(-speed, 0, 0), Vec3(0.5 * tilt, tilt, 1.5 * tilt)};
            world.add(body);
            CAPTURE(solid.index());
            CAPTURE(rate);
            CAPTURE(restitution);
            CAPTURE(speed);
            CAPTURE(tilt);
            const double scale = world.kinetic_energy();
            double before = energy_of(world), worst = 0;
            for (int i = 0; i < static_cast<int>(0.5 * rate); ++i) {
              world.step(1 / rate);
              const double now = energy_of(world);
              worst = std::max(worst, now - before);
              before = now;
            }
            CHECK(worst <= 1e-12 * scale);
          }
}

TEST_CASE("momentum is kept when the last pass is the first to reach a body") {
  // A row of balls along which a blow runs: each passes it on late.
  for (const int count : {3, 6, 12, 30})
    for (const double restitution : {0.0, 0.5, 1.0})
      for (const double gap : {0.0, 1e-4, 1e-3, 0.01}) {
        World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
        std::vector<BodyId> balls;
        for (int i = 0; i < count; ++i) {
          BodySettings ball;
          ball.shape.solid = i % 2 == 0 ? Solid(Sphere{0.5}) : Solid(Box{Vec3(0.5, 0.5, 0.5)});
          ball.mass = 1 + i % 3;
          ball.restitution = restitution;
          ball.motion.pose.position = Vec3((1 + gap) * i, 0, 0);
          if (i == 0) ball.motion.twist.linear = Vec3(5, 0, 0);
          balls.push_back(world.add(ball));
        }
        CAPTURE(count);
        CAPTURE(restitution);
        CAPTURE(gap);
        double worst = 0, most = 0;
        const double energy = world.kinetic_energy();
        for (int i = 0; i < 120; ++i) {
          world.step(1.0 / 120);
          Vec3 sum = Vec3::Zero();
          for (const BodyId ball : balls) sum += world.mass(ball).mass * world.twist(ball).linear;
          worst = std::max(worst, (sum - Vec3(5, 0, 0)).norm());
          most = std::max(most, world.kinetic_energy());
        }
        CHECK(worst < 1e-12);
        CHECK(most <= energy * (1 + 1e-9));
      }
}

TEST_CASE("what rolls about its axis and turns about the vertical on a slippery floor gains no energy") {
  // Without friction, only the normals act, and they do no work.
  const Solid solids[] = {Capsule{0.15, 0.3}, Cylinder{0.15, 0.3}};
  for (const Solid& solid : solids)
    for (const double rate : {60.0, 240.0})
      for (const double roll : {10.0, 30.0})
        for (const double turn : {3.0, 10.0}) {
          CAPTURE(kind_name(solid));
          CAPTURE(rate);
          CAPTURE(roll);
          CAPTURE(turn);
          World world({.sleep_after = std::numeric_limits<double>::infinity()});
          world.add({.shape = {Plane{}}, .friction = 0, .fixed = true});
          BodySettings body{.shape = {solid}, .mass = 1.0, .friction = 0};
          body.motion.pose.position.y() = 0.15;
          body.motion.pose.rotation = Quat(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vec3::UnitX()));
          body.motion.twist.angular = Vec3(0, turn, roll);
          world.add(body);
          const double start = energy_of(world);
          double most = 0;
          for (int i = 0; i < 4 * rate; ++i) {
            world.step(1 / rate);
            most = std::max(most, energy_of(world));
          }
          CHECK(most < 1.04 * start);
        }
}

TEST_CASE("a floor that brakes at nearly g presses on what rides on it with g less its own braking") {
  for (const double most : {3.0, 4.9348, 7.0, 9.0})
    for (const double rate : {240.0, 60.0}) {
      World world({.sleep_after = std::numeric_limits<double>::infinity()});
      const double w = 3.14159265358979323846, amplitude = most / (w * w);
      BodySettings lift;
      lift.shape.solid = Box{Vec3(0.5, 0.1, 0.5)};
      lift.drive = Drive::keyed();
      const auto motion = [&](double time) {
        Motion result;
        result.pose.position.y() = -amplitude * std::cos(w * time);
        result.twist.linear.y() = amplitude * w * std::sin(w * time);
        return result;
      };
      lift.motion = motion(0);
      const BodyId floor = world.add(lift);
      BodySettings rider;
      rider.shape.solid = Box{Vec3(0.15, 0.15, 0.15)};
      rider.mass = 1.2;
      rider.motion.pose.position.y() = -amplitude + 0.25;
      world.add(rider);
      double worst = 0;
      Vec3 before = Vec3::Zero();
      for (int i = 1; i <= static_cast<int>(4 * rate); ++i) {
        world.set_target(floor, motion(i / rate));
        world.step(1 / rate);
        const double force = -(world.reaction(floor) - before).y() * rate / 1.2;
        before = world.reaction(floor);
        const double right = 9.81 + most * std::cos(w * (i - 0.5) / rate);
        if (i > 0.5 * rate) worst = std::max(worst, std::abs(force / right - 1));
      }
      CAPTURE(most);
      CAPTURE(rate);
      CHECK(worst < (rate == 240 ? 0.01 : 0.05));
    }
}
