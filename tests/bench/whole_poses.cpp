// One exact sample of all joints of the crowd clip, value and rate, and the conversion from local to world; and the
// memory of the clip. The counters give nanoseconds per joint and bytes per clip.

#include "crowd_clip.h"

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <map>
#include <utility>

namespace {

using namespace tweenfall;
using tweenfall::bench::CrowdFigure;
using tweenfall::bench::unit_hash;

enum class Order { forward, random };
enum class Keys { smooth, linear };

std::size_t allocated() {
  return mallinfo2().uordblks;
}

struct Figure {
  Animation animation;
  std::size_t bytes;  // of the clip and what binds it
};

const Figure& figure(std::uint32_t joints, Keys keys) {
  static std::map<std::pair<std::uint32_t, Keys>, Figure> made;
  const auto known = made.find({joints, keys});
  if (known != made.end()) return known->second;
  const auto nodes = CrowdFigure::nodes(joints);
  const std::size_t before = allocated();
  Animation animation(nodes, {CrowdFigure::clip(joints, keys == Keys::smooth ? Ease::smooth() : Ease::linear())},
                      {{.clip = 0}});
  const std::size_t bytes = allocated() - before;
  return made.emplace(std::pair(joints, keys), Figure{std::move(animation), bytes}).first->second;
}

// A thousand figures, each at its own place in the clip and with its own pose.
struct Crowd {
  static constexpr std::uint32_t size = 1000;
  std::vector<double> times;
  std::vector<Motion> poses;
  std::uint32_t draws = 0;

  explicit Crowd(std::uint32_t joints) : poses(std::size_t{size} * joints) {
    for (std::uint32_t i = 0; i < size; ++i) times.push_back(CrowdFigure::duration * unit_hash(i));
  }
  void move(Order order) {
    for (double& time : times)
      time = order == Order::forward ? time + 1 / 60.0 : CrowdFigure::duration * unit_hash(++draws);
  }
};

void tell(benchmark::State& state, std::uint32_t joints) {
  state.counters["joint"] = benchmark::Counter(static_cast<double>(state.iterations()) * joints,
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void one_figure(benchmark::State& state, Order order, Keys keys) {
  const auto joints = static_cast<std::uint32_t>(state.range(0));
  const Figure& figure_of_joints = figure(joints, keys);
  std::vector<Motion> pose(joints);
  std::uint32_t frame = 0;
  for (auto _ : state) {
    ++frame;
    figure_of_joints.animation.sample(order == Order::forward ? frame / 60.0 : CrowdFigure::duration * unit_hash(frame),
                                      pose);
    benchmark::DoNotOptimize(pose.data());
    benchmark::ClobberMemory();
  }
  tell(state, joints);
  state.counters["bytes"] = static_cast<double>(figure_of_joints.bytes);
}

void crowd_of_thousand(benchmark::State& state, Order order, Keys keys) {
  const auto joints = static_cast<std::uint32_t>(state.range(0));
  const Figure& figure_of_joints = figure(joints, keys);
  Crowd crowd(joints);
  for (auto _ : state) {
    crowd.move(order);
    for (std::size_t i = 0; i < Crowd::size; ++i)
      figure_of_joints.animation.sample(crowd.times[i], std::span(crowd.poses).subspan(i * joints, joints));
    benchmark::DoNotOptimize(crowd.poses.data());
    benchmark::ClobberMemory();
  }
  tell(state, joints * Crowd::size);
  state.counters["bytes"] = static_cast<double>(figure_of_joints.bytes);
}

// For every joint the result of `way`: matrices and their rates, as drawing needs them; or with the rotation, angular
// velocity and scale of the chain.
template <class World>
void local_to_world(benchmark::State& state, void (Hierarchy::*way)(std::span<const Motion>, std::span<World>) const) {
  const auto joints = static_cast<std::uint32_t>(state.range(0));
  const Figure& crowd = figure(joints, Keys::linear);
  std::vector<Motion> local(joints);
  std::vector<World> world(joints);
  crowd.animation.sample(3.21, local);
  for (auto _ : state) {
    (crowd.animation.nodes().*way)(local, world);
    benchmark::DoNotOptimize(world.data());
    benchmark::ClobberMemory();
  }
  tell(state, joints);
}

BENCHMARK_CAPTURE(crowd_of_thousand, linear_forward, Order::forward, Keys::linear)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(crowd_of_thousand, linear_random, Order::random, Keys::linear)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(crowd_of_thousand, smooth_forward, Order::forward, Keys::smooth)->Arg(67);
BENCHMARK_CAPTURE(crowd_of_thousand, smooth_random, Order::random, Keys::smooth)->Arg(67);
BENCHMARK_CAPTURE(one_figure, linear_forward, Order::forward, Keys::linear)->Arg(67);
BENCHMARK_CAPTURE(one_figure, linear_random, Order::random, Keys::linear)->Arg(67);
BENCHMARK_CAPTURE(one_figure, smooth_forward, Order::forward, Keys::smooth)->Arg(67);
BENCHMARK_CAPTURE(one_figure, smooth_random, Order::random, Keys::smooth)->Arg(67);
BENCHMARK_CAPTURE(local_to_world, frames, &Hierarchy::world_frames)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(local_to_world, motions, &Hierarchy::world_motions)->Arg(20)->Arg(67)->Arg(200);

}  // namespace
