#include "importers/scenarios/scenario_stages.h"

#include <algorithm>
#include <cmath>
#include <functional>

// The scenarios of the hand-off that involve contacts and overlap, each with the bound that it states.

namespace tweenfall::contact_scenarios {

using namespace tweenfall::scenarios;
using namespace tweenfall::test;

namespace {

/// From 0 to `whole` in `seconds`, with no speed and no acceleration at its ends.
Curve<double> quintic(double whole, double seconds) {
  return Curve<double>(
      [=](double time, Side) {
        const double u = std::clamp(time / seconds, 0.0, 1.0);
        Sample<double> out;
        out.value = whole * u * u * u * (10 + u * (-15 + 6 * u));
        out.rate = whole * 30 * u * u * (1 - u) * (1 - u) / seconds;
        out.acceleration = whole * 60 * u * (1 - u) * (1 - 2 * u) / (seconds * seconds);
        return out;
      },
      0, seconds);
}

}  // namespace

TEST_CASE("scenario 2: a hammer at 3 m/s sends a ball off at (1 + e) 3 m/s") {
  for (const double step : {1.0 / 60, 1.0 / 240})
    for (const double e : {0.0, 0.5, 1.0}) {
      StageDescription stage = described(
          R"("hammer": {"body": {"shape": {"box": {"size": [0.2, 0.4, 0.4]}}}},
             "puck": {"position": [0.5013, 0, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "mass": 1, "friction": 0,
                                                       "restitution": )" +
              in_text(e) + "}}",
          R"("swing": {"tracks": {"hammer.position": [[0, [0, 0, 0], "linear"], [2, [6, 0, 0]]]}})",
          R"("world": {"gravity": [0, 0, 0]})");
      stage.step = step;
      Stage run(stage);
      run.advance_to(0.5);
      CHECK(std::abs(velocity(run, "puck").x() - 3 * (1 + e)) < 1e-6);
    }
}

TEST_CASE("scenario 2: five boxes that a wall pushes at 1 m/s all go at 1 m/s, and the ledger balances") {
  std::string nodes =
      floor_node + R"(, "wall": {"position": [-0.6, 0.25, 0], "body": {"shape": {"box": {"size": [0.2, 0.5, 1]}}}})";
  for (int i = 0; i < 5; ++i)
    nodes += ", \"box" + std::to_string(i) + "\": {\"position\": [" + in_text(0.5 * i) +
             R"(, 0.25, 0], "body": {"shape": {"box": {"size": [0.5, 0.5, 0.5]}}, "mass": 1, "friction": 0.5}})";
  const StageDescription stage = described(
      nodes, R"("push": {"tracks": {"wall.position": [[0, [-0.6, 0.25, 0], "linear"], [4, [3.4, 0.25, 0]]]}})", "");
  Stage run(stage);
  StageDescription without = stage;
  without.nodes.resize(2);
  Stage alone(without);
  double deepest = 0;
  Vec3 momentum(0, 0, 0), impulses(0, 0, 0);
  while (run.time() < 3.9) {
    run.advance(run.step());
    alone.advance(run.step());
    REQUIRE(place(run, "wall") == place(alone, "wall"));
    if (run.time() < 1) continue;
    for (int i = 0; i < 5; ++i) {
      const double gap = place(run, "box" + std::to_string(i)).x() -
                         (i == 0 ? place(run, "wall").x() + 0.1 : place(run, "box" + std::to_string(i - 1)).x() + 0.25);
      deepest = std::max(deepest, 0.25 - gap);
    }
  }
  for (int i = 0; i < 5; ++i) {
    CHECK(velocity(run, "box" + std::to_string(i)).x() == doctest::Approx(1).epsilon(1e-3));
    momentum += velocity(run, "box" + std::to_string(i));
  }
  impulses = -run.reaction(run.node("wall")) - run.reaction(run.node("floor")) + Vec3(0, -5 * g * run.time(), 0);
  MESSAGE("deepest overlap " << 1e3 * deepest << " mm; ledger off by " << (momentum - impulses).norm() << " N s");
  CHECK(deepest <= 5e-3);
  CHECK((momentum - impulses).norm() < 1e-9 * run.reaction(run.node("floor")).norm());
}

TEST_CASE("scenario 5: a track drives a belt, on which a box slips for 0.3823 s and 0.2867 m, and back") {
  Stage stage(described(
      R"("belt": {"position": [0, -0.5, 0], "body": {"shape": {"box": {"size": [20, 1, 2]}}, "static": true, "friction": 0.4}},
         "box": {"position": [0, 0.1, 0], "body": {"shape": {"box": {"size": [0.4, 0.2, 0.4]}}, "friction": 0.4}})",
      R"("drive": {"tracks": {"belt.surface_velocity": [[0, [0, 0, 0], "hold"], [1, [1.5, 0, 0], "hold"], [2, [0, 0, 0], "hold"],
                                                       [3, [-1.5, 0, 0], "hold"], [9, [-1.5, 0, 0]]]}})",
      ""));
  const auto slip = [&](double from, double belt) {
    stage.advance_to(from);
    double slipped = 0, until = from;
    while (stage.time() < from + 0.95) {
      const double before = place(stage, "box").x();
      stage.advance(stage.step());
      slipped += belt * stage.step() - (place(stage, "box").x() - before);
      if (std::abs(velocity(stage, "box").x() - belt) > 1e-4) until = stage.time();
    }
    CHECK(std::abs(velocity(stage, "box").x() - belt) <= 1e-4);
    return std::pair(until - from, slipped);
  };
  for (const auto& [from, belt] : {std::pair(1.0, 1.5), std::pair(3.0, -1.5)}) {
    const auto [time, way] = slip(from, belt);
    MESSAGE("slips for " << time << " s and " << way << " m");
    CHECK(std::abs(time - 0.3823) <= stage.step());
    CHECK(std::abs(std::abs(way) - 0.2867) <= 1.5 * stage.step());
    CHECK(way * belt > 0);
  }
}

