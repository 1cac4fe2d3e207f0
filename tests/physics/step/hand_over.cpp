#include <limits>

#include "physics/scene.h"

using namespace tweenfall;
using test::near;

namespace {

Motion at(const Vec3& position, const Vec3& velocity) {
  Motion motion;
  motion.pose.position = position;
  motion.twist.linear = velocity;
  return motion;
}

struct Row {
  World world;
  BodyId ground, pusher;
  std::vector<BodyId> boxes;
  std::vector<Vec3> path;
};

Row push_row(int count) {
  Row row;
  row.ground = row.world.add({.shape = {Plane{}}, .friction = 0.5, .fixed = true});
  BodySettings box;
  box.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
  box.mass = 1;
  box.drive = Drive::keyed();
  box.motion.pose.position = Vec3(0, 0.5, 0);
  row.pusher = row.world.add(box);
  box.drive = Drive::free();
  for (int i = 1; i <= count; ++i) {
    box.motion.pose.position = Vec3(i, 0.5, 0);
    row.boxes.push_back(row.world.add(box));
  }
  for (int i = 1; i <= 960; ++i) {
    row.world.set_target(row.pusher, at(Vec3(i / 240.0, 0.5, 0), Vec3(1, 0, 0)));
    row.world.step(1.0 / 240);
    row.path.push_back(row.world.motion(row.pusher).pose.position);
  }
  return row;
}

}  // namespace

TEST_CASE("a keyed box pushes a row of five at its own speed and is not pushed") {
  const Row row = push_row(5);
  const Row alone = push_row(0);
  CHECK(row.path == alone.path);
  double x = 4;
  for (const BodyId box : row.boxes) {
    CHECK(near(row.world.twist(box).linear.x(), 1.0, 1e-3));
    const double next = row.world.motion(box).pose.position.x();
    CHECK(next - x > 1 - 0.005);
    x = next;
  }
  // What it gave them is their momentum plus what the floor's friction took.
  double momentum = 0;
  for (const BodyId box : row.boxes) momentum += row.world.twist(box).linear.x();
  CHECK(near(-row.world.reaction(row.pusher).x(), momentum + row.world.reaction(row.ground).x(), 1e-9));
  CHECK(row.world.reaction(row.ground).x() > 50);
}

TEST_CASE("momentum is what gravity, the floor and the keyed bodies gave") {
  WorldSettings settings;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  World world(settings);
  const BodyId ground = world.add({.shape = {Plane{}}, .fixed = true});
  BodySettings box;
  box.shape.solid = Box{Vec3(0.3, 0.3, 0.3)};
  box.restitution = 0.3;
  test::Random random(11);
  std::vector<BodyId> bodies;
  Vec3 start = Vec3::Zero();
  double mass = 0;
  for (int i = 0; i < 12; ++i) {
    box.motion.pose.position = random.vector(0.6) + Vec3(0, 2 + i * 0.5, 0);
    box.motion.twist.linear = random.vector(1);
    bodies.push_back(world.add(box));
    start += world.mass(bodies.back()).mass * box.motion.twist.linear;
    mass += world.mass(bodies.back()).mass;
  }
  box.drive = Drive::keyed();
  box.motion = at(Vec3(-2, 0.3, 0), Vec3(0, 0, 0));
  const BodyId pusher = world.add(box);
  double passed = 0;
  for (int i = 1; i <= 480; ++i) {
    world.set_target(pusher, at(Vec3(-2 + i / 240.0, 0.3, 0), Vec3(1, 0, 0)));
    world.step(1.0 / 240);
    for (const Contact& contact : world.contacts()) passed += contact.total_impulse.norm();
  }
  Vec3 end = Vec3::Zero();
  for (const BodyId body : bodies) {
    CHECK(!world.asleep(body));
    end += world.mass(body).mass * world.twist(body).linear;
  }
  const Vec3 given = mass * Vec3(0, -9.81, 0) * world.time() - world.reaction(ground) - world.reaction(pusher);
  CHECK((end - start - given).norm() < 1e-9 * passed);
}

TEST_CASE("a released body keeps its pose and its path's twist, told about its center of mass") {
  World world;
  BodySettings arm;
  arm.shape = {Box{Vec3(1, 0.1, 0.1)}};
  arm.shape.offset.position = Vec3(1, 0, 0);
  arm.drive = Drive::keyed();
  const BodyId body = world.add(arm);
  Motion target = at(Vec3(1, 2, 3), Vec3(0.5, 0, 0));
  target.twist.angular = Vec3(0, 0, 2);
  world.set_target(body, target);
  world.step(1.0 / 60);
  world.set_drive(body, Drive::free());
  CHECK(world.motion(body).pose.position == target.pose.position);
  CHECK(near(world.twist(body).linear, Vec3(0.5, 2, 0), 1e-12));
  CHECK(near(world.twist(body).angular, Vec3(0, 0, 2), 1e-12));
  const std::uint64_t before = world.state_hash();
  world.set_drive(body, Drive::free());
  CHECK(world.state_hash() == before);
  world.set_drive(body, Drive::keyed());
  world.set_drive(body, Drive::free());
  CHECK(near(world.twist(body).linear, Vec3(0.5, 2, 0), 1e-12));
}

