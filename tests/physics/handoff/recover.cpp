#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/settle_offset.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double tau = 2 * std::numbers::pi;

/// Scenario 22: a body at x = 0.30 m with v = -1.2 m/s goes back to the curve 0.1 sin(2 pi t).
struct HandBackScene {
  Motion body, path;
  HandBackScene(double x = 0.30, double v = -1.2) {
    body.pose.position = {x, 0, 0};
    body.twist.linear = {v, 0, 0};
    path = at(0);
  }
  static Motion at(double t) {
    Motion motion;
    motion.pose.position = {0.1 * std::sin(tau * t), 0, 0};
    motion.twist.linear = {0.1 * tau * std::cos(tau * t), 0, 0};
    return motion;
  }
  [[nodiscard]] Motion shown(const Settle& settle, double t) const {
    return SettleOffset(settle, 0, path, body).apply(t, at(t));
  }
};

}  // namespace

TEST_CASE("hand-back: quintic, spring and dead blend start with the body's own velocity") {
  const HandBackScene scene;
  for (const Settle& settle : {Settle{Settle::Kind::quintic, 0.4}, Settle{Settle::Kind::half_life, 0.08},
                               Settle{Settle::Kind::dead_blend, 0.4}}) {
    const Motion start = scene.shown(settle, 0);
    CHECK(near(start.pose.position, scene.body.pose.position, 1e-12));
    CHECK(near(start.twist.linear, scene.body.twist.linear, 1e-9));
  }
}

TEST_CASE("hand-back: residuals after 0.4 s are none for quintic and dead blend, 1.609 mm for the spring") {
  const HandBackScene scene;
  const Motion wanted = HandBackScene::at(0.4);
  CHECK(scene.shown({Settle::Kind::quintic, 0.4}, 0.4).pose.position == wanted.pose.position);
  CHECK(scene.shown({Settle::Kind::quintic, 0.4}, 0.4).twist.linear == wanted.twist.linear);
  CHECK(scene.shown({Settle::Kind::dead_blend, 0.4}, 0.4).pose.position == wanted.pose.position);
  const double residual =
      scene.shown({Settle::Kind::half_life, 0.08}, 0.4).pose.position.x() - wanted.pose.position.x();
  CHECK(residual == doctest::Approx(1.609e-3).epsilon(1e-3));
}

TEST_CASE("hand-back: peak accelerations are the scenario's, 5.2 for the quintic, 26.6 spring, 11.3 dead blend") {
  const HandBackScene scene;
  const auto peak = [&](const Settle& settle) {
    double most = 0;
    const double h = 1e-5;
    for (double t = h; t < 0.4 - h; t += 1e-3) {
      const double change = scene.shown(settle, t + h).twist.linear.x() - scene.shown(settle, t - h).twist.linear.x();
      most = std::max(most, std::abs(change) / (2 * h));
    }
    return most;
  };
  CHECK(peak({Settle::Kind::quintic, 0.4}) == doctest::Approx(5.2).epsilon(0.02));
  CHECK(peak({Settle::Kind::half_life, 0.08}) == doctest::Approx(26.6).epsilon(0.02));
  CHECK(peak({Settle::Kind::dead_blend, 0.4}) == doctest::Approx(11.3).epsilon(0.02));
}

TEST_CASE("hand-back: the shortened quintic does not cross its target, the spring does by 45.33 mm") {
  Motion path, body;
  body.pose.position = {0.05, 0, 0};
  body.twist.linear = {-3, 0, 0};
  const SettleOffset quintic({Settle::Kind::quintic, 0.4}, 0, path, body);
  const SettleOffset spring({Settle::Kind::half_life, 0.1}, 0, path, body);
  double least_quintic = 1, least_spring = 1;
  for (double t = 0; t < 0.6; t += 1e-4) {
    least_quintic = std::min(least_quintic, quintic.apply(t, path).pose.position.x());
    least_spring = std::min(least_spring, spring.apply(t, path).pose.position.x());
  }
  CHECK(least_quintic >= -1e-12);
  CHECK(least_spring == doctest::Approx(-45.33e-3).epsilon(1e-3));
  CHECK(quintic.apply(0.0834, path).pose.position.x() == 0);  // it is over after 5 x0 / 3 = 0.0833 s
}