TEST_CASE("scenario 9: on an elevator that never falls a box stays, and presses as it must") {
  for (const double step : {1.0 / 60, 1.0 / 240, 1.0 / 960}) {
    StageDescription stage = described(
        R"("lift": {"position": [0, 0, 0], "body": {"shape": {"box": {"size": [2, 0.2, 2]}}}},
           "box": {"position": [0, -0.3, 0], "body": {"shape": {"box": {"size": [0.2, 0.2, 0.2]}}, "mass": 2}})",
        R"json("ride": {"tracks": {"lift.position": {"expression": ["0", "-0.5*cos(pi*t)", "0"]}}})json", "");
    stage.step = step;
    Stage run(stage);
    double low = 1, high = -1, worst = 0;
    Vec3 before(0, 0, 0);
    for (int i = 0; run.time() < 6; ++i) {
      const double middle = (i + 0.5) * step;
      // Also as it is shown between two steps.
      for (const double part : {0.25, 0.5, 0.75, 1.0}) {
        run.advance_to((i + part) * step);
        const double gap = place(run, "box").y() - place(run, "lift").y() - 0.2;
        low = std::min(low, gap);
        high = std::max(high, gap);
      }
      const double force = -(run.reaction(run.node("lift")) - before).y() / step;
      before = run.reaction(run.node("lift"));
      const double expected = 2 * (g + 0.5 * pi * pi * std::cos(pi * middle));
      if (run.time() > 0.1) worst = std::max(worst, std::abs(force / expected - 1));
    }
    MESSAGE("steps of " << step << " s: gap " << 1e3 * low << " to " << 1e3 * high << " mm, force within "
                        << 100 * worst << " %");
    CHECK(low >= -1e-3);
    CHECK(high <= 1e-4);
    CHECK(worst < 0.01);
  }
}

