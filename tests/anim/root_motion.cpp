#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/root_motion.h>
#include <tweenfall/curves/keys.h>

#include "anim/moving_pose.h"
#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr std::size_t rooted_joints = 4;

Hierarchy rooted_figure() {
  Random random(5);
  std::vector<Node> nodes{{"Armature"}, {"hips", 0}, {"spine", 1}, {"arm", 2}};
  for (Node& node : nodes) {
    node.rest.position = random.vector(1);
    node.rest.rotation = random.rotation();
  }
  nodes[0].rest.scale = {0.01, 0.01, 0.01};
  return Hierarchy(nodes);
}

// Uniform scales above the node that carries the figure.
std::vector<Motion> rooted_pose(std::uint64_t seed, double t) {
  std::vector<Motion> pose = moving_pose(seed, rooted_joints, t);
  pose[0].pose.scale = Vec3(1, 1, 1) * (1 + 0.3 * t);
  pose[0].scale_rate = {0.3, 0.3, 0.3};
  return pose;
}

Motion composed_to_hips(std::span<const Motion> pose) {
  return compose(pose[0], pose[1]);
}

std::vector<RootParts> all_parts() {
  std::vector<RootParts> all;
  for (const bool horizontal : {false, true})
    for (const bool vertical : {false, true})
      for (const auto turn : {RootParts::Turn::none, RootParts::Turn::yaw, RootParts::Turn::all})
        for (const Vec3& up : {Vec3(0, 1, 0), Vec3(0, 0, 2), Vec3(0.3, 0.4, -1)})
          if (horizontal || vertical || turn != RootParts::Turn::none) all.push_back({horizontal, vertical, turn, up});
  return all;
}

Motion going(const Pose& pose, const Vec3& linear = {0, 0, 0}, const Vec3& angular = {0, 0, 0}) {
  Motion motion;
  motion.pose = pose;
  motion.twist = {linear, angular};
  return motion;
}

// A figure that moves along a screw: exp(t (turn, way)), by the closed form of its pose.
Motion on_screw(const Vec3& turn, const Vec3& way, double t) {
  Pose pose;
  pose.rotation = exp_map(t * turn);
  pose.position = right_jacobian(-t * turn) * Vec3(t * way);
  return going(pose, pose.rotation * way, turn);
}

bool near_pose(const Pose& a, const Pose& b, double tolerance) {
  return near(a.position, b.position, tolerance) && near(a.rotation, b.rotation, tolerance);
}

}  // namespace

TEST_CASE("what was taken out of a pose, put back, makes the pose that it was, rates too") {
  for (const RootParts& parts : all_parts())
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const RootMotion root(rooted_figure(), "hips", parts);
      const auto original = rooted_pose(seed, 0.2);
      auto pose = original;
      const Motion frame = root.take_out(pose);
      CHECK(near(compose(frame, composed_to_hips(pose)), composed_to_hips(original), 1e-12));
      root.put_back(pose, frame);
      for (std::size_t i = 0; i < rooted_joints; ++i) CHECK(near(pose[i], original[i], 1e-12));
    }
}

TEST_CASE("the rates of what carries the figure, and of what is left in place, are derivatives") {
  for (const RootParts& parts : all_parts()) {
    const RootMotion root(rooted_figure(), "hips", parts);
    check_rates([&](double t) { return root.carried(rooted_pose(2, t)); }, 0.1);
    check_rates(
        [&](double t) {
          auto pose = rooted_pose(2, t);
          root.take_out(pose);
          return pose[1];
        },
        0.1, 2e-9);
  }
}

TEST_CASE("a figure at rest carries nothing, and in place it neither goes over the ground nor turns about up") {
  const Hierarchy nodes = rooted_figure();
  for (const RootParts& parts : all_parts()) {
    std::vector<Motion> rest(rooted_joints);
    for (std::size_t i = 0; i < rooted_joints; ++i) rest[i].pose = nodes[i].rest;
    const RootMotion root(nodes, "hips", parts);
    CHECK(near_pose(root.carried(rest).pose, Pose{}, 1e-14));
  }
  const RootMotion root(nodes, "hips");
  auto pose = rooted_pose(3, 0.4);
  const Motion frame = root.take_out(pose), left = composed_to_hips(pose);
  CHECK(frame.pose.position[1] == 0);
  CHECK(frame.twist.angular[0] == 0);
  CHECK(near(left.twist.linear[0], 0, 1e-12));
  CHECK(near(left.twist.linear[2], 0, 1e-12));
  const Motion again = root.carried(pose);
  CHECK(near(again, Motion{}, 1e-12));
}

