#include "support.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/stage.h>

#include <cmath>
#include <set>
#include <string>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const std::filesystem::path lectures = std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents/lectures";

Stage lecture(const std::string& name) {
  return Stage(Document::read(lectures / (name + ".json")).stage());
}

Vec3 place_of(const Stage& stage, const std::string& node) {
  return stage.world(stage.node(node)).motion.pose.position;
}

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(lectures / folder))
    names.insert(entry.path().stem().string());
  return names;
}

}  // namespace

TEST_CASE("every word of a world's strategies has a document") {
  CHECK(names_in("integrators") == std::set<std::string>{"backward_euler", "exact_quadratic", "explicit_euler",
                                                         "implicit_trapezoid", "midpoint", "rk4", "semi_implicit_euler",
                                                         "trapezoid", "verlet"});
  CHECK(names_in("separation") == std::set<std::string>{"by_mass", "closest_point", "half", "positional_impulse"});
  CHECK(names_in("collision") == std::set<std::string>{"ahead", "discrete", "own", "time_of_impact"});
  CHECK(names_in("stacking") == std::set<std::string>{"iterative", "lcp", "sequential", "shock"});
  CHECK(names_in("soft") == std::set<std::string>{"cloth_positions", "cloth_springs", "flag", "net", "rope_positions",
                                                  "rope_springs", "tearing", "volume_positions", "volume_springs"});
  CHECK(names_in("broad_phase") ==
        std::set<std::string>{"all_pairs", "bvh", "grid", "kd_tree", "octree", "quadtree", "sweep"});
  CHECK(names_in("forces") ==
        std::set<std::string>{"attractor", "buoyancy", "damper", "drag", "field", "torque", "vortex", "wind"});
  CHECK(names_in("mass") == std::set<std::string>{"rolling", "self_righting"});
  CHECK(names_in("contacts") == std::set<std::string>{"ladders", "slopes"});
  CHECK(names_in("vehicle") == std::set<std::string>{"brakes", "climbs", "slides"});
  CHECK(names_in("particles") == std::set<std::string>{"fountain", "rising_rate", "swings"});
  CHECK(names_in("plane") ==
        std::set<std::string>{"car", "compound", "gears", "machine", "rolling", "rope", "space", "springs", "xy"});
}

TEST_CASE("the lecture's projectile flies as its table says, and by explicit Euler as its numerical one goes on") {
  Stage thrown = lecture("analytical/projectile");
  const double analytical[] = {3.5, 6, 7.5, 8, 7.5, 6, 3.5, 0}, numerical[] = {4, 7, 9, 10, 10, 9, 7, 4};
  for (int t = 1; t <= 8; ++t) {
    thrown.advance_to(t);
    CHECK(near(place_of(thrown, "analytical"), Vec3(3.0 * t, analytical[t - 1], 0), 1e-13));
    CHECK(near(place_of(thrown, "numerical"), Vec3(3.0 * t, numerical[t - 1], 0), 1e-13));
  }
}

TEST_CASE("each force of a document does what its closed form says") {
  Stage drag = lecture("forces/drag");
  drag.advance_to(1.5);
  // v0 m / c (1 - exp(-c t / m))
  CHECK(near(place_of(drag, "linear").x(), 12 / 0.4 * (1 - std::exp(-0.6)), 1e-7));
  Stage water = lecture("forces/buoyancy");
  water.advance_to(12);
  // 0.6 of 0.4 m submerged; half a ball; the tower lies, with 0.6 of its 0.4 m submerged as well.
  CHECK(near(place_of(water, "raft").y(), -0.04, 5e-3));
  CHECK(near(place_of(water, "ball").y(), 0, 5e-3));
  CHECK(std::abs((water.world(water.node("tower")).motion.pose.rotation * Vec3(0, 1, 0)).y()) < 0.3);
  CHECK(place_of(water, "stone").y() < -2.8);
  Stage planets = lecture("forces/attractor");
  planets.advance_to(1);
  CHECK(near(place_of(planets, "round"), Vec3(1, 0, 0), 0.02));
  Stage torque = lecture("forces/torque");
  torque.advance_to(1);
  CHECK(near(place_of(torque, "moved"), Vec3(0, 2.5, 0), 1e-9));
  // r x f / I = 1 / (1.01 / 12)
  CHECK(near(torque.twist(torque.node("both")).angular.z(), 12 / 1.01, 1e-6));
  CHECK(near(torque.twist(torque.node("turned")).angular.z(), 24 / 1.01, 1e-6));
  CHECK(near(place_of(torque, "turned"), Vec3(0, -1.5, 0), 1e-9));
  CHECK(place_of(torque, "still") == Vec3(0, -3, 0));
  Stage field = lecture("forces/field");
  field.advance_to(pi / 4);  // half a turn on a circle of radius 1/2 m
  CHECK(near(place_of(field, "charge") - Vec3(0, 2, 0), Vec3(0, 0, 1), 1e-2));
}

