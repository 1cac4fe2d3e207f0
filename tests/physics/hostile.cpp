#include "scene.h"

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
