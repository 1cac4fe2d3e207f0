#include <tweenfall/curves/rotation.h>

#include "physics/scene.h"

using namespace tweenfall;
using test::near;

TEST_CASE("an untouched body follows the parabola for any split of the time") {
  for (const int pieces : {1, 7, 64, 480}) {
    World world;
    BodySettings settings;
    settings.motion.twist.linear = Vec3(3, 4, 0);
    const BodyId body = world.add(settings);
    test::Random random(static_cast<std::uint64_t>(pieces));
    double time = 0;
    for (int i = 0; i < pieces; ++i) {
      const double dt = random.between(0.5, 1.5) * 2 / pieces;
      world.step(dt);
      time += dt;
    }
    CHECK(near(world.motion(body).pose.position, Vec3(3 * time, 4 * time - 0.5 * 9.81 * time * time, 0), 1e-12));
    CHECK(near(world.twist(body).linear, Vec3(3, 4 - 9.81 * time, 0), 1e-12));
  }
}

TEST_CASE("the lecture's projectile is where its table says, second after second") {
  WorldSettings settings;
  settings.gravity = Vec3(0, -1, 0);
  World world(settings);
  BodySettings ball;
  ball.motion.twist.linear = Vec3(3, 4, 0);
  const BodyId body = world.add(ball);
  const double heights[] = {3.5, 6, 7.5, 8, 7.5, 6, 3.5, 0};
  for (int second = 1; second <= 8; ++second) {
    world.step(1);
    CHECK(near(world.motion(body).pose.position, Vec3(3.0 * second, heights[second - 1], 0), 1e-13));
  }
}

TEST_CASE("semi-implicit Euler ends g dt^2 n (n + 1) / 2 below, as its series says") {
  WorldSettings settings;
  settings.integrator = Integrator::semi_implicit_euler;
  World world(settings);
  const BodyId body = world.add({});
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  CHECK(near(world.motion(body).pose.position.y(), -9.81 / 3600 * 60 * 61 / 2, 1e-12));
}

TEST_CASE("a tumbling box keeps its energy and its angular momentum, and flips") {
  for (test::Scene& scene : test::scenes("dzhanibekov")) {
    CAPTURE(scene.file["name"].get<std::string>());
    const BodyId body = scene.bodies.back();
    const auto momentum = [&] {
      const Motion motion = scene.world.motion(body);
      const Mat3 axes = motion.pose.rotation.toRotationMatrix();
      return Vec3(axes * scene.world.mass(body).inertia * axes.transpose() * motion.twist.angular);
    };
    const double turning = scene.world.motion(body).twist.angular.z();
    const double energy = scene.world.kinetic_energy();
    const Vec3 start = momentum();
    double worst = 0, lowest = 1e9;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      worst = std::max(worst, std::abs(scene.world.kinetic_energy() / energy - 1));
      const Motion motion = scene.world.motion(body);
      lowest = std::min(lowest, (motion.pose.rotation.conjugate() * motion.twist.angular).z());
    }
    CHECK(worst < 1e-4);
    CHECK((momentum() - start).norm() < 1e-9 * start.norm());
    CHECK(lowest < -0.98 * turning);
  }
}

TEST_CASE("a needle that tumbles keeps its spin, and points where its closed form says, however thin it is") {
  // Two moments equal and one different: it goes around its angular momentum by L / I, and keeps its spin about itself.
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  settings.sleep_after = std::numeric_limits<double>::infinity();
  const double rate = 1000 * test::pi / 180;
  for (const Vec3& size :
       {Vec3(0.1, 1, 0.1), Vec3(1e-3, 1, 1e-3), Vec3(1e-6, 1, 1e-6), Vec3(1, 1e-6, 1), Vec3(1e6, 1e-6, 1e6)}) {
    CAPTURE(size.y());
    World world(settings);
    BodySettings needle;
    needle.shape = {Box{0.5 * size}};
    needle.mass = 1;
    needle.motion.twist.angular = Vec3(rate, rate, rate);
    const BodyId body = world.add(needle);
    const Mat3 inertia = world.mass(body).inertia;
    const Vec3 momentum = inertia * needle.motion.twist.angular;
    for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
    const Motion motion = world.motion(body);
    const Vec3 own = motion.pose.rotation.conjugate() * motion.twist.angular;
    // The rounding of the large momentum is large for the small moment.
    const double rounding = 1e-6 + 1e-14 * inertia(0, 0) / inertia(1, 1);
    CHECK(own.y() == doctest::Approx(rate).epsilon(rounding));
    CHECK(std::hypot(own.x(), own.z()) == doctest::Approx(std::sqrt(2.0) * rate).epsilon(1e-6));
    const Vec3 points = exp_map(momentum * (2 / inertia(0, 0))) * Vec3(0, 1, 0);
    CHECK(near(motion.pose.rotation * Vec3(0, 1, 0), points, 1e-3));
  }
}

