#include "support.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/physics/stage/recording.h>

#include <cmath>
#include <string>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double g = 9.81;

Stage actors_lecture(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/lectures";
  return Stage(Document::read(folder / (name + ".json")).stage());
}

Motion motion_of(const Stage& stage, const std::string& node) {
  return stage.world(stage.node(node)).motion;
}

}  // namespace

TEST_CASE("the car of the lectures, its wheels locked, slides on for v^2 / (2 mu g)") {
  Stage stage = actors_lecture("vehicle/brakes");
  stage.advance_to(1);
  const double v = stage.twist(stage.node("car")).linear.x(), from = motion_of(stage, "car").pose.position.x();
  CHECK(v > 19);
  stage.advance_to(5);
  CHECK(motion_of(stage, "car").pose.position.x() - from == doctest::Approx(v * v / (2 * 0.7 * g)).epsilon(0.005));
  CHECK(stage.twist(stage.node("car")).linear.norm() < 1e-3);
}

TEST_CASE("the car of the lectures climbs its ramp and stands there; the one whose rear wheels lock turns around") {
  Stage climbs = actors_lecture("vehicle/climbs");
  climbs.advance_to(6);
  const Motion top = motion_of(climbs, "car");
  climbs.advance_to(7);
  CHECK(top.pose.position.y() > 2);
  CHECK(near((top.pose.rotation * Vec3(1, 0, 0)).y(), std::sin(20 * pi / 180), 0.02));
  CHECK((motion_of(climbs, "car").pose.position - top.pose.position).norm() < 1e-2);
  Stage slides = actors_lecture("vehicle/slides");
  slides.advance_to(3);
  const Motion slid = motion_of(slides, "car");
  const Vec3 heading = slid.pose.rotation * Vec3(1, 0, 0);
  CHECK(heading.x() < 0.5);  // by more than a right angle minus 30 degrees
  CHECK(slid.pose.position.y() > 0.3);
}

TEST_CASE("of a rate of 50 t particle k leaves at sqrt(k) / 5 s and flies as it was thrown") {
  Stage stage = actors_lecture("particles/rising_rate");
  stage.advance_to(1);
  const StageParticles shown = stage.particles("sparks");
  REQUIRE(shown.positions.size() == 25);
  for (const std::size_t k : {std::size_t{0}, std::size_t{6}, std::size_t{24}}) {
    const double flown = 1 - std::sqrt(static_cast<double>(k + 1)) / 5;
    CHECK(near(shown.positions[k], Vec3(2 * flown, 2 - 0.5 * g * flown * flown, 0), 1e-8));
  }
}

TEST_CASE(
    "sparks on springs swing wider by explicit Euler, less by backward Euler, and as wide as ever by the others") {
  Stage stage = actors_lecture("particles/swings");
  const auto energy = [&](const std::string& kind) {
    const StageParticles sparks = stage.particles(kind);
    REQUIRE(sparks.positions.size() == 10);
    // The first one's, in units of m w^2 / 2; it let go at 0.1 s, a whole number of steps.
    return sparks.positions[0].x() * sparks.positions[0].x() + sparks.velocities[0].x() * sparks.velocities[0].x() / 16;
  };
  stage.advance_to(5.1);
  const double growth = std::pow(1 + 0.01, 200);
  CHECK(energy("explicit") == doctest::Approx(growth).epsilon(1e-9));
  CHECK(energy("backward") == doctest::Approx(1 / growth).epsilon(1e-9));
  CHECK(energy("implicit_trapezoid") == doctest::Approx(1).epsilon(1e-9));
  // A ripple: of h w / 2, and of (h w)^2 / 4.
  CHECK(energy("semi_implicit") == doctest::Approx(1).epsilon(0.06));
  CHECK(energy("verlet") == doctest::Approx(1).epsilon(0.003));
}

TEST_CASE("the fountain's water lies on no body's inside, and a recording of it has all that the stage has") {
  Stage stage = actors_lecture("particles/fountain");
  const Recording recording = record(stage, 3, 30);
  REQUIRE(recording.particles.size() == 1);
  REQUIRE(recording.particles[0].frame.size() == recording.times.size());
  const StageParticles& last = recording.particles[0].frame.back();
  CHECK(last.numbers.size() > 400);
  std::size_t inside = 0;
  for (const Vec3& place : last.positions)
    if (place.y() < 0.005 || (place - Vec3(0.9, 0.3, 0)).norm() < 0.305) ++inside;
  CHECK(inside == 0);
  stage.seek(1.234);
  const StageParticles before = stage.particles("water");
  stage.seek(2.5);
  stage.seek(1.234);
  CHECK(stage.particles("water").positions == before.positions);
}