TEST_CASE("in a plane a ball that is let go flies as the closed form says, and nothing leaves the plane by a bit") {
  Stage stage = lecture("plane/xy");
  stage.advance(0.7);
  const Motion start = stage.world(stage.node("ball")).motion;
  stage.advance(0.1);
  const double t = 0.1;
  const Vec3 expected = start.pose.position + t * start.twist.linear + 0.5 * t * t * Vec3(0, -9.81, 0);
  CHECK((place_of(stage, "ball") - expected).norm() < 1e-9);
  stage.advance(3);
  for (const char* node : {"ball", "wedge", "rod", "box 1", "box 15"}) {
    const Motion motion = stage.world(stage.node(node)).motion;
    CAPTURE(node);
    CHECK(motion.pose.position.z() == 0);
    CHECK(motion.pose.rotation.x() == 0);
    CHECK(motion.pose.rotation.y() == 0);
    CHECK(motion.pose.position.y() > 0);
  }
}

TEST_CASE("the swing on a spring gains, loses or keeps its energy as each integrator's own closed form says") {
  // Of 16 J; for x' = i w x, a method that turns 1 into z in a step multiplies the energy by |z|^2.
  const double y = 4.0 / 40, steps = 120;
  const auto changes = [&](const std::string& name, double share, double tolerance) {
    CAPTURE(name);
    Stage stage = lecture("integrators/" + name);
    stage.advance_to(3);
    const double x = place_of(stage, "bob").x(), v = stage.twist(stage.node("bob")).linear.x();
    CHECK(near((16 * x * x + v * v) / 16, std::pow(share, steps), tolerance));
  };
  changes("explicit_euler", 1 + y * y, 1e-9);
  changes("backward_euler", 1 / (1 + y * y), 1e-9);
  changes("implicit_trapezoid", 1, 1e-9);
  changes("midpoint", 1 + std::pow(y, 4) / 4, 1e-9);
  changes("trapezoid", 1 + std::pow(y, 4) / 4, 1e-9);
  changes("rk4", 1 - std::pow(y, 6) / 72 + std::pow(y, 8) / 576, 1e-9);
  // These three keep another sum than the energy, which therefore ripples: by y at most, or by y^2 / 4.
  changes("semi_implicit_euler", 1, 1.1 * y);
  changes("verlet", 1, 1.1 * y * y / 4);
  changes("exact_quadratic", 1, 1.1 * y * y / 4);
}

TEST_CASE("two balls are parted as each separation says") {
  const auto parts = [](const std::string& name, double light, double heavy, bool turns) {
    CAPTURE(name);
    Stage stage = lecture("separation/" + name);
    stage.advance_to(0.1);
    CHECK(near(place_of(stage, "light").x(), -0.45 - light, 1e-9));
    CHECK(near(place_of(stage, "heavy").x(), 0.45 + heavy, 1e-9));
    const double tilt = std::abs(stage.world(stage.node("rod")).motion.pose.rotation.z());
    CHECK((tilt > 1e-3) == turns);
  };
  parts("half", 0.05, 0.05, false);
  parts("by_mass", 0.075, 0.025, false);
  parts("positional_impulse", 0.075, 0.025, true);
  parts("closest_point", 0, 0.1, false);
}

TEST_CASE("the bullet passes the wall where it is looked for after the step, and bounces at the time of impact") {
  Stage discrete = lecture("collision/discrete"), ahead = lecture("collision/ahead"),
        impact = lecture("collision/time_of_impact");
  for (Stage* stage : {&discrete, &ahead, &impact}) stage->advance_to(0.1);
  CHECK(place_of(discrete, "bullet").x() > 9);
  CHECK(place_of(ahead, "bullet").x() < 5);
  // It hits the wall at 4.935 m and goes back at half its speed; the wall does not turn it.
  CHECK(near(place_of(impact, "bullet").x(), 4.935 - 0.5 * (10 - 4.635), 1e-5));
  // The ball is dropped from 2 m and keeps 0.8 of its speed.
  impact.advance_to(1);
  const double down = std::sqrt(4 / 9.81), up = 0.8 * 9.81 * down, since = 1 - down;
  CHECK(near(place_of(impact, "ball").y(), 0.1 + up * since - 0.5 * 9.81 * since * since, 1e-5));
}

TEST_CASE("in one world a bullet that is looked for late passes the wall, and its careful twin stops at its face") {
  Stage stage = lecture("collision/own");
  stage.advance_to(0.1);
  CHECK(place_of(stage, "retroactive bullet").x() > 9);
  CHECK(near(place_of(stage, "conservative bullet").x(), 4.935, 1e-6));
  stage.advance_to(1);
  // Of the balls, as above.
  const double down = std::sqrt(4 / 9.81), up = 0.8 * 9.81 * down, since = 1 - down;
  const double height = 0.1 + up * since - 0.5 * 9.81 * since * since;
  CHECK(near(place_of(stage, "conservative ball").y(), height, 1e-5));
  CHECK(std::abs(place_of(stage, "retroactive ball").y() - height) > 1e-3);
}

