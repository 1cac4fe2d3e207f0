#include "physics/handoff/scenes.h"

#include <complex>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

BodyDescription ball(const Drive& drive) {
  return {.shape = {Sphere{0.1}}, .mass = 1.0, .groups = 0, .drive = drive};
}

/// A root, a link 1 m beside it and a hand 1 m beside that; nothing meets anything.
StageDescription arm(const Drive& root, const Drive& link, const Drive& hand) {
  StageDescription stage;
  stage.nodes = {{.name = "root", .body = ball(root)},
                 {.name = "link", .parent = 0, .rest = {.position = {1, 0, 0}}, .body = ball(link)},
                 {.name = "hand", .parent = 1, .rest = {.position = {1, 0, 0}}, .body = ball(hand)}};
  for (NodeDescription& node : stage.nodes) node.body->collides_with = 0;
  return stage;
}

Drive carried(Drive::Frame frame, double hz = 5) {
  return {.hz = hz, .frame = frame};
}

Vec3 place(const Stage& stage, NodeId node) {
  return stage.world(node).motion.pose.position;
}

}  // namespace

TEST_CASE("what is carried along by a keyed parent is pulled just as in the world") {
  std::vector<std::uint64_t> hashes;
  for (const Drive::Frame frame : {Drive::Frame::world, Drive::Frame::parent, Drive::Frame::anchor}) {
    StageDescription description = arm(Drive::keyed(), Drive::keyed(), carried(frame));
    Clip clip{.name = "swing", .duration = std::numeric_limits<double>::infinity()};
    clip.tracks = {{"root", "rotation", axis_curve({0, 0, 1}, oscillator({.amplitude = 1, .hz = 0.7}))}};
    description.clips = {clip};
    description.plays = {{.clip = 0}};
    Stage stage(description);
    stage.advance_to(1.7);
    const Vec3 at = place(stage, 2);
    hashes.push_back(std::hash<double>{}(at.x()) ^ (std::hash<double>{}(at.y()) << 1));
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("a hand keeps its place beside a link that falls, which in the world it would stay behind") {
  // The carrying body is predicted where its weight takes it; the pull is off by at most a step's worth of fall.
  const double h = 1.0 / 240, off = standard_gravity * h * h;
  for (const Drive::Frame frame : {Drive::Frame::parent, Drive::Frame::anchor}) {
    Stage stage(arm(Drive::free(), Drive::free(), carried(frame)));
    stage.advance_to(2);
    CHECK(near(place(stage, 1), Vec3(1, -standard_gravity * 2, 0), 1e-9));
    CHECK(near(place(stage, 2), place(stage, 1) + Vec3(1, 0, 0), off));
    CHECK(near(stage.twist(2).linear, stage.twist(1).linear, 0.01));
  }
  Stage stage(arm(Drive::free(), Drive::free(), carried(Drive::Frame::world)));
  stage.advance_to(2);
  CHECK(place(stage, 2).y() > -0.02);
}

TEST_CASE("a parent carries the nearest, an anchor is the topmost body above") {
  const auto after = [](Drive::Frame frame) {
    StageDescription description = arm(Drive::free(), Drive::free(), carried(frame));
    description.world.gravity = {0, 0, 0};
    description.nodes[0].body->twist.linear = {0, 0.5, 0};
    description.nodes[1].body->twist.linear = {0, 0, -0.25};
    Stage stage(description);
    stage.advance_to(4);
    return place(stage, 2);
  };
  CHECK(near(after(Drive::Frame::parent), Vec3(2, 0, -1), 1e-9));
  CHECK(near(after(Drive::Frame::anchor), Vec3(2, 2, 0), 1e-9));
  CHECK(near(after(Drive::Frame::world), Vec3(2, 0, 0), 1e-9));
}

TEST_CASE("a hand on a link that spins goes round with it, as far out and as far ahead as its drive lets it") {
  // In the plane of the spin, z = x + iy: z'' = w^2 (e^(iWt) - z) + 2 a w (i W e^(iWt) - z') is solved by
  // z = (w^2 + 2 a w i W) / (w^2 - W^2 + 2 a w i W) e^(iWt).
  const double w = 2 * pi * 3, zeta = 0.6, spin = 4;
  const std::complex<double> i(0, 1), damping = 2 * zeta * w * spin * i;
  const std::complex<double> expected = (w * w + damping) / (w * w - spin * spin + damping);
  std::vector<double> errors;
  for (const double step : {1.0 / 480, 1.0 / 960, 1.0 / 1920}) {
    StageDescription description =
        arm(Drive::free(), Drive::free(), {.hz = 3, .zeta = zeta, .frame = Drive::Frame::parent});
    description.step = step;
    description.world.gravity = {0, 0, 0};
    description.nodes[1].body->twist.angular = {0, 0, spin};
    description.nodes[1].body->angular_damping = 0;
    Stage stage(description);
    stage.advance_to(4);
    const Vec3 arm = stage.world(1).motion.pose.rotation.conjugate() * Vec3(place(stage, 2) - place(stage, 1));
    errors.push_back(std::abs(std::complex<double>(arm.x(), arm.y()) - expected));
  }
  CHECK(errors.back() < 2e-3);
  CHECK(errors[0] / errors[1] == doctest::Approx(2).epsilon(0.15));
  CHECK(errors[1] / errors[2] == doctest::Approx(2).epsilon(0.15));
}

TEST_CASE("a path of its own goes on within what carries it") {
  StageDescription description = arm(Drive::free(), Drive::free(), carried(Drive::Frame::parent, 400));
  description.world.gravity = {0, 0, 0};
  description.nodes[1].body->twist = {{0, 0, 3}, {0, 0, 0}};
  Clip clip{.name = "wave", .duration = std::numeric_limits<double>::infinity()};
  clip.tracks = {{"hand", "position",
                  parametric(oscillator({.amplitude = 0.2, .hz = 0.5}), Curve<double>(0.0), Curve<double>(0.0))}};
  description.clips = {clip};
  description.plays = {{.clip = 0}};
  Stage stage(description);
  stage.advance_to(1.3);
  const Vec3 expected(0.2 * std::cos(2 * pi * 0.5 * 1.3), 0, 0);
  CHECK(near(place(stage, 2) - place(stage, 1), expected, 1e-4));
}

TEST_CASE("an error is counted from where the path is carried to") {
  for (const Drive::Frame frame : {Drive::Frame::parent, Drive::Frame::world}) {
    StageDescription description = arm(Drive::free(), Drive::free(), carried(frame));
    description.nodes[2].body->drive->max_force = 0.5;
    Rule rule = release_at(0, "hand");
    rule.when.triggers = {when::Error{0.1}};
    description.rules = {rule};
    Stage stage(description);
    stage.advance_to(1);
    CHECK(stage.handoffs().empty() == (frame == Drive::Frame::parent));
  }
}