TEST_CASE("ladders stand 2 percent steeper than they may lean, and slip 2 percent flatter") {
  // With length L, thickness 2 h and even mass, on ground of friction mu, at a smooth wall: moments about the
  // foot give N L sin a = W (L/2 cos a - h sin a), and N = mu W when it slips, so tan a = 1 / (2 (mu + h / L)). At a
  // wall as rough as the ground the wall holds mu N up: tan a = (1 - mu^2) / (2 (mu + h / L (1 + mu^2))).
  const double mu = 0.4, share = 0.02 / 4;
  const double smooth = 1 / (2 * (mu + share)), rough = (1 - mu * mu) / (2 * (mu + share * (1 + mu * mu)));
  Stage stage = actors_lecture("contacts/ladders");
  const auto steepness = [&](const std::string& node) {
    const Vec3 along = motion_of(stage, node).pose.rotation * Vec3(1, 0, 0);
    return along.y() / along.x();
  };
  CHECK(steepness("smooth stands") == doctest::Approx(1.02 * smooth).epsilon(1e-5));
  CHECK(steepness("smooth slips") == doctest::Approx(0.98 * smooth).epsilon(1e-5));
  CHECK(steepness("rough stands") == doctest::Approx(1.02 * rough).epsilon(1e-5));
  CHECK(steepness("rough slips") == doctest::Approx(0.98 * rough).epsilon(1e-5));
  stage.advance_to(2);
  CHECK(steepness("smooth stands") == doctest::Approx(1.02 * smooth).epsilon(1e-3));
  CHECK(steepness("rough stands") == doctest::Approx(1.02 * rough).epsilon(1e-3));
  CHECK(steepness("smooth slips") < 0.5);
  CHECK(steepness("rough slips") < 0.5);
}

TEST_CASE("an agent's inputs are recorded, and given again they lead to the same bits") {
  Stage played = actors_lecture("agents/hockey");
  // What an agent sees decides what it does: it strikes the puck whenever that is behind it.
  for (int step = 0; step < 480; ++step) {
    const Motion red = motion_of(played, "red");
    if (step % 60 == 0 && red.pose.position.x() < 1)
      played.apply_impulse(played.node("red"), Vec3(0.1 * (1 - red.pose.position.x()), 0, 0), red.pose.position);
    played.advance(1.0 / 240);
  }
  const std::vector<TimedInput> inputs = played.inputs();
  CHECK(inputs.size() >= 3);
  Stage again = actors_lecture("agents/hockey");
  CHECK(advance_with(again, inputs, played.time()).empty());
  CHECK(again.state_hash() == played.state_hash());
  CHECK(motion_of(again, "red").pose.position == motion_of(played, "red").pose.position);
  // Without them it stays where it was; with one it moves J / m t farther.
  Stage alone = actors_lecture("agents/hockey"), pushed = actors_lecture("agents/hockey");
  alone.advance_to(1.5);
  CHECK(near(motion_of(alone, "red").pose.position, Vec3(-2, 0.05, 0), 1e-5));
  const TimedInput one{0.5, input::Push{"red", Vec3(0.4, 0, 0), Vec3(-2, 0.05, 0)}};
  static_cast<void>(advance_with(pushed, std::span(&one, 1), 1.5));
  CHECK(near(motion_of(pushed, "red").pose.position.x(), -2 + 0.4 / 0.2 * 1, 1e-9));
}

TEST_CASE("a driver's inputs lead a car around a crate, to the same bits each time, and it stands at the end") {
  Stage first = actors_lecture("agents/driver"), second = actors_lecture("agents/driver");
  const std::filesystem::path file = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/inputs/driver.json";
  const std::vector<TimedInput> inputs = read_inputs(file, first.description());
  CHECK(advance_with(first, inputs, 7).empty());
  CHECK(advance_with(second, parse_inputs(inputs_json(inputs), "again", first.description()), 7).empty());
  CHECK(first.state_hash() == second.state_hash());
  CHECK(motion_of(first, "car").pose.position.x() > 17);
  CHECK(near(motion_of(first, "crate").pose.position, Vec3(14, 0.5, 0.9), 1e-3));
  CHECK(first.twist(first.node("car")).linear.norm() < 0.05);
}