TEST_CASE("yaw is the part of a turn about up: of a turn about up all of it, of one about a level axis none") {
  const Hierarchy nodes({{"hips", no_node, {.position = {0, 1, 0}}}});
  const RootMotion root(nodes, "hips");
  for (const double angle : {0.3, -2.0, 3.1}) {
    std::vector<Motion> pose(1);
    pose[0].pose.rotation = exp_map({0, angle, 0}) * exp_map({0.5, 0, 0.7});
    pose[0].twist.angular = {0, 2, 0};
    CHECK(near(root.carried(pose).pose.rotation, exp_map({0, angle, 0}), 1e-14));
    CHECK(near(root.carried(pose).twist.angular, Vec3(0, 2, 0), 1e-14));
  }
  std::vector<Motion> over(1);
  over[0].pose.rotation = {0, 1, 0, 0};
  over[0].twist.angular = {1, 2, 3};
  CHECK(root.carried(over).pose.rotation.w() == 1);
}

TEST_CASE("a rigid movement repeated is the movement composed with itself, forwards and backwards") {
  Random random(21);
  for (int round = 0; round < 20; ++round) {
    const double size = round % 4 == 0 ? 1e-9 : round % 4 == 1 ? 3.1 : 1.0;
    const Vec3 turn = random.vector(size / 2), way = random.vector(2);
    const Pose once{.position = way, .rotation = exp_map(turn)};
    Pose product;
    for (int n = 0; n <= 12; ++n) {
      CHECK(near_pose(repeated(once, n), product, 1e-13));
      CHECK(near_pose(repeated(once, -n), undone(product), 1e-13));
      product = compose(product, once);
    }
  }
  CHECK(repeated({.position = {1, 2, 3}}, 7).position == Vec3(7, 14, 21));
  const Pose half{.position = {1, 0, 0}, .rotation = {0, 0, 1, 0}};
  CHECK(near_pose(repeated(half, 2), Pose{}, 1e-15));
}

TEST_CASE("ten thousand loops of a circle end where they began, and of a straight walk where its length says") {
  // A hundred loops go once around a circle of 2 m.
  const double angle = 2 * pi / 100;
  const Pose first{.position = {3, 0, 1}, .rotation = exp_map({0, 0.7, 0})};
  const Pose once{.position = Vec3(2 * std::sin(angle), 0, -2 * (1 - std::cos(angle))),
                  .rotation = exp_map({0, angle, 0})};
  const RootTravel circle(first, compose(first, once));
  const Motion frame = going(compose(first, Pose{.position = {0.1, 0, 0}}), {1, 0, 0}, {0, 0.5, 0});
  const Motion start = circle.at(frame, 0), end = circle.at(frame, 10000);
  CHECK(near(end, start, 1e-11));
  CHECK(near_pose(circle.at(frame, 25).pose, compose(repeated(once, 25), start.pose), 1e-12));

  const RootTravel straight({}, {.position = {1.7, 0, 0.3}});
  CHECK(near(straight.at({}, 10000).pose.position, Vec3(17000, 0, 3000), 1e-15));
  // A step over the seam is then as exact as at first.
  const Motion step = circle.step(going(first).pose, 9999, frame, 10001), same = circle.step(first, 0, frame, 2);
  CHECK(near(step, same, 1e-15));
  CHECK(near_pose(step.pose, compose(compose(once, once), start.pose), 1e-14));
}

TEST_CASE("the travel of a clip goes on without a jump from loop to loop, and steps add up to it") {
  Clip clip{.name = "walk", .duration = 1.5};
  clip.tracks.push_back({"hips", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = Vec3(0.2, 1, 0), .ease = Ease::smooth()},
                                            {.time = 0.7, .value = Vec3(0.6, 1.1, 0.1), .ease = Ease::smooth()},
                                            {.time = 1.5, .value = Vec3(1.3, 1, 0.4)}})});
  clip.tracks.push_back({"hips", "rotation",
                         keyed_curve<Quat>({{.time = 0, .value = exp_map({0, 0.2, 0}), .ease = Ease::smooth()},
                                            {.time = 1.5, .value = exp_map({0, 1.1, 0})}})});
  const auto nodes = std::make_shared<const Hierarchy>(
      std::vector<Node>{{"hips", no_node, {.position = {0, 1, 0}}}, {"head", 0, {.position = {0, 0.6, 0}}}});
  const RootMotion root(*nodes, "hips");
  const RootTravel travel = root_travel(root, nodes, clip);
  CHECK(near(travel.loop().rotation, exp_map({0, 0.9, 0}), 1e-14));
  CHECK(near(travel.loop().position, Vec3(exp_map({0, -0.2, 0}) * Vec3(1.1, 0, 0.4)), 1e-14));

  const Animation animation(nodes, {clip}, {Play{}});
  const auto frame_at = [&](double t, Side side = Side::out) {
    std::vector<Motion> pose(2);
    animation.sample(t, pose, side);
    return root.carried(pose);
  };
  for (const double cycle : {0.0, 3.0, 9999.0})
    CHECK(near_pose(travel.at(frame_at(1.5, Side::in), cycle).pose, travel.at(frame_at(0), cycle + 1).pose, 1e-11));
  // At 24 frames per second through three loops.
  Pose sum;
  Motion before = frame_at(0);
  double cycle = 0, t = 0;
  for (int k = 0; k < 100; ++k) {
    t += 1.0 / 24;
    const double loops = std::floor(t / 1.5);
    const Motion now = frame_at(t - loops * 1.5);
    sum = compose(sum, travel.step(before.pose, cycle, now, loops).pose);
    cycle = loops;
    before = now;
  }
  CHECK(near_pose(sum, travel.at(before, cycle).pose, 1e-13));
  CHECK_THROWS_AS((void)root_travel(root, nodes, Clip{.name = "endless", .duration = 1.0 / 0.0}),
                  std::invalid_argument);
}

