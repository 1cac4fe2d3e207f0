#include "physics/handoff/scenes.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

Clip held(const std::string& name, const std::string& node, const Vec3& place) {
  Clip clip;
  clip.name = name;
  clip.duration = endless;
  clip.tracks = {{node, "position", Curve<Vec3>(place)}};
  return clip;
}

}  // namespace

TEST_CASE("a dead blend over many turns has a continuous and bounded angular velocity") {
  Motion body, path;
  body.twist.angular = {0, 0, 900};
  body.pose.rotation = Quat(std::cos(0.7), 0, 0, std::sin(0.7));
  const SettleOffset offset({Settle::Kind::dead_blend, 0.5}, 0, path, body);
  Motion last = offset.apply(0, path);
  CHECK(last.twist.angular.z() == doctest::Approx(900));
  const double h = 1e-5;
  for (double t = h; t < 0.6; t += h) {
    const Motion now = offset.apply(t, path);
    CHECK(now.twist.angular.norm() < 1000);
    CHECK((now.twist.angular - last.twist.angular).norm() < 0.3);
    CHECK(std::abs(last.pose.rotation.dot(now.pose.rotation)) > std::cos(0.5 * 1000 * h));
    last = now;
  }
  CHECK(last.pose.rotation.coeffs() == path.pose.rotation.coeffs());
}

TEST_CASE("the nodes below a body that is handed back settle with it") {
  StageDescription description;
  description.nodes = {
      {.name = "hip", .rest = {.position = {0, 5, 0}}, .body = BodyDescription{.shape = {Sphere{0.1}}}},
      {.name = "leg", .parent = 0},
      {.name = "foot", .parent = 1}};
  description.clips = {held("walk", "foot", {0, -1, 0}), held("rise", "foot", {0.3, -0.8, 0.1})};
  description.clips[1].tracks.push_back({"hip", "position", Curve<Vec3>(Vec3(0, 4, 0))});
  description.plays = {{.clip = 0}};
  HandBack back;
  back.clip = "rise";
  description.rules = {release_at(0.1, "hip"), recover_at(0.6, "hip", back)};
  description.nodes[0].body->drive = Drive::keyed();
  Stage stage(description);
  stage.advance_to(0.6 - 1e-7);
  const Vec3 before = stage.world(2).motion.pose.position;
  stage.advance_to(0.6 + 1e-7);
  CHECK(near(stage.world(2).motion.pose.position, before, 2e-6));
  CHECK(near(stage.world(2).motion.twist.linear, stage.world(0).motion.twist.linear, 1e-3));
  stage.advance_to(1.0);
  CHECK(near(stage.world(2).motion.pose.position, Vec3(0.3, 3.2, 0.1), 1e-12));
}

TEST_CASE("sizes settle with the places, of a body that is handed back and of the nodes below it") {
  for (const Settle& settle : {Settle{Settle::Kind::quintic, 0.3}, Settle{Settle::Kind::half_life, 0.05},
                               Settle{Settle::Kind::dead_blend, 0.3}})
    for (const char* const grown : {"hip", "leg"}) {
      CAPTURE(static_cast<int>(settle.kind));
      CAPTURE(grown);
      StageDescription description;
      description.nodes = {{.name = "hip",
                            .rest = {.position = {0, 5, 0}, .rotation = Quat(0.8, 0, 0.6, 0)},
                            .body = BodyDescription{.shape = {Sphere{0.1}}, .drive = Drive::keyed()}},
                           {.name = "leg", .parent = 0},
                           {.name = "foot", .parent = 1, .rest = {.position = {0.5, -1, 0.2}}}};
      description.clips = {held("walk", "hip", {0, 5, 0}), held("rise", "hip", {0, 4, 0})};
      description.clips[1].tracks.push_back({grown, "scale", Curve<Vec3>(Vec3(1.5, 2, 0.5))});
      description.plays = {{.clip = 0}};
      HandBack back;
      back.clip = "rise";
      back.settle = settle;
      description.rules = {release_at(0.1, "hip"), recover_at(0.6, "hip", back)};
      Stage stage(description);
      const double h = 1e-6;
      const auto foot_at = [&](double time) {
        stage.advance_to(time);
        return stage.world(2);
      };
      const WorldMotion before = foot_at(0.6 - h), after = foot_at(0.6 + h);
      CHECK(near(after.motion.pose.position, before.motion.pose.position, 2 * h * 6));
      CHECK((after.linear - before.linear).cwiseAbs().maxCoeff() < 1e-6);
      // Halfway, the velocities are those of the positions shown.
      const WorldMotion early = foot_at(0.7 - h), middle = foot_at(0.7), late = foot_at(0.7 + h);
      CHECK(near(middle.motion.twist.linear, (late.motion.pose.position - early.motion.pose.position) / (2 * h), 1e-4));
      CHECK(((late.linear - early.linear) / (2 * h) - middle.linear_rate).cwiseAbs().maxCoeff() < 1e-4);
      Vec3 foot = Quat(0.8, 0, 0.6, 0) * Vec3(0.75, -2, 0.1);
      CHECK(near(foot_at(4).motion.pose.position, Vec3(0, 4, 0) + foot, 1e-9));
    }
}

