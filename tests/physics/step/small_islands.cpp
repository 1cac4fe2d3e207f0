#include <tweenfall/physics/world.h>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

BodySettings solid_at(const Solid& solid, const Vec3& place, double mass) {
  BodySettings body;
  body.shape.solid = solid;
  body.motion.pose.position = place;
  body.mass = mass;
  return body;
}

}  // namespace

TEST_CASE("a thousand kilograms and a million rest on one, and sink in by less than a millimeter") {
  const Solid box = Box{Vec3(0.5, 0.5, 0.5)}, ball = Sphere{0.5};
  for (const double rate : {60.0, 240.0})
    for (const double mass : {30.0, 1e3, 1e6})
      for (const auto& [below, above] : {std::pair(box, box), std::pair(ball, box), std::pair(box, ball)}) {
        World world({.sleep_after = forever});
        world.add({.shape = {Plane{}}, .fixed = true});
        const BodyId light = world.add(solid_at(below, Vec3(0, 0.5, 0), 1));
        const BodyId heavy = world.add(solid_at(above, Vec3(0, 1.5, 0), mass));
        double deepest = 0;
        for (int i = 0; i < static_cast<int>(1.5 * rate); ++i) {
          world.step(1 / rate);
          const double low = world.motion(light).pose.position.y(), high = world.motion(heavy).pose.position.y();
          deepest = std::max({deepest, 0.5 - low, low + 1 - high});
        }
        CAPTURE(rate);
        CAPTURE(mass);
        CHECK(deepest < 1e-3);
        CHECK(world.twist(heavy).linear.norm() < 1e-6);
      }
}

TEST_CASE("a hundred kilograms rest on ten boxes of one, and a thousand that fall on one crush it by millimeters") {
  World tower({.sleep_after = forever});
  tower.add({.shape = {Plane{}}, .fixed = true});
  BodyId top;
  for (int i = 0; i < 11; ++i)
    top = tower.add(solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 0.5 + i, 0), i == 10 ? 100 : 1));
  for (int i = 0; i < 300; ++i) tower.step(1.0 / 60);
  CHECK(tower.motion(top).pose.position.y() > 10.499);

  World press({.sleep_after = forever});
  press.add({.shape = {Plane{}}, .fixed = true});
  const BodyId below = press.add(solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 0.5, 0), 1));
  const BodyId falling = press.add(solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 2.5, 0), 1000));
  double deepest = 0;
  for (int i = 0; i < 300; ++i) {
    press.step(1.0 / 60);
    const double low = press.motion(below).pose.position.y(), high = press.motion(falling).pose.position.y();
    deepest = std::max({deepest, 0.5 - low, low + 1 - high});
  }
  CHECK(deepest < 0.02);
  CHECK(press.motion(falling).pose.position.y() > 1.499);
}

TEST_CASE("a thousand kilograms rest on ten boxes of one, in a column or a pyramid") {
  const Solid box = Box{Vec3(0.5, 0.5, 0.5)};
  for (const bool pyramid : {false, true})
    for (const double rate : {60.0, 200.0}) {
      World world({.sleep_after = forever});
      world.add({.shape = {Plane{}}, .fixed = true});
      const int rows = pyramid ? 4 : 10;
      for (int row = 0; row < rows; ++row)
        for (int i = 0; i < (pyramid ? rows - row : 1); ++i)
          world.add(solid_at(box, Vec3(pyramid ? 1.05 * (i - 0.5 * (rows - 1 - row)) : 0, 0.5 + row, 0), 1));
      const BodyId heavy = world.add(solid_at(box, Vec3(0, 0.5 + rows, 0), 1000));
      double deepest = 0, fastest = 0;
      for (int i = 0; i < (rate == 60 ? 0.5 : 0.1) * rate; ++i) {
        world.step(1 / rate);
        for (const Contact& contact : world.contacts())
          for (int k = 0; k < contact.manifold.count; ++k)
            deepest = std::max(deepest, contact.manifold.points[static_cast<std::size_t>(k)].penetration);
        for (const BodyId body : world.bodies()) fastest = std::max(fastest, world.twist(body).linear.norm());
      }
      CAPTURE(pyramid);
      CAPTURE(rate);
      CHECK(deepest < 1e-3);
      CHECK(fastest < 0.01);
      CHECK(world.motion(heavy).pose.position.y() > rows + 0.499);
    }
}