TEST_CASE("scenario 9: from an elevator that falls faster than g a box leaves and comes back when it must") {
  Stage run(described(
      R"("lift": {"position": [0, 0, 0], "body": {"shape": {"box": {"size": [2, 0.2, 2]}}}},
         "box": {"position": [0, -0.3, 0], "body": {"shape": {"box": {"size": [0.2, 0.2, 0.2]}}, "mass": 2}})",
      R"json("ride": {"tracks": {"lift.position": {"expression": ["0", "-0.5*cos(2*pi*t/1.2)", "0"]}}})json", ""));
  const double step = run.step();
  double leaves = 0, speed = 0, widest = 0, back = 0, closing = 0;
  Vec3 before(0, 0, 0);
  while (run.time() < 1.15) {
    const double relative = velocity(run, "box").y() - velocity(run, "lift").y();
    run.advance(step);
    const bool presses = (run.reaction(run.node("lift")) - before).norm() > 0;
    before = run.reaction(run.node("lift"));
    const double gap = place(run, "box").y() - place(run, "lift").y() - 0.2;
    widest = std::max(widest, gap);
    if (presses && widest < 1e-3) {
      leaves = run.time();
      speed = velocity(run, "box").y();
    }
    if (presses && widest > 0.1 && back == 0) {
      back = run.time();
      closing = -relative;
    }
  }
  MESSAGE("leaves at " << leaves << " s with " << speed << " m/s, " << widest << " m high, back at " << back
                       << " s with " << closing << " m/s");
  CHECK(std::abs(leaves - 0.45232) <= step);
  CHECK(std::abs(speed - 1.82856) <= 0.029);
  CHECK(std::abs(widest - 0.19354) <= 0.02 * 0.19354);
  CHECK(std::abs(back - 1.07172) <= step);
  CHECK(std::abs(closing - 2.6186) <= 0.02 * 2.6186);
}