TEST_CASE("on the stage, release and recovery are continuous in place and velocity, turning bodies included") {
  for (const double step : compared_steps) {
    for (const auto kind : {Settle::Kind::quintic, Settle::Kind::half_life, Settle::Kind::dead_blend}) {
      CAPTURE(step);
      StageDescription description = tumbler(step);
      description.world.gravity = {0, -2, 0};
      HandBack back;
      back.settle = {kind, 0.4};
      const double recovered = 1.2071;
      description.rules = {release_at(0.9137, "body"), recover_at(recovered, "body", back)};
      Stage stage(description);
      const NodeId body = stage.node("body");
      stage.advance_to(recovered);
      REQUIRE(stage.handoffs().size() == 2);
      const HandOff& handoff = stage.handoffs()[1];
      CHECK(handoff.time == recovered);
      CHECK(near(handoff.after.pose.position, handoff.before.pose.position, 1e-12));
      CHECK(near(handoff.after.pose.rotation, handoff.before.pose.rotation, 1e-12));
      CHECK(near(handoff.after.twist.linear, handoff.before.twist.linear, 1e-9));
      CHECK(near(handoff.after.twist.angular, handoff.before.twist.angular, 1e-9));

      // While it settles its twist is the derivative of what it shows.
      const double time = recovered + 0.1, h = 1e-4;
      const Path path = stage.path(body);
      const Vec3 stencil = (8 * (path.at(time + h).pose.position - path.at(time - h).pose.position) -
                            (path.at(time + 2 * h).pose.position - path.at(time - 2 * h).pose.position)) /
                           (12 * h);
      CHECK(near(path.at(time).twist.linear, stencil, 1e-8));
      const Vec3 one = log_map(path.at(time + h).pose.rotation * path.at(time - h).pose.rotation.conjugate());
      const Vec3 two = log_map(path.at(time + 2 * h).pose.rotation * path.at(time - 2 * h).pose.rotation.conjugate());
      const Vec3 spin = (8 * one - two) / (12 * h);
      CHECK(near(path.at(time).twist.angular, spin, 1e-7));

      if (kind == Settle::Kind::half_life) continue;
      stage.advance_to(recovered + 0.41);
      const Path plain(std::make_shared<const Animation>(path.animation()), body);
      CHECK(stage.world(body).motion.pose.position == plain.at(stage.time()).pose.position);
      CHECK(stage.world(body).motion.pose.rotation.coeffs() == plain.at(stage.time()).pose.rotation.coeffs());
    }
  }
}

TEST_CASE("a recovered path takes up where its clock says") {
  StageDescription description = pendulum(1.0 / 240);
  const double released = 0.4, recovered = 0.6;
  for (const auto& [clock, clip_time] :
       {std::pair{HandBack::Clock::run, recovered}, std::pair{HandBack::Clock::hold, released},
        std::pair{HandBack::Clock::restart, 0.0}}) {
    HandBack back;
    back.clock = clock;
    back.clip = "swing";
    description.rules = {release_at(released, "bob"), recover_at(recovered, "bob", back)};
    Stage stage(description);
    stage.advance_to(recovered + 1);
    const double theta = std::cos(std::sqrt(standard_gravity) * (clip_time + 1));
    CHECK(near(stage.world(stage.node("bob")).motion.pose.position, Vec3(std::sin(theta), 2 - std::cos(theta), 0),
               1e-12));
  }
}