TEST_CASE("boxes, capsules and balls that meet in a plane stay in it to a billionth of a meter") {
  test::Random random(11);
  const Solid solids[] = {Box{Vec3(0.3, 0.2, 0.35)}, Capsule{0.15, 0.3}, Sphere{0.3}, Box{Vec3(0.15, 0.25, 0.4)}};
  constexpr int runs = 160;
  int left = 0;
  double farthest = 0;
  for (int run = 0; run < runs; ++run) {
    World world({.gravity = Vec3::Zero(), .sleep_after = forever});
    std::vector<BodyId> bodies;
    for (int i = 0; i < 2; ++i) {
      // In separate statements, since compilers differ in which argument they evaluate first.
      const double height = 0.2 * random.unit(), turn = 3 * random.unit(), toward = random.unit(), up = random.unit(),
                   spin = 5 * random.unit();
      BodySettings body = solid_at(solids[(i == 0 ? run : run / 4) % 4], Vec3(1.2 * i, height, 0), 1 + i);
      body.friction = run / 16 % 2 == 0 ? 0 : 0.5;
      body.restitution = 0.25 * (run % 5);
      body.motion.pose.rotation = Quat(Eigen::AngleAxisd(turn, Vec3(0, 0, 1)));
      body.motion.twist = {Vec3(i == 0 ? 4 : toward, up, 0), Vec3(0, 0, spin)};
      bodies.push_back(world.add(body));
    }
    for (int i = 0; i < 3 * 240; ++i) world.step(1.0 / 240);
    double off = 0;
    for (const BodyId body : bodies) off = std::max(off, std::abs(world.motion(body).pose.position.z()));
    if (off >= 1e-9) ++left;
    farthest = std::max(farthest, off);
  }
  MESSAGE(left, " of ", runs, " left the plane, by at most ", farthest, " m");
  CHECK(left == 0);
}

TEST_CASE("bullets of 100, 300 and 1,000 m/s do not pass a wall of a centimeter, also askew and spinning") {
  test::Random random(5);
  const ConvexHull wedge(
      std::vector<Vec3>{{0.05, 0.05, 0.05}, {-0.05, -0.05, 0.05}, {-0.05, 0.05, -0.05}, {0.05, -0.05, -0.05}});
  const Solid solids[] = {Sphere{0.01}, Box{Vec3(0.05, 0.02, 0.1)}, Capsule{0.02, 0.05},
                          Hull{wedge},  Cylinder{0.03, 0.06},       Box{Vec3(0.01, 0.01, 0.01)}};
  for (const double rate : {60.0, 240.0})
    for (const double speed : {100.0, 300.0, 1000.0})
      for (const Solid& solid : solids)
        for (int run = 0; run < 8; ++run) {
          World world({.sleep_after = forever});
          world.add({.shape = {Box{Vec3(0.005, 1000, 1000)}}, .fixed = true});
          BodySettings bullet = solid_at(solid, Vec3(-3 - random.unit(), random.unit(), random.unit()), 0.1);
          bullet.restitution = run % 3 == 0 ? 0.5 : 0;
          bullet.motion.pose.rotation = random.rotation();
          bullet.motion.twist.linear = speed * (Vec3(1, 0, 0) + (run < 2 ? 0 : 0.5) * random.vector(1)).normalized();
          bullet.motion.twist.angular = random.vector(run % 4 == 0 ? 0 : run % 4 == 1 ? 10 : run % 4 == 2 ? 100 : 600);
          const BodyId body = world.add(bullet);
          const double start = world.kinetic_energy();
          double most = 0, farthest = -1;
          for (int i = 0; i < static_cast<int>(0.1 * rate) + 2; ++i) {
            world.step(1 / rate);
            most = std::max(most, world.kinetic_energy());
            farthest = std::max(farthest, world.motion(body).pose.position.x());
          }
          CAPTURE(rate);
          CAPTURE(speed);
          CAPTURE(solid.index());
          CAPTURE(run);
          CHECK(farthest < 0);
          CHECK(most < 1.02 * start + 5);
        }
}

TEST_CASE("splinters that a blow spins up by thousands of radians per step do not pass thin walls, fixed or led") {
  test::Random random(7);
  for (int run = 0; run < 60; ++run) {
    CAPTURE(run);
    World world({.gravity = Vec3::Zero(), .sleep_after = forever});
    const double thick = 0.001 + 0.004 * (run % 5), rate = run % 3 == 0 ? 30 : run % 3 == 1 ? 60 : 240;
    const bool led = run % 4 == 0;
    world.add({.shape = {Box{Vec3(0.5 * thick, 3, 3)}}, .fixed = !led, .drive = led ? Drive::keyed() : Drive::free()});
    const double size = 0.006 + 0.004 * (run % 4);
    const Solid solid = run % 2 == 0 ? Solid(Box{size * Vec3(1, 0.1, 0.1)}) : Solid(Capsule{0.1 * size, size});
    BodySettings splinter = solid_at(solid, Vec3(-1 - random.unit(), 0, 0), 0.01);
    splinter.motion.pose.rotation = random.rotation();
    const double speed = 250 * (1 + run % 7), aside = 0.5 * random.unit(), up = 0.5 * random.unit();
    splinter.motion.twist.linear = speed * Vec3(1, aside, up).normalized();
    splinter.motion.twist.angular = random.vector(run % 3 == 0 ? 0 : 200);
    const BodyId body = world.add(splinter);
    double farthest = -1;
    for (int i = 0; i < 8; ++i) {
      world.step(1 / rate);
      farthest = std::max(farthest, world.motion(body).pose.position.x());
    }
    CHECK(farthest < 0);
  }
}