TEST_CASE("scenario 10: a statue that waits for 4 N s is freed by 4.7273, and one that waits for 4.8 is not") {
  const auto run = [](double threshold) {
    Stage stage(described(
        R"("statue": {"body": {"shape": {"box": {"size": [0.4, 0.4, 0.4]}}, "mass": 5, "restitution": 0.3, "drive": "keyed"}},
           "ball": {"position": [-1, 0, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "mass": 0.5, "restitution": 0.3,
                                                     "velocity": [8, 0, 0]}})",
        "",
        R"("world": {"gravity": [0, 0, 0]},
           "handoff": [{"body": "statue", "when": {"contact": {"impulse": )" +
            in_text(threshold) + R"(}}, "to": "free"}])"));
    stage.advance_to(0.5);
    return stage;
  };
  const Stage freed = run(4);
  REQUIRE(freed.handoffs().size() == 1);
  CHECK(std::abs(velocity(freed, "ball").x() + 1.4545454545454546) < 1e-9);
  CHECK(std::abs(velocity(freed, "statue").x() - 0.9454545454545454) < 1e-9);
  CHECK(std::abs(0.5 * velocity(freed, "ball").x() + 5 * velocity(freed, "statue").x() - 4) < 4e-9);
  const Stage held = run(4.8);
  CHECK(held.handoffs().empty());
  CHECK(std::abs(velocity(held, "ball").x() + 2.4) < 1e-9);
  CHECK(std::abs(held.reaction(held.node("statue")).x() - 5.2) < 1e-9);
}

namespace {

constexpr double thickness = 0.02, pitch = 0.05;
constexpr int dominoes = 20;

/// Twenty dominoes and a finger that tilts the first by `degrees` in `seconds` and goes back.
StageDescription domino_run(double degrees, double seconds) {
  std::string nodes = floor_node + R"(, "finger": {"body": {"shape": {"sphere": {"radius": 0.005}}, "friction": 0}})";
  for (int i = 0; i < dominoes; ++i)
    nodes += ", \"domino" + std::to_string(i + 1) + "\": {\"position\": [" + in_text(pitch * i) +
             R"(, 0.05, 0], "body": {"shape": {"box": {"size": [0.02, 0.1, 0.05]}}}})";
  StageDescription stage = described(nodes, R"("push": {"tracks": {"finger.position": [[0, [0, 0, 0]]]}})", "");
  // Where a finger of that radius, at that height, is when it touches the tilted back.
  constexpr double radius = 0.005, at = 0.09;
  const auto finger = [](double angle) {
    const double foot = thickness / 2 - thickness * std::cos(angle), up = thickness * std::sin(angle);
    return foot + ((at - up) * std::sin(angle) - radius) / std::cos(angle);
  };
  const Curve<double> angle = quintic(degrees * degree, seconds);
  stage.clips[0].tracks[0].curve = Curve<Vec3>(
      [=](double time, Side side) {
        // There and back again, all by the angle.
        const bool withdraws = time > seconds;
        const Sample<double> tilt = angle.sample(withdraws ? 2 * seconds - time : time, side);
        constexpr double small = 1e-6;
        const double slope = (finger(tilt.value + small) - finger(tilt.value - small)) / (2 * small);
        Sample<Vec3> out;
        out.value = Vec3(finger(tilt.value), at, 0);
        out.rate = Vec3(slope * tilt.rate * (withdraws ? -1 : 1), 0, 0);
        out.acceleration = Vec3(0, 0, 0);
        return out;
      },
      0, 2 * seconds);
  stage.clips[0].duration = 2 * seconds;
  return stage;
}

std::vector<int> fallen(const Stage& stage) {
  std::vector<int> found;
  for (int i = 1; i <= dominoes; ++i) {
    const Quat turn = stage.world(stage.node("domino" + std::to_string(i))).motion.pose.rotation;
    if ((turn * Vec3(0, 1, 0)).y() < 0.7) found.push_back(i);
  }
  return found;
}

std::size_t fallen_from(double degrees, double seconds) {
  Stage stage(domino_run(degrees, seconds));
  stage.advance_to(2 * seconds + 3);
  return fallen(stage).size();
}

/// When each domino first met the one before it, s.
std::vector<double> first_meetings(const Stage& stage) {
  std::vector<double> times;
  for (int i = 1; i < dominoes; ++i) {
    const NodeId a = stage.node("domino" + std::to_string(i)), b = stage.node("domino" + std::to_string(i + 1));
    const auto met = std::ranges::find_if(stage.events(), [&](const StageEvent& event) {
      return event.name == "contact" && event.nodes.size() == 2 && std::min(event.nodes[0], event.nodes[1]) == a &&
             std::max(event.nodes[0], event.nodes[1]) == b;
    });
    if (met != stage.events().end()) times.push_back(met->time);
  }
  return times;
}

/// How far a domino leans, degrees.
double lean(const Stage& stage, int number) {
  const Quat turn = stage.world(stage.node("domino" + std::to_string(number))).motion.pose.rotation;
  return std::acos(std::clamp((turn * Vec3(0, 1, 0)).y(), -1.0, 1.0)) / degree;
}

}  // namespace

TEST_CASE("scenario 11: at 10.2 degrees no domino falls, at 12.4 the first alone, and from 21 degrees on all do") {
  CHECK(fallen_from(10.2, 1) == 0);
  {
    Stage stage(domino_run(10.2, 1));
    stage.advance_to(6);
    for (int i = 1; i <= dominoes; ++i) CHECK(lean(stage, i) < 0.5);
  }
  {
    // The first falls against the second, which it cannot lift over its edge.
    Stage stage(domino_run(12.4, 1));
    stage.advance_to(6);
    CHECK(lean(stage, 1) > 15);
    for (int i = 2; i <= dominoes; ++i) CHECK(lean(stage, i) < 0.5);
  }
  const auto first_of = [](double no, double yes, double within, const auto& falls) {
    while (std::abs(yes - no) > within) {
      const double middle = (no + yes) / 2;
      (falls(middle) ? yes : no) = middle;
    }
    return yes;
  };
  const double angle = first_of(12.4, 30, 0.1, [](double a) { return fallen_from(a, 1) == dominoes; });
  const double stroke = first_of(1, 0.05, 0.01, [](double s) { return fallen_from(12.4, s) == dominoes; });
  MESSAGE("pushed in one second all fall from " << angle << " degrees; pushed to 12.4 degrees in strokes of " << stroke
                                                << " s or less");
  CHECK(angle > 20);
  CHECK(angle < 22);
  CHECK(stroke > 0.15);
  CHECK(stroke < 0.4);
}

TEST_CASE(
    "scenario 11: all dominoes fall one after the other in a steady wave, in the same bits from a save at the "
    "seventh") {
  StageDescription fine = domino_run(12.4, 0.2);
  fine.step = 1.0 / 960;  // contacts are reported at the ends of steps
  Stage stage(fine), again(fine), loaded(fine);
  std::vector<std::byte> saved;
  again.on_contact([&](const StageEvent&) {
    if (saved.empty() && first_meetings(again).size() == 7) saved = again.save();
  });
  for (Stage* each : {&stage, &again}) each->advance_to(4);
  CHECK(fallen(stage).size() == dominoes);
  REQUIRE(!saved.empty());
  loaded.load(saved);
  CHECK(first_meetings(loaded).size() == 7);
  loaded.advance_to(4);
  CHECK(stage.state_hash() == again.state_hash());
  CHECK(stage.state_hash() == loaded.state_hash());
  CHECK(loaded.events().size() == stage.events().size());
  const std::vector<double> times = first_meetings(stage);
  REQUIRE(times.size() == dominoes - 1);
  const double mean = (times[18] - times[8]) / 10;
  double uneven = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    CHECK(times[i] > times[i - 1]);
    if (i > 8) uneven = std::max(uneven, std::abs((times[i] - times[i - 1]) / mean - 1));
  }
  MESSAGE("one domino every " << mean << " s, " << pitch / mean << " m/s; the last ten within " << 100 * uneven
                              << " %");
  CHECK(uneven < 0.1);
}

TEST_CASE("scenario 13: a box that rides a turntable stays where it is, and slides off where friction ends") {
  for (const double step : {1.0 / 60, 1.0 / 240}) {
    StageDescription stage = described(
        R"("table": {"position": [0, -0.1, 0], "body": {"shape": {"cylinder": {"radius": 3, "height": 0.2}}, "friction": 0.8}},
           "box": {"position": [1, 0.05, 0], "body": {"shape": {"box": {"size": [0.1, 0.1, 0.1]}}, "friction": 0.8,
                                                      "velocity": [0, 0, -1], "angular_velocity": [0, 57.29577951308232, 0]}})",
        R"("spin": {"tracks": {"table.rotation": {"axis": "y", "keys": [[0, 0, "linear"], [8, 458.3662361046586]]}}})",
        "");
    stage.step = step;
    Stage run(stage);
    run.advance_to(6);
    const double radius = std::hypot(place(run, "box").x(), place(run, "box").z());
    // Friction that held the box by the velocity at the step's end would let it drift out by this factor. A thousandth
    // of the radius, at 1/240 s, is not reached.
    const double drift = std::exp(step * 6 / 2) - 1;
    MESSAGE("steps of " << step << " s: from 1 m to " << radius << " m, where by tangents it would be " << 1 + drift
                        << " m");
    CHECK(radius - 1 < 0.2 * drift);
    CHECK(radius > 1 - 1e-3);
  }
  Stage run(described(
      R"("table": {"position": [0, -0.1, 0], "body": {"shape": {"cylinder": {"radius": 3, "height": 0.2}}, "friction": 0.8}},
         "box": {"position": [1, 0.05, 0], "body": {"shape": {"box": {"size": [0.1, 0.1, 0.1]}}, "friction": 0.8}})",
      R"("spin": {"duration": 16, "tracks": {"table.rotation": {"axis": "y", "expression": "57.29577951308232*0.1*t*t"}}})",
      ""));
  double off = 0, before = 1;
  while (run.time() < 15.5 && off == 0) {
    run.advance(run.step());
    const double radius = std::hypot(place(run, "box").x(), place(run, "box").z());
    if (radius - before > 0.01 * run.step()) off = 0.2 * run.time();
    before = radius;
  }
  MESSAGE("slides off at " << off << " rad/s; 2.801 by friction");
  CHECK(std::abs(off - 2.801) <= 0.02 * 2.801);
}

