#include "anim/chains/chain_support.h"

#include <tweenfall/anim/jiggle.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A tail of joints that hangs down from a root at the origin.
Hierarchy tail_of(std::size_t count, double bone = 0.5) {
  Hierarchy nodes;
  for (std::size_t i = 0; i < count; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    if (i > 0) node.rest.position = {0, -bone, 0};
    nodes.add(node);
  }
  return nodes;
}

struct Swinging {
  const JiggleChain& chain;
  PoseAt pose_at;

  [[nodiscard]] std::vector<Motion> at(JiggleState& state, double time,
                                       const Sample<double>& weight = {1, 0, 0}) const {
    std::vector<Motion> scratch(chain.scratch_size()), pose(chain.nodes().size());
    pose_at(time, pose);
    jiggle(chain, state, time, pose_at, weight, scratch, pose);
    return pose;
  }
};

PoseAt resting(const Hierarchy& nodes) {
  return [&nodes](double, std::span<Motion> pose) {
    for (std::size_t i = 0; i < pose.size(); ++i)
      pose[i] = Motion{.pose = nodes[i].rest, .twist = {}, .scale_rate = {0, 0, 0}};
  };
}

PoseAt swung(const SwingingPose& swing) {
  return [&swing](double t, std::span<Motion> pose) {
    for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = swing.nodes[i].at(t);
  };
}

}  // namespace

TEST_CASE("a jiggle chain at rest in a still script stays there, to the bit of the pose's own place") {
  const Hierarchy nodes = tail_of(4);
  const JiggleChain chain(nodes, {.joints = {0, 1, 2, 3}});
  const Swinging swinging_tail{chain, resting(nodes)};
  JiggleState state = chain.at_rest(0);
  CHECK(difference_of(swinging_tail.at(state, 3.21), rest_pose(nodes)) == 0);
}

TEST_CASE("a small swing of a jiggle chain has the frequency of its spring and of a pendulum together") {
  // x'' = -(w^2 + g/L) x for small x.
  const Hierarchy nodes = tail_of(2);
  for (const double hz : {0.0, 1.0}) {
    for (const double gravity : {0.0, 9.81}) {
      if (hz == 0 && gravity == 0) continue;
      CAPTURE(hz);
      CAPTURE(gravity);
      const JiggleChain chain(
          nodes,
          {.joints = {0, 1}, .spring = {.hz = hz, .damping = 0, .gravity = {0, -gravity, 0}, .steps_per_second = 500}});
      const Swinging swinging_tail{chain, resting(nodes)};
      JiggleState state = chain.at_rest(0);
      const double size = 1e-4;
      state.offsets[0] = {size, 0, 0};
      const double w = std::sqrt(4 * pi * pi * hz * hz + gravity / 0.5);
      for (double t = 0.1; t < 2; t += 0.1) {
        const std::vector<Motion> pose = swinging_tail.at(state, t);
        const WorldMotion tail = world_of_node(nodes, 1, pose);
        CHECK(std::abs(tail.motion.pose.position.x() - size * std::cos(w * t)) < 1e-4 * size);
        CHECK(std::abs(tail.motion.twist.linear.x() + w * size * std::sin(w * t)) < 1e-4 * w * size);
      }
    }
  }
}

TEST_CASE("a joint that only gravity and its bone hold swings far out and keeps its energy") {
  const Hierarchy nodes = tail_of(2);
  const JiggleChain chain(
      nodes, {.joints = {0, 1}, .spring = {.hz = 0, .damping = 0, .gravity = {0, -9.81, 0}, .steps_per_second = 240}});
  const Swinging swinging_tail{chain, resting(nodes)};
  JiggleState state = chain.at_rest(0);
  state.rates[0] = {3, 0, 1};
  for (double t = 0; t < 5; t += 0.1) {
    const WorldMotion tail = world_of_node(nodes, 1, swinging_tail.at(state, t));
    const double energy = 0.5 * tail.motion.twist.linear.squaredNorm() + 9.81 * (tail.motion.pose.position.y() + 0.5);
    CHECK(energy == doctest::Approx(5).epsilon(5e-3));
  }
}