TEST_CASE("a plate that is pulled over the floor under 25 balls, and they, speed up as friction lets them, to 1e-6") {
  // The pull minus the floor's friction moves the plate and two sevenths of each ball's mass, which rolls back on it.
  for (const double force : {150.0, 200.0}) {
    World world({.sleep_after = forever});
    world.add({.shape = {Plane{}}, .friction = 0.4, .fixed = true});
    BodySettings plate = solid_at(Box{Vec3(10, 0.5, 10)}, Vec3(0, 0.49998, 0), 10);
    plate.friction = 0.4;
    const BodyId pulled = world.add(plate);
    std::vector<BodyId> balls;
    for (int x = -2; x <= 2; ++x)
      for (int z = -2; z <= 2; ++z) {
        BodySettings ball = solid_at(Sphere{0.5}, Vec3(2 * x, 1.49994, 2 * z), 1);
        ball.friction = 1.6;
        balls.push_back(world.add(ball));
      }
    const double net = force - 0.4 * 35 * 9.81, faster = net / (10 + 25 * 2.0 / 7), slower = 2 * faster / 7;
    const Vec3 along = Vec3(0.6, 0, 0.8);
    double plates = 0, all = 0;
    constexpr int steps = 400;
    for (int i = 1; i <= steps; ++i) {
      world.apply_force(pulled, force * along, world.motion(pulled).pose.position);
      world.step(1e-3);
      plates += (world.twist(pulled).linear - faster * 1e-3 * i * along).squaredNorm() / steps;
      for (const BodyId ball : balls)
        all += (world.twist(ball).linear - slower * 1e-3 * i * along).squaredNorm() / steps / 25;
    }
    CAPTURE(force);
    CHECK(plates < 1e-6);
    CHECK(all < 1e-6);
  }
}

TEST_CASE(
    "a ball whose spin is damped rolls on like exp(-2 d t / 7), and what else is solved along with it changes no bit") {
  constexpr double damping = 2, dt = 1.0 / 240;
  std::vector<Vec3> alone;
  for (const bool beside : {false, true}) {
    World world({.sleep_after = std::numeric_limits<double>::infinity()});
    world.add({.shape = {Plane{}}, .fixed = true});
    BodySettings ball{.shape = {Sphere{0.2}}, .mass = 2.0, .friction = 1, .angular_damping = damping};
    ball.motion.pose.position = Vec3(0, 0.2, 0);
    ball.motion.twist = {Vec3(1, 0, 0), Vec3(0, 0, -5)};
    const BodyId id = world.add(ball);
    if (beside) {
      BodySettings brick{.shape = {Box{Vec3(0.3, 0.1, 0.2)}}, .restitution = 0.5};
      brick.motion.pose.position = Vec3(5, 0.3, 0);
      brick.motion.twist.angular = Vec3(3, 4, 5);
      world.add(brick);
    }
    for (std::size_t i = 0; i < 240; ++i) {
      world.step(dt);
      const Vec3 velocity = world.twist(id).linear;
      CHECK(std::abs(velocity.x() - std::exp(-2 * damping * world.time() / 7)) < 5e-4);
      for (const Contact& contact : world.contacts())
        if (contact.b == id) CHECK(contact.impulse == doctest::Approx(2 * 9.81 * dt).epsilon(1e-3));
      if (beside)
        CHECK(velocity == alone[i]);
      else
        alone.push_back(velocity);
    }
  }
}

TEST_CASE("capsules that slide keep their bits beside far ones that resist spinning") {
  World alone, beside;
  std::vector<BodyId> ones, others;
  for (World* world : {&alone, &beside}) {
    world->add({.shape = {Box{{1000, 1, 1000}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
    for (int i = 0; i < 8; ++i) {
      BodySettings capsule{.shape = {Capsule{0.1, 0.2 + 0.01 * i}}, .mass = 1};
      capsule.motion.pose = {.position = {2.0 * i, 0.1, 0},
                             .rotation = Quat::FromTwoVectors(Vec3(0, 1, 0), Vec3(1, 0, 0))};
      capsule.motion.twist = {Vec3(1, 0, 0.3), Vec3(0, 0.4, 0)};
      (world == &alone ? ones : others).push_back(world->add(capsule));
      capsule.motion.pose.position.z() = 500;
      capsule.spinning_friction = 0.01;
      if (world == &beside) world->add(capsule);
    }
  }
  for (int n = 0; n < 60; ++n) {
    CAPTURE(n);
    alone.step(1.0 / 60);
    beside.step(1.0 / 60);
    for (std::size_t i = 0; i < ones.size(); ++i) {
      REQUIRE(beside.motion(others[i]).twist.linear == alone.motion(ones[i]).twist.linear);
      REQUIRE(beside.motion(others[i]).pose.position == alone.motion(ones[i]).pose.position);
    }
  }
}