namespace {

/// An arm of 1.2 m that turns by 110 degrees in 0.35 s, with a cup at its end, and a ball in it.
StageDescription catapult(bool welded) {
  const std::string ball = R"("body": {"shape": {"sphere": {"radius": 0.05}}, "mass": 0.5, "friction": 0}})";
  StageDescription stage = described(
      R"("pivot": {"position": [0, 1, 0]},
         "cup": {"parent": "pivot", "position": [1.2, 0, 0], "body": {"friction": 0, "shape": {"compound": {"parts": [
            {"shape": {"box": {"size": [0.14, 0.02, 0.14]}}, "position": [0, -0.06, 0]},
            {"shape": {"box": {"size": [0.02, 0.1, 0.14]}}, "position": [0.06, 0, 0]},
            {"shape": {"box": {"size": [0.02, 0.1, 0.14]}}, "position": [-0.06, 0, 0]},
            {"shape": {"box": {"size": [0.14, 0.1, 0.02]}}, "position": [0, 0, 0.06]},
            {"shape": {"box": {"size": [0.14, 0.1, 0.02]}}, "position": [0, 0, -0.06]}]}}}},
         "ball": {)" +
          std::string(welded ? R"("parent": "pivot", "position": [1.2, 0, 0], )" : R"("position": [1.2, 1, 0], )") +
          ball,
      R"("throw": {"tracks": {"pivot.rotation": {"axis": "z", "keys": [[0, 0]]}}, "events": [[0.175, "mid-stroke"]]})",
      welded ? R"("handoff": [{"body": "ball", "when": {"marker": "mid-stroke"}, "to": "free"}])" : "");
  stage.clips[0].duration = 1;
  stage.clips[0].tracks[0].curve = axis_curve({0, 0, 1}, quintic(110 * degree, 0.35));
  return stage;
}

}  // namespace