TEST_CASE("a figure of jointed bodies is anchored as one, by its topmost body, in whatever order they come back") {
  StageDescription description;
  const std::vector<std::string> names = {"hips", "thigh", "shin"};
  for (std::size_t i = 0; i < 3; ++i) {
    description.nodes.push_back({.name = names[i],
                                 .parent = i == 0 ? no_node : i - 1,
                                 .rest = {.position = {i == 0 ? 0 : 0.5, 0, 0}},
                                 .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0, .collides_with = 0}});
    if (i > 0)
      description.joints.push_back({.name = names[i], .a = i - 1, .b = i, .frame_a = {.position = {0.5, 0, 0}}});
  }
  const auto turned = [](double x, double z) {
    return keyed_curve<Quat>({{.time = 0, .value = Quat(1, 0, 0, 0)}, {.time = 4, .value = exp_map(Vec3(x, 0, z))}});
  };
  Clip clip{.name = "kick", .duration = 4};
  clip.tracks = {
      {"hips", "position", keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = 4, .value = {1, 2, 0.5}}})},
      {"thigh", "rotation", turned(0.3, 1)},
      {"shin", "rotation", turned(-0.5, 0.8)}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  for (const auto anchor : {HandBack::Anchor::here, HandBack::Anchor::ground}) {
    HandBack back;
    back.anchor = anchor;
    std::vector<Pose> ends;
    for (const std::vector<std::string>& order : {names, std::vector<std::string>{"shin", "hips", "thigh"}}) {
      description.rules.clear();
      for (const std::string& name : order) {
        description.rules.push_back(release_at(0.5, name, {.add = {{0.2, 0, 0.3}, {0.4, 0.9, -0.3}}}));
        description.rules.push_back(recover_at(1.2, name, back));
      }
      Stage stage(description);
      const std::vector<Path> authored = {stage.path(0), stage.path(1), stage.path(2)};
      stage.advance_to(2.5);  // long after it has settled
      const auto from_hips = [](const Pose& hips, const Pose& limb) {
        return Pose{.position = hips.rotation.conjugate() * Vec3(limb.position - hips.position),
                    .rotation = hips.rotation.conjugate() * limb.rotation};
      };
      const Pose hips = stage.world(0).motion.pose, hips_by_script = authored[0].at(2.5).pose;
      CHECK((hips.position - hips_by_script.position).norm() > 0.01);  // moved
      for (const NodeId limb : {NodeId{1}, NodeId{2}}) {
        const Pose shown = from_hips(hips, stage.world(limb).motion.pose);
        const Pose wanted = from_hips(hips_by_script, authored[limb].at(2.5).pose);
        CHECK(near(shown.position, wanted.position, 1e-12));
        CHECK(near(shown.rotation, wanted.rotation, 1e-12));
        ends.push_back(stage.world(limb).motion.pose);
      }
    }
    for (const std::size_t i : {0U, 1U}) CHECK(ends[i].position == ends[i + 2].position);
  }
}

TEST_CASE("anchored here the path goes on from the body, on the ground it keeps its height and only turns") {
  StageDescription description = tumbler(1.0 / 240);
  for (const auto anchor : {HandBack::Anchor::here, HandBack::Anchor::ground}) {
    HandBack back;
    back.anchor = anchor;
    description.rules = {release_at(0.5, "body"), recover_at(0.8, "body", back)};
    Stage stage(description);
    const NodeId body = stage.node("body");
    const Path authored = stage.path(body);
    stage.advance_to(0.8);
    const Pose at_hand_back = stage.world(body).motion.pose;
    stage.advance_to(2.0);
    const Pose shown = stage.world(body).motion.pose, wanted = authored.at(2.0).pose;
    const Pose start = authored.at(0.8).pose;
    if (anchor == HandBack::Anchor::here) {
      const Quat turn = at_hand_back.rotation * start.rotation.conjugate();
      const Vec3 expected = at_hand_back.position + turn * Vec3(wanted.position - start.position);
      CHECK(near(shown.position, expected, 1e-9));
      CHECK(near(shown.rotation, turn * wanted.rotation, 1e-9));
    } else {
      CHECK(std::abs(shown.position.y() - wanted.position.y()) < 1e-9);
      const Quat turn = shown.rotation * wanted.rotation.conjugate();
      CHECK(std::abs(turn.x()) < 1e-9);
      CHECK(std::abs(turn.z()) < 1e-9);
    }
  }
}
