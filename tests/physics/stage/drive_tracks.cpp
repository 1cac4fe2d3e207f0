#include "physics/handoff/scenes.h"

#include <stdexcept>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A ball of 1 kg that hangs on its drive, whose frequency comes from a clip.
StageDescription hanging(const Curve<double>& hz, double duration = 100) {
  StageDescription stage;
  stage.nodes = {{.name = "arm",
                  .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .drive = Drive{.hz = 1, .zeta = 1}}}};
  Clip clip;
  clip.name = "stiffen";
  clip.duration = duration;
  clip.tracks = {{"arm", "drive_hz", hz}};
  stage.clips = {clip};
  stage.plays = {{.clip = 0}};
  return stage;
}

double sag(double hz) {
  const double w = 2 * pi * hz;
  return 9.81 / (w * w);
}

double height(const Stage& stage) {
  return stage.world(0).motion.pose.position.y();
}

}  // namespace

TEST_CASE("a body sags by g / w^2 at the frequency that its track has, and moves when the track does") {
  Stage stage(hanging(keyed_curve<double>({{.time = 0, .value = 2.0, .ease = Ease::hold()},
                                           {.time = 5, .value = 8.0, .ease = Ease::hold()},
                                           {.time = 9, .value = 4.0}})));
  CHECK(stage.owner(0) == Owner::driven);
  for (const auto& [time, hz] : {std::pair{4.9, 2.0}, {8.9, 8.0}, {13.0, 4.0}}) {
    stage.advance_to(time);
    CHECK(height(stage) == doctest::Approx(-sag(hz)).epsilon(0.001));
  }
  CHECK(stage.handoffs().empty());
  // Back and there again: the same bits.
  const double there = height(stage);
  stage.seek(3);
  stage.seek(13);
  CHECK(height(stage) == there);
}

TEST_CASE("a track of drives that is 0 lets the body fall, and above 0 takes it back") {
  Stage stage(hanging(keyed_curve<double>({{.time = 0, .value = 5.0, .ease = Ease::hold()},
                                           {.time = 3, .value = 0.0, .ease = Ease::hold()},
                                           {.time = 4, .value = 5.0}})));
  stage.advance_to(3);
  const double start = height(stage);
  stage.advance_to(3.5);
  CHECK(stage.owner(0) == Owner::free);
  CHECK(height(stage) - start == doctest::Approx(-9.81 / 8).epsilon(1e-6));
  stage.advance_to(8);
  CHECK(stage.owner(0) == Owner::driven);
  CHECK(height(stage) == doctest::Approx(-sag(5)).epsilon(0.001));
  REQUIRE(stage.handoffs().size() == 2);
  CHECK(stage.handoffs()[0].time == doctest::Approx(3));
  CHECK(stage.handoffs()[1].time == doctest::Approx(4));
}

TEST_CASE("plays with weights mix their drives evenly in the logarithm of the frequency") {
  StageDescription description = hanging(Curve<double>(2.0));
  Clip stiff = description.clips[0];
  stiff.name = "stiff";
  stiff.tracks = {{"arm", "drive_hz", Curve<double>(8.0)}};
  description.clips.push_back(stiff);
  description.plays.push_back({.clip = 1, .weight = Curve<double>(0.5)});
  Stage stage(description);
  stage.advance_to(6);
  CHECK(height(stage) == doctest::Approx(-sag(4)).epsilon(0.001));
}

TEST_CASE("a play has its say in what drives a body while it runs, and beyond that as it fills") {
  StageDescription description = hanging(Curve<double>(2.0));
  Clip stiff{.name = "stiff", .duration = 6};
  stiff.tracks = {{"arm", "drive_hz", Curve<double>(8.0)}};
  description.clips.push_back(stiff);
  for (const Fill fill : {Fill::none, Fill::forwards, Fill::backwards, Fill::both}) {
    std::vector<Play> plays{description.plays.front(), {.clip = 1, .at = 6, .fill = fill}};
    StageDescription filled = description;
    filled.plays = plays;
    Stage stage(filled);
    stage.advance_to(5.9);
    CHECK(height(stage) == doctest::Approx(-sag(fills_before(fill) ? 8 : 2)).epsilon(0.001));
    stage.advance_to(11.9);
    CHECK(height(stage) == doctest::Approx(-sag(8)).epsilon(0.001));
    stage.advance_to(18);
    CHECK(height(stage) == doctest::Approx(-sag(fills_after(fill) ? 8 : 2)).epsilon(0.001));
  }
}

TEST_CASE("who is handed over by a rule or the caller is no longer driven by its track") {
  Stage stage(hanging(Curve<double>(5.0)));
  stage.advance_to(1);
  stage.release(0);
  stage.advance_to(2);
  CHECK(stage.owner(0) == Owner::free);
  CHECK(height(stage) < -4);
  stage.recover(0);
  stage.advance_to(3);
  CHECK(stage.owner(0) == Owner::keyed);
}

TEST_CASE("a track of drives on a node that nothing can drive is refused with its name") {
  StageDescription description = hanging(Curve<double>(2.0));
  description.nodes[0].body.reset();
  CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("\"arm.drive_hz\""), std::invalid_argument);
  description = hanging(Curve<double>(2.0));
  description.clips[0].tracks[0].curve = Curve<Vec3>(Vec3(1, 2, 3));
  CHECK_THROWS_WITH_AS(Stage{description}, doctest::Contains("hertz"), std::invalid_argument);
}

TEST_CASE("a drive that bears the weight does not sag, and one that bears half of it sags half as far") {
  const double w = 2 * pi * 2;
  for (const Integrator integrator : {Integrator::exact_quadratic, Integrator::rk4}) {
    for (const WorldPlane plane : {WorldPlane::none, WorldPlane::xy}) {
      for (const double share : {0.0, 0.5, 1.0}) {
        CAPTURE(share);
        StageDescription description;
        description.world.integrator = plane == WorldPlane::none ? integrator : Integrator::exact_quadratic;
        description.world.plane = plane;
        Drive drive{.hz = 2};
        drive.gravity_compensation = share;
        description.nodes = {
            {.name = "b", .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 3.0, .drive = drive}}};
        Stage stage(description);
        stage.advance_to(4);
        CHECK(near(stage.world(0).motion.pose.position.y(), -(1 - share) * 9.81 / (w * w), 1e-6));
      }
    }
  }
}