TEST_CASE("blended steps of figures on arcs go on the arc between, by frames of any length, with its rates") {
  const Vec3 turns[]{{0, 1.2, 0}, {0, -0.3, 0.1}, {0.2, 0, 0}}, ways[]{{2, 0, 0}, {1, 0, 0.5}, {0, 0.2, -1}};
  const double shares[]{0.5, 0.3, 0.2};
  Vec3 turn(0, 0, 0), way(0, 0, 0);
  std::vector<Sample<double>> weights;
  for (int i = 0; i < 3; ++i) {
    turn += shares[i] * turns[i];
    way += shares[i] * ways[i];
    weights.push_back({3 * shares[i], 0.7, 0});
  }
  const Motion expected = on_screw(turn, way, 2);
  for (const int frames : {4, 60, 288}) {
    Motion sum;
    for (int k = 0; k < frames; ++k) {
      std::vector<Motion> steps;
      for (int i = 0; i < 3; ++i) steps.push_back(on_screw(turns[i], ways[i], 2.0 / frames));
      sum = compose(going(sum.pose), blend_steps(steps, weights));
    }
    CHECK(near(sum, expected, 1e-12));
  }
}

TEST_CASE("a step that has all the weight is itself bit for bit, and without weights there is none") {
  const std::vector<Motion> steps{on_screw({0, 1, 0}, {1, 0, 0}, 0.1), on_screw({0, -1, 0}, {2, 0, 0}, 0.1)};
  const std::vector<Sample<double>> second{{0, 1, 0}, {0.3, -1, 0}}, none{{0, 0, 0}, {-1, 0, 0}};
  CHECK(same_bits(blend_steps(steps, second), steps[1]));
  CHECK(same_bits(blend_steps(steps, none), Motion{}));
}

TEST_CASE("an anchored way stands where it is to stand") {
  const Pose place{.position = {7, 0, -2}, .rotation = exp_map({0, 1, 0})},
      travelled{.position = {1, 0, 3}, .rotation = exp_map({0, -0.4, 0})};
  CHECK(near_pose(compose(anchor(place, travelled), travelled), place, 1e-15));
}

TEST_CASE("all that keeps root motion from being taken out is listed") {
  CHECK_THROWS_WITH_AS(RootMotion(rooted_figure(), "hps", {false, false, RootParts::Turn::none, {0, 0, 0}}),
                       "root motion cannot be taken out:\n"
                       "  no joint is named \"hps\"; did you mean \"hips\"?\n"
                       "  there is nothing to take out: no movement over the ground or up and down, and no turn\n"
                       "  the direction up must have a length, and be finite",
                       std::invalid_argument);
}

TEST_CASE("root motion asks for no memory") {
  const RootMotion root(rooted_figure(), "hips");
  auto pose = rooted_pose(1, 0);
  const std::vector<Motion> steps{on_screw({0, 1, 0}, {1, 0, 0}, 0.1), on_screw({0, -1, 0}, {2, 0, 0}, 0.1)};
  const std::vector<Sample<double>> weights{{0.4, 1, 0}, {0.3, -1, 0}};
  const std::size_t before = allocations();
  const Motion frame = root.take_out(pose);
  root.put_back(pose, frame);
  const RootTravel travel(frame.pose, compose(frame.pose, steps[0].pose));
  const Motion step = blend_steps(steps, weights), there = travel.at(step, 3);
  CHECK(allocations() == before);
  CHECK(there.pose.scale == Vec3(1, 1, 1));
}