TEST_CASE("the stack stands by every solver but the sequential one, into which its weight sinks") {
  for (const std::string name : {"iterative", "lcp", "shock", "sequential"}) {
    CAPTURE(name);
    Stage stage = lecture("stacking/" + name);
    stage.advance_to(3);
    const double sunk = std::abs(4.25 - place_of(stage, "weight").y());
    if (name == "sequential")
      CHECK(sunk > 0.01);
    else
      CHECK(sunk < 0.01);
  }
}

TEST_CASE(
    "a run of the stack by the lcp solver tells how well complementarity is met, and other runs have no such word") {
  Stage stage = lecture("stacking/lcp"), iterative = lecture("stacking/iterative");
  const Recording recording = record(stage, 3, 30);
  REQUIRE(recording.complementarity.size() == recording.times.size());
  CHECK(recording.complementarity.back() > 0);
  CHECK(recording.complementarity.back() < 1e-9);
  CHECK(recording_json(recording).find("\"complementarity\": [0,") != std::string::npos);
  CHECK(recording_json(record(iterative, 0.1, 30)).find("complementarity") == std::string::npos);
}

TEST_CASE("what falls lies in the same places to the bit by whichever search its pairs are found") {
  std::vector<double> first;
  for (const std::string& name : names_in("broad_phase")) {
    CAPTURE(name);
    Stage stage = lecture("broad_phase/" + name);
    stage.advance_to(2);
    std::vector<double> places;
    for (int i = 1; i <= 24; ++i) {
      const Vec3 place = place_of(stage, "thing " + std::to_string(i));
      places.insert(places.end(), {place.x(), place.y(), place.z()});
    }
    if (first.empty()) first = places;
    CHECK(places == first);
  }
}

TEST_CASE("what is heavier below stands up again, by a density or by mass properties, and the even ball rolls on") {
  Stage stage = lecture("mass/self_righting");
  const double start = place_of(stage, "even").x();
  stage.advance_to(12);
  const auto upright = [&](const char* node) {
    return (stage.world(stage.node(node)).motion.pose.rotation * Vec3(0, 1, 0)).y();
  };
  CHECK(upright("heavier below") > 0.99);
  CHECK(upright("leaden core") > 0.99);
  CHECK(place_of(stage, "even").x() > start + 0.2);
}

TEST_CASE("solids roll down a slope as their moments of inertia say") {
  Stage stage = lecture("mass/rolling");
  // k m r^2 is the moment about the axis: of the capsule from its cylinder and its ball, of the wheels from their
  // parts.
  const double tube = 0.4, ends = 0.4 / 3, wheel = 2 * 1000 * pi * 0.15 * 0.15 * 0.1, axle = 1000 * 0.06 * 0.06 * 0.4;
  const std::pair<const char*, double> solids[] = {
      {"ball", 0.4},
      {"cylinder", 0.5},
      {"capsule", (0.5 * tube + 0.4 * ends) / (tube + ends)},
      {"wheels", (0.5 * wheel + axle * 2 * 0.06 * 0.06 / (12 * 0.15 * 0.15)) / (wheel + axle)},
      {"hoop", 1},
      {"needle", 0.025},
      {"cube", 0.25},
      {"dense inside", 2.0 / 7}};
  std::vector<Vec3> starts;
  for (const auto& [name, k] : solids) starts.push_back(place_of(stage, name));
  stage.advance_to(3);
  const double even = 0.5 * 9.81 * std::sin(pi / 18) * 9;
  for (std::size_t i = 0; i < std::size(solids); ++i) {
    CAPTURE(solids[i].first);
    CHECK((place_of(stage, solids[i].first) - starts[i]).norm() ==
          doctest::Approx(even / (1 + solids[i].second)).epsilon(5e-4));
  }
}

TEST_CASE("boxes on a slope stay where their friction is above its tangent, and else slide as Coulomb says") {
  Stage stage = lecture("contacts/slopes");
  const double slope = 25 * pi / 180;
  std::vector<std::pair<std::string, Vec3>> starts;
  for (const char* name : {"0.471", "0.461", "0.3", "0"}) starts.emplace_back(name, place_of(stage, name));
  stage.advance_to(2);
  for (const auto& [name, start] : starts) {
    CAPTURE(name);
    const double pull = 9.81 * (std::sin(slope) - std::stod(name) * std::cos(slope));
    CHECK(std::abs((place_of(stage, name) - start).norm() - std::max(0.0, 2 * pull)) < 1e-4);
  }
}

TEST_CASE("a spring as a system spirals out by explicit and in by backward Euler, by its closed form") {
  for (const bool out : {true, false}) {
    const Document document =
        Document::read(lectures / "first_order" / (out ? "spring_explicit_euler.json" : "spring_backward_euler.json"));
    REQUIRE(document.systems().size() == 1);
    const ExpressionSystem& system = document.systems()[0];
    const FirstOrderPath path = path_of(system, system.start);
    const double energy = value_at(*system.energy, path.times.back(), path.states.back());
    CHECK(path.times.size() == 401);
    CHECK(energy == doctest::Approx(2 * std::pow(1 + 0.05 * 0.05, out ? 400 : -400)).epsilon(1e-10));
  }
}
