#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("pendulum let go: velocity, instant and landing are those of the closed form at any step") {
  const double released = 0.4937, w = std::sqrt(standard_gravity);
  const double theta = std::cos(w * released), rate = -w * std::sin(w * released);
  const Vec3 place(std::sin(theta), 2 - std::cos(theta), 0),
      velocity(rate * std::cos(theta), rate * std::sin(theta), 0);
  // The published figures of the scenario, to the digits printed there.
  CHECK(near(place, Vec3(0.024478, 1.000300, 0), 1e-6));
  CHECK(near(velocity, Vec3(-3.130215, -0.076643, 0), 1e-6));
  const double fall =
      (velocity.y() + std::sqrt(velocity.y() * velocity.y() + 2 * standard_gravity * place.y())) / standard_gravity;
  CHECK(std::abs(released + fall - 0.937546) < 1e-6);

  for (const double step : compared_steps) {
    CAPTURE(step);
    StageDescription description = pendulum(step);
    description.rules = {release_at(released, "bob")};
    Stage stage(description);
    stage.advance_to(released + fall);
    REQUIRE(stage.handoffs().size() == 1);
    const HandOff& handoff = stage.handoffs()[0];
    CHECK(handoff.time == released);
    CHECK(handoff.cause == Cause::at);
    CHECK(near(handoff.after.pose.position, place, 1e-12));
    CHECK(near(handoff.after.twist.linear, velocity, 1e-9));
    CHECK(near(handoff.after.twist.angular, Vec3(0, 0, rate), 1e-9));
    const Vec3 landed = stage.world(stage.node("bob")).motion.pose.position;
    CHECK(std::abs(landed.y()) < 1e-9);
    CHECK(std::abs(landed.x() - (place.x() + velocity.x() * fall)) < 1e-9);
    CHECK(std::abs(landed.x() + 1.364856) < 1e-6);
  }
}

TEST_CASE("a differenced velocity is as wrong as it must be, so the closed form is no accident") {
  const double released = 0.4937, w = std::sqrt(standard_gravity);
  const double rate = -w * std::sin(w * released), theta = std::cos(w * released);
  const Vec3 exact(rate * std::cos(theta), rate * std::sin(theta), 0);
  for (const auto& [step, error] : {std::pair{1.0 / 60, 0.0817}, std::pair{1.0 / 240, 0.0204}}) {
    StageDescription description = pendulum(step);
    description.rules = {release_at(released, "bob", {.velocity = TakeOver::Velocity::step})};
    Stage stage(description);
    stage.advance_to(0.6);
    const double wrong = (stage.handoffs()[0].after.twist.linear - exact).norm();
    CHECK(wrong == doctest::Approx(error).epsilon(0.01));
  }
}

TEST_CASE("pose is continuous at a release and the body leaves with the derivative of its own path") {
  for (const double step : compared_steps) {
    for (const double released : {0.1234567, 0.77, 1.0, 1.6180339, 2.2}) {
      CAPTURE(step);
      CAPTURE(released);
      StageDescription description = tumbler(step);
      description.rules = {release_at(released, "body")};
      Stage stage(description);
      const Path path = stage.path(stage.node("body"));
      stage.advance_to(released);
      const HandOff& handoff = stage.handoffs()[0];
      const Motion arriving = path.at(released, Side::in);
      CHECK(near(handoff.before.pose.position, arriving.pose.position, 1e-12));
      CHECK(near(handoff.after.pose.position, arriving.pose.position, 1e-12));
      CHECK(near(handoff.after.pose.rotation, arriving.pose.rotation, 1e-12));
      const WorldMotion shown = stage.world(stage.node("body"));
      CHECK(near(shown.motion.pose.position, arriving.pose.position, 1e-12));
      CHECK(near(shown.motion.pose.rotation, arriving.pose.rotation, 1e-12));

      // The derivative of the center of mass, computed independently: a one-sided stencil of sixth order on the
      // arriving side.
      const Vec3 local(0.3, -0.2, 0.1);
      const double h = 2e-4;
      const double weights[] = {147.0 / 60, -6, 7.5, -20.0 / 3, 3.75, -1.2, 1.0 / 6};
      Vec3 velocity(0, 0, 0);
      for (int i = 0; i < 7; ++i) velocity += weights[i] / h * center(path.at(released - i * h, Side::in).pose, local);
      CHECK(near(handoff.after.twist.linear, velocity, 2e-9));
      CHECK(near(stage.twist(stage.node("body")).linear, velocity, 2e-9));
    }
  }
}