TEST_CASE("bones of a jiggle chain keep their lengths, and it comes home") {
  Random random(1);
  const Hierarchy nodes = tail_of(5);
  const JiggleChain chain(nodes, {.joints = {0, 1, 2, 3, 4}, .spring = {.hz = 2, .damping = 0.3}});
  const Swinging swinging_tail{chain, resting(nodes)};
  JiggleState state = chain.at_rest(0);
  for (Vec3& rate : state.rates) rate = random.vector(5);
  double farthest = 0;
  for (double t = 0; t < 10; t += 0.05) {
    const std::vector<Motion> pose = swinging_tail.at(state, t);
    for (std::size_t i = 1; i < 5; ++i) {
      const double length =
          (world_of_node(nodes, i, pose).motion.pose.position - world_of_node(nodes, i - 1, pose).motion.pose.position)
              .norm();
      CHECK(length == doctest::Approx(0.5).epsilon(1e-12));
    }
    const double away = difference_of(pose, rest_pose(nodes));
    farthest = std::max(farthest, away);
    if (t > 9.9) CHECK(away < 1e-9);
  }
  CHECK(farthest > 0.1);
}

TEST_CASE("without a spring a jiggle chain hangs down in the end, wherever its script points") {
  Hierarchy nodes = straight_chain(4);  // upwards
  const JiggleChain chain(nodes,
                          {.joints = {0, 1, 2, 3}, .spring = {.hz = 0.2, .damping = 5, .gravity = {0.5, -300, 0}}});
  const Swinging swinging_tail{chain, resting(nodes)};
  JiggleState state = chain.at_rest(0);
  const std::vector<Motion> pose = swinging_tail.at(state, 60);
  CHECK(world_of_node(nodes, 3, pose).motion.pose.position.y() < -2.9);
}

TEST_CASE("a limited joint never swings farther than its limit, and is eased into it") {
  const Hierarchy nodes = tail_of(2);
  const JiggleChain chain(nodes, {.joints = {0, 1}, .spring = {.hz = 1, .damping = 0.05}, .limit = 0.6, .ease = 0.2});
  const Swinging swinging_tail{chain, resting(nodes)};
  JiggleState state = chain.at_rest(0);
  state.rates[0] = {4, 0, 0};
  double farthest = 0, last = 0;
  for (double t = 0; t < 3; t += 0.002) {
    const double angle = log_map(swinging_tail.at(state, t)[0].pose.rotation).z();
    CHECK(std::abs(angle) < 0.6);
    CHECK(std::abs(angle - last) < 0.03);
    farthest = std::max(farthest, std::abs(angle));
    last = angle;
  }
  CHECK(farthest > 0.5);
}

TEST_CASE("a jiggle chain is the same to the bit at common times of 30, 60 and 144 frames per second") {
  Random random(2);
  const Hierarchy nodes = tail_of(5);
  const SwingingPose swing(random, nodes, 0.1, 0.8);
  const JiggleChain chain(nodes,
                          {.joints = {1, 2, 4}, .tip = {0, -0.3, 0.1}, .spring = {.hz = 3, .gravity = {0, -9.81, 0}}});
  const Swinging swinging_tail{chain, swung(swing)};
  const auto shown = [&](double frame, double end) {
    JiggleState state = chain.at_rest(0);
    for (int i = 1; i * frame < end; ++i) (void)swinging_tail.at(state, i * frame);
    return swinging_tail.at(state, end);
  };
  for (const double end : {0.5, 2.0}) {
    const std::vector<Motion> slow = shown(1.0 / 30, end);
    CHECK(same_bits(slow, shown(1.0 / 60, end)));
    CHECK(same_bits(slow, shown(1.0 / 144, end)));
    CHECK(same_bits(slow, shown(10, end)));
  }
}

