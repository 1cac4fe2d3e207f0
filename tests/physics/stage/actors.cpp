#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/recording.h>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double g = 9.81;

/// 1000 kg on four wheels at 20 m/s, braked fully from `brake_at` on.
StageDescription braking_car(double grip, double brake_at) {
  StageDescription stage;
  stage.nodes.push_back({.name = "road", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  BodyDescription body{.shape = {Box{Vec3(1.6, 0.1, 0.7)}}, .mass = 1000.0};
  body.twist.linear = Vec3(20, 0, 0);
  // At the height at which the springs carry it: 1000 kg on four of 30,000 N/m
  stage.nodes.push_back({.name = "car", .rest = {.position = Vec3(0, 0.6 - 1000 * g / 120000, 0)}, .body = body});
  VehicleDescription car{.name = "car", .chassis = 1};
  for (const double x : {1.3, -1.3})
    for (const double z : {-0.7, 0.7})
      car.wheels.push_back({.name = (x > 0 ? std::string("front") : "rear") + (z > 0 ? " right" : " left"),
                            .wheel = {.mount = Vec3(x, 0, z), .grip = grip, .side_grip = grip},
                            .brake = 20'000,
                            .lock = 0.5});
  car.brake = Strength(
      keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::hold()}, {.time = brake_at, .value = 1.0}}));
  stage.vehicles.push_back(std::move(car));
  return stage;
}

/// A jet on an arm that turns about the origin, above the ground.
StageDescription jet() {
  StageDescription stage;
  stage.nodes.push_back({.name = "ground", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  stage.nodes.push_back({.name = "hub", .rest = {.position = Vec3(0, 1, 0)}});
  stage.nodes.push_back({.name = "nozzle", .parent = 1, .rest = {.position = Vec3(0.5, 0, 0)}});
  Clip clip{.name = "turn", .duration = 2};
  clip.tracks.push_back({"hub", "rotation",
                         keyed_curve<Quat>({{.time = 0, .value = Quat(1, 0, 0, 0), .ease = Ease::linear()},
                                            {.time = 1, .value = exp_map(Vec3(0, 2, 0)), .ease = Ease::linear()},
                                            {.time = 2, .value = exp_map(Vec3(0, 4, 0))}})});
  stage.clips.push_back(std::move(clip));
  stage.plays.push_back({.clip = 0});
  ParticlesDescription spray{.name = "spray", .settings = {.restitution = 0.4, .life = 1.5, .life_spread = 0.5}};
  spray.emitters.push_back({.node = 2,
                            .direction = Vec3(1, 0, 0),
                            .rate = expression_curve(Expression("100*t")),
                            .speed = Curve<double>(3.0),
                            .spread = 0.2});
  stage.particles.push_back(std::move(spray));
  return stage;
}

bool same(const StageParticles& a, const StageParticles& b) {
  return a.numbers == b.numbers && a.positions == b.positions && a.velocities == b.velocities;
}

bool same(const std::vector<StageWheel>& a, const std::vector<StageWheel>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const StageWheel& one, const StageWheel& other) {
    return one.pose.position == other.pose.position && one.pose.rotation.coeffs() == other.pose.rotation.coeffs() &&
           one.reading.spin == other.reading.spin && one.reading.slip == other.reading.slip;
  });
}

}  // namespace

TEST_CASE("a car on a stage, its wheels locked, stops after v^2 / (2 mu g)") {
  for (const double grip : {0.4, 0.8}) {
    Stage stage(braking_car(grip, 0.5));
    stage.advance_to(0.5);
    const double v = stage.twist(1).linear.x(), from = stage.world(1).motion.pose.position.x();
    // The wheels had to be set turning first: m v + I v / r^2 = m v0
    CHECK(v == doctest::Approx(20 * 1000 / (1000 + 4 / 0.09)).epsilon(1e-4));
    stage.advance_to(0.5 + v / (grip * g) + 1);
    // Half a percent: the tire's grip takes a few hundredths of a second to build up, and the body dives.
    CHECK(stage.world(1).motion.pose.position.x() - from == doctest::Approx(v * v / (2 * grip * g)).epsilon(0.005));
    CHECK(stage.twist(1).linear.norm() < 1e-3);
  }
}

TEST_CASE("wheels hang under the chassis, and roll by as much as the car goes") {
  Stage stage(braking_car(1, 1e9));
  stage.advance_to(1);
  const double angle = stage.vehicle("car")[0].reading.angle, x = stage.world(1).motion.pose.position.x();
  stage.advance_to(1.5);
  const std::vector<StageWheel> wheels = stage.vehicle("car");
  REQUIRE(wheels.size() == 4);
  const double gone = stage.world(1).motion.pose.position.x() - x;
  CHECK(wheels[0].reading.angle - angle == doctest::Approx(gone / 0.3).epsilon(1e-3));
  const Vec3 hub = wheels[0].pose.position - stage.world(1).motion.pose.position;
  CHECK(near(hub, Vec3(1.3, -(0.3 - 1000 * g / 120000), -0.7), 2e-3));
  // Its y is the axle, to the left
  CHECK(near(wheels[0].pose.rotation * Vec3(0, 1, 0), Vec3(0, 0, -1), 2e-2));
  CHECK_THROWS_WITH_AS(static_cast<void>(stage.vehicle("cra")), doctest::Contains("did you mean \"car\"?"),
                       std::invalid_argument);
}

