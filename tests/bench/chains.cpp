// One solve of inverse kinematics, with rates: targets that move, in a figure whose poses differ.

#include "random.h"

#include <tweenfall/anim/joint_chain.h>
#include <tweenfall/anim/two_bone.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace tweenfall;

constexpr std::size_t solves = 256;

struct Legs {
  Hierarchy nodes{{{.name = "hip", .rest = {{0.3, 1, -0.2}}},
                   {.name = "thigh", .parent = 0, .rest = {{0.1, -0.1, 0}}},
                   {.name = "shin", .parent = 1, .rest = {{0, -0.5, 0}, Quat(0.96, 0.28, 0, 0)}},
                   {.name = "foot", .parent = 2, .rest = {{0, -0.4, 0}}}}};
  TwoBoneChain chain{nodes, {"thigh", "shin", "foot"}};
  std::vector<Motion> poses, out;
  std::vector<WorldMotion> hips;
  std::vector<TwoBoneGoal> goals;

  explicit Legs(bool pole) {
    test::Random random(1);
    for (std::size_t i = 0; i < solves; ++i) {
      for (std::size_t node = 0; node < 4; ++node) {
        Motion motion;
        motion.pose = nodes[node].rest;
        motion.pose.rotation = (Quat(1, 0, 0, 0).coeffs() + 0.3 * random.rotation().coeffs()).normalized();
        motion.twist.angular = random.vector(1);
        poses.push_back(motion);
      }
      hips.push_back(child_of({}, poses[4 * i]));
      const Vec3 thigh = child_of(hips.back(), poses[4 * i + 1]).motion.pose.position;
      goals.push_back({.target = {thigh + random.vector(0.45), random.vector(1), {0, 0, 0}}});
      if (pole) goals.back().pole = Sample<Vec3>{random.vector(1), {0, 0, 0}, {0, 0, 0}};
    }
    out = poses;
  }
};

void two_bone(benchmark::State& state, bool pole) {
  Legs legs(pole);
  for (auto _ : state) {
    for (std::size_t i = 0; i < solves; ++i) {
      const std::span<Motion> pose = std::span(legs.out).subspan(4 * i, 4);
      reach(legs.chain, legs.goals[i], {1, 0, 0}, legs.hips[i], pose);
    }
    benchmark::DoNotOptimize(legs.out.data());
    benchmark::ClobberMemory();
  }
  state.counters["solve"] = benchmark::Counter(static_cast<double>(state.iterations()) * solves,
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Six joints to targets within reach, with or without a cone at each.
void joint_chain(benchmark::State& state, ChainMethod method, const JointLimit& limit) {
  Hierarchy nodes;
  JointChainSettings settings{.links = {}, .method = method};
  for (std::size_t i = 0; i < 7; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    if (i > 0) node.rest.position = {0, 0.3, 0};
    nodes.add(node);
    settings.links.push_back({i, i < 6 ? limit : JointLimit{}});
  }
  const JointChain chain(nodes, settings);
  std::vector<Motion> rest(7);
  for (std::size_t i = 0; i < 7; ++i) rest[i].pose = nodes[i].rest;
  std::vector<Sample<Vec3>> targets;
  test::Random random(2);
  for (std::size_t i = 0; i < solves; ++i) {
    const Vec3 place = Vec3(0, 1, 0) + random.vector(0.4), velocity = random.vector(1);
    targets.push_back({place, velocity, {0, 0, 0}});
  }
  for (auto _ : state) {
    for (const Sample<Vec3>& target : targets) {
      std::vector<Motion> pose = rest;
      reach(chain, target, {1, 0, 0}, pose);
      benchmark::DoNotOptimize(pose.data());
    }
  }
  state.counters["solve"] = benchmark::Counter(static_cast<double>(state.iterations()) * solves,
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(joint_chain, fabrik, ChainMethod::fabrik, JointLimit());
BENCHMARK_CAPTURE(joint_chain, ccd, ChainMethod::ccd, JointLimit());
BENCHMARK_CAPTURE(joint_chain, fabrik_in_cones, ChainMethod::fabrik, JointLimit(ConeLimit{0.7, -0.5, 0.5}));
BENCHMARK_CAPTURE(two_bone, with_pole, true);
BENCHMARK_CAPTURE(two_bone, without_pole, false);

}  // namespace