TEST_CASE("the rates of a jiggle chain are the derivatives of its rotations, at the points of its grid too") {
  Random random(3);
  const Hierarchy nodes = tail_of(6);
  const SwingingPose swing(random, nodes, 0.05, 0.5);
  for (const double limit : {pi, 0.3}) {
    const JiggleChain chain(nodes, {.joints = {0, 2, 3, 5},
                                    .spring = {.hz = 2, .gravity = {0, -9.81, 0}, .steps_per_second = 40},
                                    .limit = limit});
    const Swinging swinging_tail{chain, swung(swing)};
    for (const double t : {0.51, 1.0125, 1.49}) {
      JiggleState start = chain.at_rest(0);
      (void)swinging_tail.at(start, t - 0.005);
      const auto at = [&](double time) {
        JiggleState state = start;
        return swinging_tail.at(state, time, {0.5 + 0.2 * time, 0.2, 0});
      };
      CHECK(worst_rate(at, t, 5e-4) < 1e-8);
    }
    // At a point of the grid the rate is that of both sides.
    JiggleState start = chain.at_rest(0);
    (void)swinging_tail.at(start, 0.97);
    const auto at = [&](double time) {
      JiggleState state = start;
      return swinging_tail.at(state, time);
    };
    const std::vector<Motion> before = at(1 - 1e-9), after = at(1);
    for (std::size_t i = 0; i < nodes.size(); ++i) CHECK(near(before[i].twist.angular, after[i].twist.angular, 1e-6));
  }
}

TEST_CASE("the swing of a jiggle chain converges as its grid gets finer") {
  Random random(4);
  const Hierarchy nodes = tail_of(4);
  const SwingingPose swing(random, nodes, 0.1, 0.6);
  const auto end_at = [&](double steps) -> Vec3 {
    const JiggleChain chain(
        nodes, {.joints = {0, 1, 2, 3}, .spring = {.hz = 2, .gravity = {0, -9.81, 0}, .steps_per_second = steps}});
    JiggleState state = chain.at_rest(0);
    return world_of_node(nodes, 3, Swinging{chain, swung(swing)}.at(state, 1.5)).motion.pose.position;
  };
  const Vec3 finest = end_at(3840);
  const double coarse = (end_at(60) - finest).norm(), fine = (end_at(240) - finest).norm();
  CHECK(coarse < 2e-4);
  CHECK(fine < coarse / 3);
}

TEST_CASE("without weight a jiggle chain leaves the pose's bits and swings on; odd states are answered") {
  Random random(5);
  const Hierarchy nodes = tail_of(4);
  const SwingingPose swing(random, nodes, 0.1, 0.8);
  const JiggleChain chain(nodes, {.joints = {0, 1, 2, 3}});
  const Swinging swinging_tail{chain, swung(swing)};
  JiggleState state = chain.at_rest(0), shown = state;
  CHECK(same_bits(swinging_tail.at(state, 1.5, {0, 0, 0}), swing.at(1.5)));
  (void)swinging_tail.at(shown, 1.5);
  CHECK(state == shown);
  JiggleState empty;
  CHECK(finite(swinging_tail.at(empty, 2)));
  CHECK(empty.offsets.size() == 3);
  state.offsets[0] = {0, 0.5, 0};  // into the joint itself
  state.offsets[1] = {0, 1e6, 0};
  CHECK(finite(swinging_tail.at(state, 1.51)));
  CHECK(finite(swinging_tail.at(state, -1e300)));
}

TEST_CASE("what is wrong with a jiggle chain is told all at once") {
  const Hierarchy nodes = tail_of(4);
  CHECK_THROWS_WITH_AS(JiggleChain(nodes, {.joints = {1}}),
                       "jiggle chain: it has 1 joint; it needs two, or one and a tip", std::invalid_argument);
  CHECK_THROWS_WITH_AS(JiggleChain(nodes, {.joints = {2, 1, "tail"}, .spring = {.damping = -1}, .limit = 4}),
                       "jiggle chain: joint 2 (\"1\") must be below the joint before it (\"2\")\n"
                       "jiggle chain: joint 3 is \"tail\", and there is no such node\n"
                       "jiggle chain: each joint's spring: damping is -1; it must be from 0 to 100\n"
                       "jiggle chain: limit is 4; it must be from 0 to 3.141592653589793",
                       std::invalid_argument);
}