TEST_CASE("a keyed body without a target stays where it is, with no velocity") {
  World world;
  BodySettings settings;
  settings.drive = Drive::keyed();
  const BodyId body = world.add(settings);
  world.set_target(body, at(Vec3(1, 0, 0), Vec3(60, 0, 0)));
  world.step(1.0 / 60);
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  CHECK(world.motion(body).pose.position == Vec3(1, 0, 0));
  CHECK(world.twist(body).linear == Vec3(0, 0, 0));
}

TEST_CASE("a driven body sags by g / w^2, lags by 2 z v / w, and not at all when told the velocity") {
  for (const double hz : {2.0, 5.0, 10.0}) {
    const double w = 2 * 3.14159265358979323846 * hz;
    BodySettings settings;
    settings.mass = 1;
    settings.drive = {.hz = hz};
    World hanging;
    const BodyId still = hanging.add(settings);
    for (int i = 0; i < 1200; ++i) {
      hanging.set_target(still, at(Vec3(0, 0, 0), Vec3(0, 0, 0)));
      hanging.step(1.0 / 240);
    }
    CHECK(std::abs(-hanging.motion(still).pose.position.y() / (9.81 / (w * w)) - 1) < 0.01);
    for (const bool told : {false, true}) {
      WorldSettings weightless;
      weightless.gravity = Vec3::Zero();
      World world(weightless);
      const BodyId body = world.add(settings);
      for (int i = 1; i <= 1200; ++i) {
        world.set_target(body, at(Vec3(i / 240.0, 0, 0), Vec3(told ? 1 : 0, 0, 0)));
        world.step(1.0 / 240);
      }
      const double lag = 5 - world.motion(body).pose.position.x();
      if (told) CHECK(std::abs(lag) < 1e-12);
      if (!told) CHECK(std::abs(lag / (2 / w) - 1) < 0.01);
    }
  }
}

TEST_CASE("a drive of frequency 0 gives the bits of a free body, through flight and contact") {
  World worlds[2];
  BodyId bodies[2];
  for (int i = 0; i < 2; ++i) {
    World& world = worlds[i];
    world.add({.shape = {Plane{}}, .fixed = true});
    BodySettings box;
    box.shape = {Box{Vec3(0.3, 0.2, 0.4)}};
    box.shape.offset.position = Vec3(0.1, 0, 0.05);
    box.restitution = 0.4;
    // The damping ratio means nothing without a frequency.
    box.drive = i == 0 ? Drive::free() : Drive{.hz = 0, .zeta = 0.7};
    box.motion = at(Vec3(0, 2, 0), Vec3(1, 0.5, 0));
    box.motion.twist.angular = Vec3(3, -2, 1);
    bodies[i] = world.add(box);
  }
  for (int step = 1; step <= 300; ++step) {
    Motion shown[2];
    for (int i = 0; i < 2; ++i) {
      worlds[i].step(1.0 / 120);
      shown[i] = worlds[i].motion(bodies[i]);
    }
    CHECK(shown[0].pose.position == shown[1].pose.position);
    CHECK(shown[0].pose.rotation.coeffs() == shown[1].pose.rotation.coeffs());
    CHECK(shown[0].twist.linear == shown[1].twist.linear);
    CHECK(shown[0].twist.angular == shown[1].twist.angular);
  }
}

TEST_CASE("a very stiff drive is off by zeta a h / w within 2 %") {
  for (const double hz : {1e3, 1e6, 1e9}) {
    CAPTURE(hz);
    WorldSettings settings;
    settings.gravity = Vec3::Zero();
    World world(settings);
    BodySettings ball;
    ball.drive = {.hz = hz};
    const BodyId body = world.add(ball);
    const double h = 1.0 / 60, a = 11.8;
    // It comes to rest at the origin, so that its position has more digits than the error. It leads because
    // the end of the step is reached with the velocity that is wanted there.
    double error = 0;
    for (int i = 1; i <= 120; ++i) {
      const double t = (i - 120) * h;
      world.set_target(body, at(Vec3(0.5 * a * t * t, 0, 0), Vec3(a * t, 0, 0)));
      world.step(h);
      error = world.motion(body).pose.position.x() - 0.5 * a * t * t;
    }
    const double expected = a * h / (2 * 3.14159265358979323846 * hz);
    CHECK(std::abs(error / expected - 1) < 0.02);
  }
}