TEST_CASE("a rule to a drive follows the path it names, and settles onto it") {
  StageDescription description;
  description.world.gravity = {0, 0, 0};
  description.nodes = {{.name = "b",
                        .rest = {.position = {0.5, 0, 0}},
                        .body = BodyDescription{.shape = {Sphere{0.05}}, .drive = Drive::free()}}};
  description.clips = {held("there", "b", {-1, 2, 0})};
  Rule rule = recover_at(0.3, "b", {.clip = "there"});
  rule.to = {.hz = 8};
  description.rules = {rule};
  Stage stage(description);
  stage.advance_to(0.31);
  CHECK(near(stage.world(0).motion.pose.position, Vec3(0.5, 0, 0), 0.02));
  stage.advance_to(2);
  CHECK(stage.owner(0) == Owner::driven);
  CHECK(near(stage.world(0).motion.pose.position, Vec3(-1, 2, 0), 1e-6));
}

TEST_CASE("a body taken back up to a billionth of a second after a step is where it was when the step ends") {
  for (const Settle& settle : {Settle{Settle::Kind::quintic, 0.4}, Settle{Settle::Kind::half_life, 0.1},
                               Settle{Settle::Kind::dead_blend, 0.3}})
    for (const double late : {-1e-12, 0.0, 1e-16, 1e-12, 5e-10, 9e-10, 2e-9})
      for (const bool restart : {false, true}) {
        CAPTURE(static_cast<int>(settle.kind));
        CAPTURE(late);
        CAPTURE(restart);
        StageDescription stage;
        stage.world.gravity = {0, 0, 0};
        stage.nodes = {
            {.name = "b",
             .rest = {.position = {0.8, 0, 0}},
             .body = BodyDescription{
                 .shape = {Sphere{0.1}}, .mass = 1.0, .drive = Drive::free(), .twist = {{0.3, 0, 0}, {0, 0, 0}}}}};
        Clip clip = held("there", "b", {-0.4, 2, 0});
        if (restart) {
          clip.duration = 0.7;
          clip.loop.mode = LoopMode::repeat;
          clip.tracks = {{"b", "position",
                          keyed_curve<Vec3>({{.time = 0, .value = {-0.4, 2, 0}}, {.time = 0.7, .value = {5, 2, 0}}})}};
        }
        stage.clips = {clip};
        Rule back;
        back.bodies = {"b"};
        back.when.triggers = {when::At{0.5 + late}};
        back.to = Drive::keyed();
        back.hand_back.clip = "there";
        back.hand_back.clock = restart ? HandBack::Clock::restart : HandBack::Clock::run;
        back.hand_back.settle = settle;
        stage.rules = {back};
        Stage run(stage);
        run.advance_to(0.5);
        CHECK(std::abs(run.world(0).motion.pose.position.x() - 0.95) < 1e-8);
        CHECK(std::abs(run.world(0).motion.pose.position.y()) < 1e-8);
        if (!restart) CHECK(std::abs(run.twist(0).linear.x() - 0.3) < 1e-6);
      }
}