TEST_CASE("a flag flies in its wind and hangs when that has died; the rope beside it lies on itself") {
  Stage stage = actors_lecture("soft/flag");
  const auto outer = [&] {
    const std::vector<Vec3> places = stage.soft("flag").positions;
    return places[places.size() - 7];  // the middle of its free side
  };
  stage.advance_to(3.5);
  const double flies = outer().head<1>()(0);
  CHECK(flies > 0.6);
  const std::vector<Vec3> line = stage.soft("line").positions;
  double nearest = 1;
  for (std::size_t i = 0; i < line.size(); ++i)
    for (std::size_t k = i + 2; k < line.size(); ++k) nearest = std::min(nearest, (line[i] - line[k]).norm());
  CHECK(nearest > 0.02);
  stage.advance_to(6);
  CHECK(outer().x() < 0.4);
}

TEST_CASE("springs in a plane swing about where the weight holds them, settle there, or hardly give way") {
  Stage stage = actors_lecture("plane/springs");
  const double sag = 2 * g / 80, w = std::sqrt(80 / 2.0);
  stage.advance_to(pi / w);
  CHECK(near(motion_of(stage, "swinging").pose.position.y(), 1 - 2 * sag, 0.02 * sag));
  const double settled = 1 - (1 + pi) * std::exp(-pi);
  CHECK(near(motion_of(stage, "damped").pose.position.y(), 1 - sag * settled, 0.01 * sag));
  stage.advance_to(3);
  CHECK(near(motion_of(stage, "damped").pose.position.y(), 1 - sag, 1e-6));
  CHECK(near(motion_of(stage, "stiff").pose.position.y(), 1, 1e-6));
}

TEST_CASE("in a plane balls that resist rolling stop after v^2 / 2a, and stay on a ramp of less than c / r") {
  Stage stage = actors_lecture("plane/rolling");
  const auto speed = [&](const char* node) { return stage.twist(stage.node(node)).linear.norm(); };
  // 7/5 m a = c m g / r on level ground; on the ramp of 1 in 10 the pull is g (sin - c / r cos).
  const double slows = 5 * g * 0.01 / (7 * 0.25), slides = 5 * g * (0.1 - 0.01 / 0.25) / (7 * std::sqrt(1.01));
  stage.advance_to(1);
  CHECK(near(speed("free"), 1, 1e-6));
  CHECK(near(speed("slowed"), 1 - slows, 1e-6));
  CHECK(near(speed("stopped"), 1 - 2 * slows, 1e-6));
  CHECK(near(speed("leaving"), slides, 2e-2 * slides));
  stage.advance_to(3);
  CHECK(near(motion_of(stage, "stopped").pose.position.x(), 1 / (4 * slows), 0.01));
  CHECK(speed("stopped") < 1e-6);
  CHECK(std::abs(motion_of(stage, "held").pose.position.x() + 3.0248759297552505) < 1e-3);
}

TEST_CASE("in a plane a pinion turns a wheel back by its teeth, and two on a rope move as Atwood's do") {
  Stage stage = actors_lecture("plane/gears");
  // Balls of 2/5 m r^2; the pinion feels the wheel by the square of the ratio.
  const double moment = 0.4 * (1 * 0.09 + 0.25 * 4 * 0.36), fall = g / 5;
  const auto spin = [&](const char* node) { return stage.twist(stage.node(node)).angular.z(); };
  stage.advance_to(0.2);
  CHECK(near(spin("pinion"), 2 / moment * 0.2, 1e-6));
  stage.advance_to(1);
  CHECK(near(spin("pinion"), pi, 1e-6));
  CHECK(near(spin("wheel"), -pi / 2, 1e-6));
  CHECK(near(stage.joint("teeth")->position[1], -0.5 * stage.joint("teeth")->position[0], 1e-4));
  CHECK(near(stage.twist(stage.node("heavy")).linear, Vec3(0, -fall, 0), 1e-6));
  CHECK(near(stage.twist(stage.node("light")).linear, Vec3(0, fall, 0), 1e-6));
  CHECK(near(stage.joint("rope")->force, Vec3(0, 3 * (g - fall), 0), 1e-3));
}

TEST_CASE("in a plane a table stands over a rolling ball, and a hammer flies about its own center of mass") {
  Stage stage = actors_lecture("plane/compound");
  stage.advance_to(0.5);
  const Motion hammer = motion_of(stage, "hammer");
  CHECK(near(hammer.pose.position + hammer.pose.rotation * Vec3(0, 0.32, 0), Vec3(-2.5, 0.82 + 2.5 - g / 8, 0), 1e-9));
  CHECK(near(hammer.twist.angular, Vec3(0, 0, -400 * pi / 180), 1e-9));
  stage.advance_to(3);
  CHECK(near(motion_of(stage, "table").pose.position.y(), 0, 2e-3));
  CHECK(near(motion_of(stage, "ball").pose.position.y(), 0.2, 2e-3));
  CHECK(std::abs(motion_of(stage, "ball").pose.position.x() - motion_of(stage, "table").pose.position.x()) < 0.71);
  CHECK(near(motion_of(stage, "lamp").pose.position.y(), 1.1, 5e-3));
}