TEST_CASE(
    "scenario 14: a ball on a catapult leaves by its marker with the arm's own velocity, and lands where it must") {
  const double angle = 55 * degree, speed = 1.2 * 110 * degree * 1.875 / 0.35;
  CHECK(speed == doctest::Approx(12.3420).epsilon(1e-5));
  for (const double step : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    StageDescription stage = catapult(true);
    stage.step = step;
    stage.ignored = {{1, 2}};
    Stage run(stage);
    run.advance_to(0.5);
    REQUIRE(run.handoffs().size() == 1);
    const Vec3 left = run.handoffs()[0].after.twist.linear;
    const Vec3 expected = speed * Vec3(-std::sin(angle), std::cos(angle), 0);
    CHECK((left - expected).norm() < 1e-9);
    const double t = 0.5 - 0.175;
    const Vec3 there =
        Vec3(1.2 * std::cos(angle), 1 + 1.2 * std::sin(angle), 0) + expected * t - Vec3(0, g / 2 * t * t, 0);
    CHECK((place(run, "ball") - there).norm() < 1e-9);
  }
}

TEST_CASE("scenario 14: a ball that only lies in the cup leaves it after mid-stroke, at the cup's speed") {
  Stage run(catapult(false));
  const NodeId cup = run.node("cup");
  double apart = 0, ball = 0, arm = 0;
  while (run.time() < 0.35 && apart == 0) {
    run.advance(run.step());
    const Motion& there = run.world(cup).motion;
    const Vec3 inside = there.pose.rotation.conjugate() * (place(run, "ball") - there.pose.position);
    if (inside.y() < 1e-4) continue;
    apart = run.time();
    ball = velocity(run, "ball").norm();
    arm = there.twist.linear.norm();
  }
  MESSAGE("apart at " << apart << " s with " << ball << " m/s, the cup at " << arm << " m/s; mid-stroke is at 0.175 s");
  CHECK(apart >= 0.175);
  CHECK(std::abs(ball - arm) <= 0.02 * arm);
}

}  // namespace tweenfall::contact_scenarios