TEST_CASE("a flat body that is no top keeps its energy and its angular momentum, however unlike its moments are") {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  settings.sleep_after = std::numeric_limits<double>::infinity();
  for (const Vec3& size : {Vec3(0.01, 1, 0.02), Vec3(1e-4, 1, 2e-3), Vec3(1e-3, 1, 2), Vec3(1e-5, 1, 1e-4)}) {
    CAPTURE(size.x());
    World world(settings);
    BodySettings blade;
    blade.shape = {Box{0.5 * size}};
    blade.mass = 1;
    blade.motion.twist.angular = Vec3(3, 5, 4);
    const BodyId body = world.add(blade);
    const auto momentum = [&] {
      const Mat3 axes = world.motion(body).pose.rotation.toRotationMatrix();
      return Vec3(axes * world.mass(body).inertia * axes.transpose() * world.motion(body).twist.angular);
    };
    const Vec3 start = momentum();
    const double energy = world.kinetic_energy();
    for (int i = 0; i < 1200; ++i) {
      world.step(1.0 / 240);
      REQUIRE(world.kinetic_energy() == doctest::Approx(energy).epsilon(1e-6));
    }
    CHECK((momentum() - start).norm() < 1e-9 * start.norm());
    CHECK(world.motion(body).twist.angular.norm() < 10 * blade.motion.twist.angular.norm());
  }
}

TEST_CASE("a mass on a spring swings with period 2 pi sqrt(m / k) and keeps its energy") {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  World world(settings);
  BodySettings ball;
  ball.mass = 2;
  ball.motion.pose.position = Vec3(1.5, 0, 0);
  const BodyId body = world.add(ball);
  world.add_force(Spring{.a = body, .anchor_b = Vec3(0, 0, 0), .rest_length = 1, .stiffness = 50});
  const double w = 5, dt = 1.0 / 240;
  for (int i = 0; i < 2400; ++i) world.step(dt);
  CHECK(near(world.motion(body).pose.position.x(), 1 + 0.5 * std::cos(w * 10), 1e-3));
  const double stretch = world.motion(body).pose.position.x() - 1;
  CHECK(near(world.kinetic_energy() + 25 * stretch * stretch, 25 * 0.25, 1e-3));
}

TEST_CASE("drag brings a falling body to m g / c and no faster") {
  World world;
  BodySettings ball;
  ball.mass = 2;
  const BodyId body = world.add(ball);
  world.add_force(Drag{.linear = 4});
  for (int i = 0; i < 2400; ++i) world.step(1.0 / 240);
  CHECK(near(world.twist(body).linear.y(), -2 * 9.81 / 4, 1e-6));
}

TEST_CASE("a damped body comes to rest after speed over damping, exactly") {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  settings.sleep_after = std::numeric_limits<double>::infinity();
  World world(settings);
  BodySettings ball;
  ball.linear_damping = 4;
  ball.motion.twist.linear = Vec3(2, 0, 0);
  const BodyId body = world.add(ball);
  for (int i = 0; i < 2880; ++i) world.step(1.0 / 240);
  CHECK(near(world.motion(body).pose.position.x(), 0.5, 1e-10));
}

TEST_CASE("a capsule that tumbles freely lies as the closed form of a top says, after one step as after thousands") {
  const Vec3 moments(0.0929, 0.041, 0.0929), spin(3, -5, 2);
  const Quat start(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
  constexpr double seconds = 2;
  // It spins about its axis, which goes around the momentum.
  const Vec3 momentum = start * Vec3(moments.cwiseProduct(start.conjugate() * spin));
  const double about_axis = (start.conjugate() * spin).y() * (1 - moments.y() / moments.x());
  const Vec3 around = momentum / moments.x();
  const Quat end = Quat(Eigen::AngleAxisd(around.norm() * seconds, around.normalized())) * start *
                   Quat(Eigen::AngleAxisd(about_axis * seconds, Vec3(0, 1, 0)));
  for (const int steps : {1, 7, 120, 4800}) {
    CAPTURE(steps);
    World world({.gravity = Vec3::Zero(), .sleep_after = std::numeric_limits<double>::infinity()});
    BodySettings settings{.shape = {Capsule{0.3, 0.25}}};
    settings.mass_properties = MassProperties{1, Vec3::Zero(), Mat3(moments.asDiagonal())};
    settings.motion.pose.rotation = start;
    settings.motion.twist.angular = spin;
    const BodyId body = world.add(settings);
    for (int i = 0; i < steps; ++i) world.step(seconds / steps);
    CHECK(world.motion(body).pose.rotation.angularDistance(end) < 1e-7);
    const Vec3 now = end * Vec3((end.conjugate() * momentum).cwiseQuotient(moments));
    CHECK((world.twist(body).angular - now).norm() < 1e-11 * steps + 1e-12);
  }
}