TEST_CASE("in a plane a car on wheels goes as fast as its motors turn, over a bump, and rests on its springs") {
  Stage stage = actors_lecture("plane/car");
  stage.advance_to(4);
  CHECK(near(stage.twist(stage.node("chassis")).linear.x(), 0.6 * pi, 1e-2));
  CHECK(motion_of(stage, "back").pose.position.x() > 2.5);
  CHECK(near(motion_of(stage, "back").pose.position.y(), 0.3, 2e-3));
  for (const char* const axle : {"back axle", "front axle"}) {
    CHECK(stage.joint(axle)->gap < 1e-3);
    CHECK(near(stage.joint(axle)->rate[0], -2 * pi, 1e-2));
  }
}

TEST_CASE("in a plane ropes hang as a catenary, bear what is two thousand times as heavy, and stay where they fall") {
  Stage stage = actors_lecture("plane/rope");
  stage.advance_to(3);
  // a (cosh(1 / 2a) - 1), where 2 a sinh(1 / 2a) = 1.3
  double low = 0.1, high = 10;
  for (int n = 0; n < 100; ++n) {
    const double a = 0.5 * (low + high);
    (2 * a * std::sinh(0.5 / a) > 1.3 ? low : high) = a;
  }
  CHECK(near(1.6 - stage.soft("line").positions[20].y(), low * (std::cosh(0.5 / low) - 1), 1e-3));
  // The lamp swings on a cord that does not yield.
  CHECK(near((motion_of(stage, "lamp").pose.position - Vec3(0, 1.6, 0)).norm(), std::sqrt(1.16), 1e-5));
  double highest = -10;
  for (const Vec3& place : stage.soft("thrown").positions) {
    CHECK(place.z() == 0);
    highest = std::max(highest, place.y());
  }
  CHECK(near(highest, 0.96, 5e-3));
}

TEST_CASE("a machine in a plane: its mill turns as its motor says, its rod and weld hold, and nothing leaves it") {
  Stage stage = actors_lecture("plane/machine");
  for (int frame = 1; frame <= 30; ++frame) {
    stage.advance_to(0.1 * frame);
    CHECK((motion_of(stage, "bob").pose.position - Vec3(-0.5, 2, 0)).norm() == doctest::Approx(1).epsilon(3e-3));
    const Quat between = motion_of(stage, "handle").pose.rotation.conjugate() * motion_of(stage, "head").pose.rotation;
    CHECK(std::abs(between.z()) < 0.02);
    for (const std::string name : {"sail", "bob", "handle", "head", "buoy", "lift", "load"})
      CHECK(motion_of(stage, name).pose.position.z() == 0);
  }
  CHECK(near(stage.twist(stage.node("sail")).angular, Vec3(0, 0, pi), 1e-3));
  CHECK(stage.joint("tether").has_value());
  CHECK(stage.joint("eye")->position[0] < 20.5 * pi / 180);
  // A spring of 1.5 Hz for the elevator's 2 kg, under 5 kg.
  const double droop = 5 * 9.81 / (2 * (3 * pi) * (3 * pi));
  CHECK(stage.joint("shaft")->position[0] == doctest::Approx(1.2 - droop).epsilon(2e-2));
  CHECK(stage.joint("shaft")->torque.z() != 0);
  const Vec3 rod = stage.joint("rod")->force;
  const std::vector<std::byte> saved = stage.save();
  Stage loaded = actors_lecture("plane/machine");
  loaded.load(saved);
  CHECK(loaded.joint("rod")->force == rod);
  for (Stage* const one : {&stage, &loaded}) one->advance_to(3.5);
  CHECK(stage.state_hash() == loaded.state_hash());
}

TEST_CASE("a net holds what is smaller than its cells between its nodes, and a rope on them") {
  Stage stage = actors_lecture("soft/net");
  stage.advance_to(3);
  for (const std::string name : {"ball", "marble", "rod"}) {
    CAPTURE(name);
    CHECK(motion_of(stage, name).pose.position.y() > 0.6);
  }
  for (const Vec3& node : stage.soft("line").positions) CHECK(node.y() > 0.6);
}