TEST_CASE("particles leave a nozzle that turns when the rate says, and fly as they were thrown") {
  StageDescription described = jet();
  described.particles[0].settings.life_spread = 0;
  described.particles[0].emitters[0].spread = 0;
  described.particles[0].collide = false;
  Stage stage(described);
  stage.advance_to(1.0);
  const StageParticles shown = stage.particles("spray");
  // The integral of 100 t is 50 t^2
  REQUIRE(shown.numbers.size() == 50);
  for (const std::size_t k : {std::size_t{0}, std::size_t{17}, std::size_t{49}}) {
    const double left = std::sqrt(static_cast<double>(k + 1) / 50), flown = 1 - left;
    const Vec3 out(std::cos(2 * left), 0, -std::sin(2 * left)), side(out.z(), 0, -out.x());
    const Vec3 velocity = 3 * out + 2 * 0.5 * Vec3(-std::sin(2 * left), 0, -std::cos(2 * left));
    const Vec3 place = Vec3(0, 1, 0) + 0.5 * out + flown * velocity - Vec3(0, 0.5 * g * flown * flown, 0);
    CHECK(near(shown.positions[k], place, 1e-6));
    CHECK(near(shown.velocities[k], Vec3(velocity - Vec3(0, g * flown, 0)), 1e-6));
  }
}

TEST_CASE("vehicles and particles go back and on, saved too, to the same bits") {
  StageDescription described = jet();
  for (StageDescription car = braking_car(0.8, 0.2); NodeDescription & node : car.nodes) {
    if (node.name == "road") continue;
    described.nodes.push_back(node);
    described.vehicles = car.vehicles;
  }
  described.vehicles[0].chassis = described.nodes.size() - 1;
  described.vehicles[0].steer = Strength::formula("0.3*sin(3*t)");
  Stage stage(described);
  stage.advance_to(0.7371);
  const StageParticles particles = stage.particles("spray");
  const std::vector<StageWheel> wheels = stage.vehicle("car");
  const std::vector<std::byte> saved = stage.save();
  stage.advance_to(1.6);
  const StageParticles later = stage.particles("spray");
  const std::vector<StageWheel> later_wheels = stage.vehicle("car");
  CHECK(later.numbers.size() > 50);
  stage.seek(0.7371);
  CHECK(same(stage.particles("spray"), particles));
  CHECK(same(stage.vehicle("car"), wheels));
  stage.seek(1.6);
  CHECK(same(stage.particles("spray"), later));
  CHECK(same(stage.vehicle("car"), later_wheels));
  Stage other(described);
  other.load(saved);
  CHECK(same(other.particles("spray"), particles));
  CHECK(same(other.vehicle("car"), wheels));
  other.advance_to(1.6);
  CHECK(same(other.particles("spray"), later));
  CHECK(same(other.vehicle("car"), later_wheels));
  described.particles[0].emitters[0].speed = Curve<double>(3.1);
  CHECK_THROWS_WITH_AS(Stage(described).load(saved), doctest::Contains("another description"), std::invalid_argument);
}

TEST_CASE("a description of vehicles or particles that cannot be is refused with its reason") {
  const auto fault_of = [](const auto& change) {
    StageDescription described = jet();
    described.vehicles = braking_car(1, 1).vehicles;
    described.vehicles[0].chassis = 0;
    described.nodes[0].body->fixed = false;
    described.nodes[0].body->shape = {Box{Vec3(1, 1, 1)}};
    change(described);
    const StageInspection found = inspect(described);
    return found.faults.empty() ? std::string() : found.faults[0].message;
  };
  CHECK(fault_of([](StageDescription&) {}).empty());
  CHECK(fault_of([](StageDescription& d) { d.vehicles[0].chassis = 1; }) ==
        "the vehicle \"car\": its chassis must be a node with a body");
  CHECK(fault_of([](StageDescription& d) { d.vehicles[0].wheels[1].name = "front left"; }) ==
        "the vehicle \"car\": two of its wheels are called \"front left\"");
  CHECK(fault_of([](StageDescription& d) { d.vehicles[0].wheels[1].wheel.radius = std::nan(""); }).find("radius") !=
        std::string::npos);
  CHECK(fault_of([](StageDescription& d) { d.vehicles.push_back(d.vehicles[0]); }).find("has this name") !=
        std::string::npos);
  CHECK(fault_of([](StageDescription& d) { d.particles[0].emitters[0].rate = Curve<double>(-1.0); }) ==
        "the particles \"spray\": its emitter 0: the rate of an emitter must never be negative");
  CHECK(fault_of([](StageDescription& d) { d.particles[0].emitters[0].direction = Vec3(0, 0, 0); }).find("unit") !=
        std::string::npos);
  CHECK(fault_of([](StageDescription& d) { d.particles[0].settings.mass = 0; }).find("mass") != std::string::npos);
}
