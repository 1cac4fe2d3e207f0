#include "physics/scene.h"
#include "processor_time.h"

using namespace tweenfall;

namespace {

constexpr double huge = 1.7976931348623157e308;
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("a world that was moved from answers as empty or throws, and takes another world") {
  World world;
  const BodyId body = world.add({});
  World other = std::move(world);
  CHECK(!world.contains(body));
  CHECK(world.time() == 0);
  CHECK(world.contacts().empty());
  CHECK(world.state_hash() == 0);
  CHECK_THROWS_AS(world.step(0.1), std::logic_error);
  CHECK_THROWS_AS(world.add({}), std::logic_error);
  CHECK_THROWS_AS((void)world.motion(body), std::logic_error);
  CHECK_THROWS_AS((void)world.bodies(), std::logic_error);
  CHECK_THROWS_AS((void)world.kinetic_energy(), std::logic_error);
  World copy = world;
  CHECK_THROWS_AS(copy.step(0.1), std::logic_error);
  world = other;
  world.step(0.1);
  CHECK(world.contains(body));
  world = copy;
  CHECK(!world.contains(body));
}

TEST_CASE("a field that changes its world is refused, one that throws leaves every body where it was") {
  World world;
  const BodyId body = world.add({});
  enum class Deed { add, remove, move, step, assign, fail, none } deed = Deed::add;
  World spare = world;
  world.add_force(Field([&](double, const Vec3&, const Vec3&, double) -> Vec3 {
    if (deed == Deed::add)
      for (int i = 0; i < 100; ++i) world.add({});
    if (deed == Deed::remove) world.remove(body);
    if (deed == Deed::move) world.set_motion(body, {});
    if (deed == Deed::step) world.step(0.1);
    if (deed == Deed::assign) world = spare;
    if (deed == Deed::fail) throw std::runtime_error("no wind today");
    const World copy = world;  // reading is fine
    return Vec3(copy.mass(body).mass * 2, 0, 0);
  }));
  const std::uint64_t before = world.state_hash();
  for (const Deed wrong : {Deed::add, Deed::remove, Deed::move, Deed::step, Deed::assign}) {
    deed = wrong;
    CHECK_THROWS_AS(world.step(0.5), std::logic_error);
    CHECK(world.state_hash() == before);
  }
  deed = Deed::fail;
  CHECK_THROWS_WITH(world.step(0.5), "no wind today");
  CHECK(world.state_hash() == before);
  deed = Deed::none;
  world.step(0.5);
  CHECK(world.twist(body).linear.x() == doctest::Approx(1));
}

TEST_CASE("a body that stops being finite is named with its time and the likely cause, until it is mended") {
  World world;
  world.add({});
  BodySettings settings;
  settings.motion.pose.position = Vec3(5, 0, 0);
  const BodyId body = world.add(settings);
  world.step(0.25);
  double wind = not_a_number;
  const std::size_t force = world.add_force(
      Field([&](double, const Vec3& at, const Vec3&, double) { return Vec3(0, 0, at.x() > 4 ? wind : 0); }));
  const Vec3 before = world.motion(body).pose.position;
  for (const double bad : {not_a_number, huge, -huge, std::numeric_limits<double>::infinity()}) {
    wind = bad;
    try {
      world.step(0.25);
      CHECK(false);
    } catch (const NotFinite& error) {
      CHECK(error.body == body);
      CHECK(error.time == 0.5);
      CHECK(error.cause.find("field") != std::string::npos);
    }
    CHECK(world.motion(body).pose.position == before);
  }
  wind = 0;
  world.step(0.25);
  world.remove_force(force);
  world.set_motion(body, {.twist = {Vec3(1e30, 0, 0), Vec3::Zero()}});
  CHECK_THROWS_AS(world.step(10), NotFinite);
  CHECK_THROWS_AS(world.step(10), NotFinite);
  world.set_motion(body, {});
  world.step(0.25);
}

TEST_CASE("numbers that are not finite or huge, and quaternions of zero, are refused by every call") {
  World world;
  const BodyId body = world.add({});
  BodySettings keyed;
  keyed.drive = Drive::keyed();
  keyed.motion.pose.position = Vec3(9, 0, 0);
  const BodyId led = world.add(keyed);
  const std::uint64_t before = world.state_hash();
  for (const double bad : {not_a_number, huge, -huge, 1e31, std::numeric_limits<double>::infinity()}) {
    const Vec3 wrong(0, bad, 0);
    Motion place, velocity, spin;
    place.pose.position = wrong;
    velocity.twist.linear = wrong;
    spin.twist.angular = wrong;
    for (const Motion& motion : {place, velocity, spin}) {
      CHECK_THROWS_AS(world.set_motion(body, motion), std::invalid_argument);
      CHECK_THROWS_AS(world.set_target(led, motion), std::invalid_argument);
      CHECK_THROWS_AS(world.add({.motion = motion}), std::invalid_argument);
    }
    CHECK_THROWS_AS(world.apply_force(body, wrong, Vec3::Zero()), std::invalid_argument);
    CHECK_THROWS_AS(world.apply_force(body, Vec3::Zero(), wrong), std::invalid_argument);
    CHECK_THROWS_AS(world.apply_torque(body, wrong), std::invalid_argument);
    CHECK_THROWS_AS(world.apply_impulse(body, wrong, Vec3::Zero()), std::invalid_argument);
    CHECK_THROWS_AS(world.add_force(Spring{.a = body, .anchor_a = wrong}), std::invalid_argument);
    CHECK_THROWS_AS(world.add_force(Spring{.a = body, .rest_length = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add_force(Spring{.a = body, .stiffness = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add_force(Spring{.a = body, .damping = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add_force(Drag{.linear = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add({.mass = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add({.shape = {Sphere{bad}}}), std::invalid_argument);
    CHECK_THROWS_AS(world.add({.friction = bad}), std::invalid_argument);
    CHECK_THROWS_AS(world.add({.linear_damping = bad}), std::invalid_argument);
  }
  CHECK_THROWS_AS(world.add_force(Field{}), std::invalid_argument);
  for (const Quat& turn :
       {Quat(0, 0, 0, 0), Quat(not_a_number, 0, 0, 0), Quat(huge, huge, 0, 0), Quat(1e-200, 0, 0, 0)}) {
    Motion motion;
    motion.pose.rotation = turn;
    CHECK_THROWS_AS(world.set_motion(body, motion), std::invalid_argument);
    CHECK_THROWS_AS(world.set_target(led, motion), std::invalid_argument);
    CHECK_THROWS_AS(world.add({.motion = motion}), std::invalid_argument);
  }
  CHECK(world.state_hash() == before);
}

TEST_CASE("poses that are no numbers touch nothing and read nothing that is not there") {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i & 2, i & 4);
  const Solid solids[] = {Sphere{0.5}, Box{}, Capsule{}, Capsule{0.1, 0}, Plane{}, Hull{ConvexHull(corners)}};
  const double wrong[] = {not_a_number, huge, -huge, std::numeric_limits<double>::infinity(), 1e200, 1e154};
  for (const Solid& a : solids)
    for (const Solid& b : solids)
      for (const double bad : wrong)
        for (int where = 0; where < 7; ++where)
          for (const double margin : {0.0, 0.01, std::numeric_limits<double>::infinity()}) {
            Pose pose;
            if (where < 3)
              pose.position[where] = bad;
            else
              pose.rotation.coeffs()[where - 3] = bad;
            CHECK(collide({a}, pose, {b}, {}, margin).count <= 4);
            CHECK(collide({a}, {}, {b}, pose, margin).count <= 4);
            CHECK(collide({a}, pose, {b}, pose, margin).count <= 4);
          }
}

TEST_CASE("a body that turns by millions of degrees per second stays finite") {
  for (const double spin : {1e4, 1.7e5, 1e7, 1e9, 1e15}) {
    World world({.gravity = Vec3::Zero()});
    BodySettings box;
    box.shape.solid = Box{Vec3(0.1, 0.05, 0.15)};
    box.motion.twist.angular = Vec3(spin, spin, spin);
    const BodyId body = world.add(box);
    const double energy = world.kinetic_energy();
    for (int i = 0; i < 500; ++i) world.step(1.0 / 60);
    CHECK(world.motion(body).twist.angular.allFinite());
    CHECK(world.kinetic_energy() < 10 * energy);
  }
}

TEST_CASE("thousands of bodies at one point step without end of time or memory, and part") {
  World world({.gravity = Vec3::Zero()});
  std::vector<BodyId> bodies;
  for (int i = 0; i < 3000; ++i) {
    BodySettings body;
    if (i % 3 == 1) body.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
    if (i % 3 == 2) body.shape.solid = Capsule{0.3, 0.2};
    bodies.push_back(world.add(body));
  }
  for (int i = 0; i < 2; ++i) world.step(1.0 / 60);
  for (const BodyId body : bodies) CHECK(world.motion(body).pose.position.norm() < 10);
}

TEST_CASE("a capsule larger than any world lies in a crowd, and thirty steps end") {
  World world;
  world.add({.shape = {Plane{}}, .fixed = true});
  std::vector<BodyId> bodies;
  for (int i = 0; i < 24; ++i) {
    BodySettings body{.mass = 1, .restitution = 0.3};
    body.motion.pose.position = Vec3(0.9 * (i % 5) - 2, 0.4 + 0.25 * i, 0.7 * (i % 4) - 1);
    if (i % 3 == 1) body.shape.solid = Box{Vec3(0.2, 0.15, 0.25)};
    if (i % 3 == 2) body.shape.solid = Capsule{i == 5 ? 1e17 : 0.15, 0.3};
    bodies.push_back(world.add(body));
  }
  const double begin = test::processor_seconds();
  for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
  CHECK(test::processor_seconds() - begin < 3);
  for (const BodyId body : bodies) CHECK(world.motion(body).pose.position.allFinite());
}

TEST_CASE("worlds of any size and steps of any length stay finite") {
  // Every size with every length, and each of them with either restitution, but not all combinations of three.
  int turn = 0;
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double dt : {1e-12, 1e-4, 1.0 / 60, 0.5, 10.0})
      for (const double restitution : {turn++ % 2 == 0 ? 0.3 : 1.0}) {
        CAPTURE(size);
        CAPTURE(dt);
        CAPTURE(restitution);
        World world({.gravity = Vec3(0, -9.81 * size, 0)});
        world.add({.shape = {Plane{}}, .fixed = true});
        std::vector<BodyId> bodies;
        for (int i = 0; i < 12; ++i) {
          BodySettings body;
          body.restitution = std::min(1.0, restitution * (i % 4));
          body.shape.solid = i % 3 == 0   ? Solid(Sphere{0.4 * size})
                             : i % 3 == 1 ? Solid(Box{Vec3(0.4, 0.3, 0.2) * size})
                                          : Solid(Capsule{0.2 * size, 0.3 * size});
          body.motion.pose.position = Vec3(0.3 * (i % 2), 0.6 + 0.7 * i, 0.1 * (i % 3)) * size;
          body.motion.twist.angular = Vec3(i, 2, -i);
          bodies.push_back(world.add(body));
        }
        for (int i = 0; i < 20; ++i) world.step(dt);
        // Steps as long as these come from a fall of a thousand seconds.
        double fastest = 0;
        for (const BodyId body : bodies) fastest = std::max(fastest, world.twist(body).linear.norm());
        CHECK(fastest < (20 + 1e4 * dt) * size);
      }
}

TEST_CASE("what turns by many radians in a step, and touches, stays finite and gets no faster") {
  test::Random random(11);
  for (const double dt : {0.5, 2.0, 10.0})
    for (const double spin : {1.0, 30.0, 1e3, 1e6}) {
      CAPTURE(dt);
      CAPTURE(spin);
      World world({.gravity = Vec3::Zero()});
      for (int i = 0; i < 8; ++i) {
        BodySettings body;
        body.restitution = 0.5 * (i % 3);
        if (i % 2 == 0)
          body.shape.solid = Box{Vec3(0.4, 0.05, 0.2)};
        else
          body.shape.solid = Capsule{0.1, 0.5};
        body.mass = 1 + i;
        body.motion.pose.position = 0.4 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        body.motion.twist.angular = spin * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        world.add(body);
      }
      const double energy = world.kinetic_energy();
      for (int i = 0; i < 200; ++i) world.step(dt);
      CHECK(world.kinetic_energy() < 2 * energy + 100);
    }
}

TEST_CASE("contacts of bodies at one point grow with their number and not with its square, and all stay finite") {
  for (const int count : {100, 400}) {
    CAPTURE(count);
    World world;
    std::vector<BodyId> bodies;
    bodies.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      BodySettings body;
      if (i % 2 == 0)
        body.shape.solid = Sphere{0.1};
      else
        body.shape.solid = Box{Vec3(0.1, 0.1, 0.1)};
      body.mass = 1.0;
      bodies.push_back(world.add(body));
    }
    for (int step = 0; step < 4; ++step) {
      world.step(1.0 / 240);
      CHECK(world.contacts().size() > static_cast<std::size_t>(count));
      CHECK(world.contacts().size() <= 32 * static_cast<std::size_t>(count));
    }
    for (const BodyId body : bodies) CHECK(world.motion(body).pose.position.norm() < 1);
  }
}

TEST_CASE("a world that would pass over its contacts for ever is refused") {
  for (const int iterations : {std::numeric_limits<int>::min(), 0, 10'001, std::numeric_limits<int>::max()})
    CHECK_THROWS_AS(World({.iterations = iterations}), std::invalid_argument);
}

TEST_CASE("shapes whose reach no number holds are refused, and are not taken for planes") {
  World world;
  for (const Solid& solid : {Solid(Box{Vec3(1e200, 1, 1)}), Solid(Box{Vec3(1e300, 1e300, 1e300)}), Solid(Sphere{1e31}),
                             Solid(Capsule{1e308, 1e308})})
    for (const bool fixed : {false, true})
      CHECK_THROWS_AS(world.add({.shape = {solid}, .mass = 1, .fixed = fixed}), std::invalid_argument);
  world.add({.shape = {Sphere{}}});
  world.step(0.01);
}
