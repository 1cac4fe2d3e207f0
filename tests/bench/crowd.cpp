// The crowd clip by the crowd's own path: a thousand figures, each at its own place in the clip and with its own pose.
// The counters give nanoseconds per joint, vertex or figure, and bytes for the compiled clip.

#include "crowd_clip.h"

#include <tweenfall/anim/crowd.h>
#include <tweenfall/anim/crowd_kernels.h>
#include <tweenfall/anim/crowd_skin.h>

#include <benchmark/benchmark.h>

#include <array>
#include <map>

namespace {

using namespace tweenfall;
using tweenfall::bench::CrowdFigure;
using tweenfall::bench::unit_hash;

constexpr std::uint32_t crowd_size = 1000;

enum class Order { forward, random };

struct Compiled {
  CrowdClip clip;
  CrowdSkeleton skeleton;
};

const Compiled& compiled(std::uint32_t joints) {
  static std::map<std::uint32_t, Compiled> made;
  const auto known = made.find(joints);
  if (known != made.end()) return known->second;
  const auto nodes = CrowdFigure::nodes(joints);
  return made
      .emplace(joints, Compiled{compile(CrowdFigure::clip(joints, Ease::linear()), *nodes), CrowdSkeleton(*nodes)})
      .first->second;
}

/// As many poses per figure as are blended, and one for the result.
struct Crowd {
  const Compiled& of;
  std::size_t joints, groups;
  std::array<std::vector<CrowdGroup>, 5> poses;
  std::vector<CrowdMatrix> world;
  std::uint32_t draws = 0;
  std::uint32_t frame = 0;

  explicit Crowd(std::uint32_t size)
      : of(compiled(size)), joints(size), groups(of.clip.groups()), world(std::size_t{crowd_size} * size) {
    for (std::vector<CrowdGroup>& pose : poses) {
      pose.resize(groups * crowd_size);
      sample_all(pose, Order::random);
    }
  }
  std::span<CrowdGroup> pose(std::size_t which, std::size_t figure) {
    return std::span(poses[which]).subspan(figure * groups, groups);
  }
  double time(std::size_t figure, Order order) {
    if (order == Order::random) return CrowdFigure::duration * unit_hash(++draws);
    return CrowdFigure::duration * unit_hash(static_cast<std::uint32_t>(figure)) + frame / 60.0;
  }
  void sample(std::span<CrowdGroup> to, double stage_time) { of.clip.sample(of.clip.clock(0, 1, stage_time), to); }
  void sample_all(std::vector<CrowdGroup>& to, Order order) {
    for (std::size_t i = 0; i < crowd_size; ++i) sample(std::span(to).subspan(i * groups, groups), time(i, order));
  }
  void place(std::size_t which, std::size_t figure) {
    of.skeleton.local_to_world(pose(which, figure), std::span(world).subspan(figure * joints, joints));
  }
};

void tell(benchmark::State& state, const char* each, std::size_t many) {
  state.counters[each] = benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(many),
                                            benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void done(const Crowd& crowd) {
  benchmark::DoNotOptimize(crowd.poses.data());
  benchmark::DoNotOptimize(crowd.world.data());
  benchmark::ClobberMemory();
}

void sample(benchmark::State& state, Order order) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    ++crowd.frame;
    crowd.sample_all(crowd.poses[0], order);
    done(crowd);
  }
  tell(state, "joint", crowd.joints * crowd_size);
  state.counters["bytes"] = static_cast<double>(crowd.of.clip.byte_count());
}

void sample_many(benchmark::State& state, Order order) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  std::vector<ClipClock> clocks(crowd_size);
  for (auto _ : state) {
    ++crowd.frame;
    for (std::size_t i = 0; i < crowd_size; ++i) clocks[i] = crowd.of.clip.clock(0, 1, crowd.time(i, order));
    crowd.of.clip.sample(clocks, crowd.poses[0]);
    done(crowd);
  }
  tell(state, "joint", crowd.joints * crowd_size);
}

void blend_layers(benchmark::State& state, std::size_t layer_count) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  std::array<CrowdLayer, 4> layers;
  for (auto _ : state) {
    for (std::size_t i = 0; i < crowd_size; ++i) {
      for (std::size_t layer = 0; layer < layer_count; ++layer)
        layers[layer] = {.pose = crowd.pose(layer, i), .weight = 0.1F * static_cast<float>(layer + 1)};
      blend(std::span(layers).first(layer_count), crowd.pose(4, i));
    }
    done(crowd);
  }
  tell(state, "joint", crowd.joints * crowd_size);
}

void add_one(benchmark::State& state) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    for (std::size_t i = 0; i < crowd_size; ++i) add(crowd.pose(0, i), crowd.pose(1, i), 0.5F, crowd.pose(4, i));
    done(crowd);
  }
  tell(state, "joint", crowd.joints * crowd_size);
}

void local_to_world(benchmark::State& state) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    for (std::size_t i = 0; i < crowd_size; ++i) crowd.place(0, i);
    done(crowd);
  }
  tell(state, "joint", crowd.joints * crowd_size);
}

// Two samples, their blend, and the conversion to the world.
void whole_frame(benchmark::State& state) {
  Crowd crowd(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) {
    ++crowd.frame;
    for (std::size_t i = 0; i < crowd_size; ++i) {
      crowd.sample(crowd.pose(0, i), crowd.time(i, Order::forward));
      crowd.sample(crowd.pose(1, i), crowd.time(crowd_size - i, Order::forward));
      const CrowdLayer layers[] = {{crowd.pose(0, i), 0.4F}, {crowd.pose(1, i), 0.6F}};
      blend(layers, crowd.pose(4, i));
      crowd.place(4, i);
    }
    done(crowd);
  }
  tell(state, "figure", crowd_size);
}

void skin(benchmark::State& state) {
  const auto influences = static_cast<std::size_t>(state.range(0));
  constexpr std::uint32_t vertices = 10000, joints = 67;
  Mesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.positions.emplace_back(unit_hash(3 * i), unit_hash(3 * i + 1), unit_hash(3 * i + 2));
    mesh.normals.push_back(Vec3(unit_hash(5 * i), 1, unit_hash(5 * i + 1)).normalized());
    std::vector<Influence> of_vertex;
    for (std::size_t k = 0; k < influences; ++k)
      of_vertex.push_back({static_cast<std::uint32_t>((i / 100 + k) % joints), 1.0 / static_cast<double>(influences)});
    mesh.influences.add(of_vertex);
  }
  const CrowdMesh ready(mesh, joints);
  Crowd crowd(joints);
  crowd.place(0, 0);
  std::vector<CrowdPoint> positions(vertices), normals(vertices);
  for (auto _ : state) {
    ready.skin(std::span(crowd.world).first(joints), positions, normals);
    benchmark::DoNotOptimize(positions.data());
    benchmark::DoNotOptimize(normals.data());
    benchmark::ClobberMemory();
  }
  tell(state, "vertex", vertices);
}

BENCHMARK_CAPTURE(sample, forward, Order::forward)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(sample, random, Order::random)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(sample_many, forward, Order::forward)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(sample_many, random, Order::random)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(blend_layers, two, 2)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK_CAPTURE(blend_layers, four, 4)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK(add_one)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK(local_to_world)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK(whole_frame)->Arg(20)->Arg(67)->Arg(200);
BENCHMARK(skin)->Arg(4)->Arg(8);

}  // namespace