TEST_CASE("a body that turns about a point beside its center leaves with v = v_o + w x r") {
  const Vec3 spin(0, 0, 4);
  for (const double step : compared_steps) {
    StageDescription description;
    description.step = step;
    description.nodes = {
        {.name = "wheel",
         .body = BodyDescription{.shape = {Box{{0.1, 0.1, 0.1}}, {.position = {0.5, 0, 0}}}, .mass = 1.0}}};
    Clip clip;
    clip.name = "turn";
    clip.duration = std::numeric_limits<double>::infinity();
    clip.tracks = {{"wheel", "rotation",
                    axis_curve({0, 0, 1}, Curve<double>(
                                              [](double t, Side) {
                                                return Sample<double>{4 * t, 4, 0};
                                              },
                                              -std::numeric_limits<double>::infinity(),
                                              std::numeric_limits<double>::infinity()))}};
    description.clips = {clip};
    description.plays = {{.clip = 0}};
    const double time = 0.3183;
    description.rules = {release_at(time, "wheel")};
    Stage stage(description);
    stage.advance_to(0.5);
    const HandOff& handoff = stage.handoffs()[0];
    const Vec3 arm(0.5 * std::cos(4 * time), 0.5 * std::sin(4 * time), 0);
    CHECK(near(handoff.after.twist.linear, spin.cross(arm), 1e-12));
    CHECK(near(handoff.after.twist.angular, spin, 1e-12));
  }
}

TEST_CASE("the instant is exact wherever it lies in the step") {
  // Flight without contacts: the position at a fixed time after a release at any time of the grid is the closed form.
  const double w = std::sqrt(standard_gravity), end = 1.1;
  for (const double step : compared_steps) {
    for (int i = 0; i < 40; ++i) {
      const double released = 0.3 + i * 0.0073;
      StageDescription description = pendulum(step);
      description.rules = {release_at(released, "bob")};
      Stage stage(description);
      stage.advance_to(end);
      const double theta = std::cos(w * released), rate = -w * std::sin(w * released), fall = end - released;
      const Vec3 expected(std::sin(theta) + rate * std::cos(theta) * fall,
                          2 - std::cos(theta) + rate * std::sin(theta) * fall - standard_gravity * fall * fall / 2, 0);
      CHECK(near(stage.world(stage.node("bob")).motion.pose.position, expected, 1e-9));
    }
  }
}

TEST_CASE("after every step a keyed body is where its curve is, a quarter turn per step included") {
  for (const double step : compared_steps) {
    StageDescription description = tumbler(step);
    description.plays[0].speed = 1;
    Clip fast;
    fast.name = "fast";
    fast.duration = std::numeric_limits<double>::infinity();
    const double turn = std::numbers::pi / 2 / step;
    fast.tracks = {{"body", "rotation",
                    axis_curve({1, 1, 0}, Curve<double>(
                                              [=](double t, Side) {
                                                return Sample<double>{turn * t, turn, 0};
                                              },
                                              -std::numeric_limits<double>::infinity(),
                                              std::numeric_limits<double>::infinity()))}};
    description.clips.push_back(fast);
    description.plays.push_back({.clip = 1});
    Stage stage(description);
    const NodeId body = stage.node("body");
    for (int i = 1; i <= 60; ++i) {
      stage.advance_to(i * step);
      const Motion wanted = stage.path(body).at(stage.time()), shown = stage.world(body).motion;
      CHECK(near(shown.pose.position, wanted.pose.position, 1e-12));
      CHECK(near(shown.pose.rotation, wanted.pose.rotation, 1e-12));
    }
  }
}
