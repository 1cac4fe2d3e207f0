// The step in which 2,000 bodies come back to a clip by one rule, beside the step before; and nodes that are added and
// removed one by one. The counters give milliseconds and megabytes of that step beyond an ordinary one, and
// microseconds per node.

#include <tweenfall/curves/keys.h>
#include <tweenfall/physics/stage/stage.h>

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <algorithm>
#include <ctime>
#include <string>

namespace {

using namespace tweenfall;

enum class Place { apart, on_floor };

// Balls three meters from each other, each on a track of its own and with two nodes without bodies below it. Released
// at 0.1 s they float, or rest on a floor; at 0.2 s a rule takes all of them back to the clip.
StageDescription released_and_taken_back(std::size_t count, Place place) {
  StageDescription stage;
  stage.world.gravity = place == Place::apart ? Vec3(0, 0, 0) : Vec3(0, -9.81, 0);
  Clip clip{.name = "wave", .duration = 10};
  clip.loop = {LoopMode::repeat, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "ball" + std::to_string(i);
    const std::size_t parent = stage.nodes.size();
    stage.nodes.push_back({.name = name, .body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0}});
    stage.nodes.push_back({.name = name + "/hat", .parent = parent, .rest = {.position = {0, 0.1, 0}}});
    stage.nodes.push_back({.name = name + "/feather", .parent = parent + 1, .rest = {.position = {0, 0.1, 0}}});
    const double x = 3.0 * static_cast<double>(i);
    clip.tracks.push_back({name, "position",
                           keyed_curve<Vec3>({{.time = 0, .value = Vec3(x, 0.1, 0)},
                                              {.time = 5, .value = Vec3(x, 0.1, 1)},
                                              {.time = 10, .value = Vec3(x, 0.1, 0)}})});
  }
  if (place == Place::on_floor)
    stage.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
  stage.clips = {std::move(clip)};
  stage.plays = {{.clip = 0}};
  HandBack back;
  back.clip = "wave";
  back.clock = HandBack::Clock::restart;
  stage.rules = {{.bodies = {"ball*"}, .when = {{when::At{0.1}}}},
                 {.bodies = {"ball*"}, .when = {{when::At{0.2}}}, .to = Drive::keyed(), .hand_back = back}};
  return stage;
}

struct Cost {
  double seconds = 0, bytes = 0;
};

/// Processor time: other programs on the machine do not count.
template <class Work>
Cost cost_of(const Work& work) {
  const std::size_t before = mallinfo2().uordblks;
  const std::clock_t start = std::clock();
  work();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {seconds, static_cast<double>(mallinfo2().uordblks) - static_cast<double>(before)};
}

void taken_back(benchmark::State& state, Place place) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const StageDescription description = released_and_taken_back(count, place);
  const double step = description.step;
  double least_before = 1e300, least = 1e300, least_after = 1e300, bytes = 0;
  for (auto _ : state) {
    Stage stage(description);
    stage.advance_to(0.2 - 2.5 * step);
    const Cost before = cost_of([&] { stage.advance(step); });
    const Cost back = cost_of([&] { stage.advance(step); });
    const Cost after = cost_of([&] { stage.advance(step); });
    if (stage.handoffs().size() != 2 * count) state.SkipWithError("not all were taken back");
    state.SetIterationTime(back.seconds);
    least_before = std::min(least_before, before.seconds);
    least = std::min(least, back.seconds);
    least_after = std::min(least_after, after.seconds);
    bytes = back.bytes - before.bytes;
  }
  state.counters["beyond_ms"] = 1e3 * (least - std::min(least_before, least_after));
  state.counters["beyond_MB"] = bytes / 1e6;
  state.counters["before_ms"] = 1e3 * least_before;
  state.counters["after_ms"] = 1e3 * least_after;
}

enum class Cast { plain, apart, on_floor };

// Each is a child of one of a hundred nodes; its position is read after half a step.
void come_and_go(benchmark::State& state, Cast cast) {
  const auto count = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    StageDescription description;
    for (int i = 0; i < 100; ++i) description.nodes.push_back({.name = "parent" + std::to_string(i)});
    if (cast == Cast::on_floor)
      description.nodes.push_back({.name = "floor", .body = BodyDescription{.shape = {Plane{}}, .fixed = true}});
    Stage stage(description);
    std::vector<NodeId> added;
    added.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      NodeDescription node{.name = "node" + std::to_string(i), .parent = i % 100};
      node.rest.position = Vec3(static_cast<double>(i), 0.1, 0);
      if (cast != Cast::plain) node.body = BodyDescription{.shape = {Sphere{0.1}}, .mass = 1.0};
      added.push_back(stage.add(node));
    }
    stage.advance(1.5 * stage.step());
    for (const NodeId node : added) benchmark::DoNotOptimize(stage.world(node));
    for (const NodeId node : added) stage.remove(node);
  }
  state.counters["node"] = benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)),
                                              benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(taken_back, apart, Place::apart)->Arg(500)->Arg(2000)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(taken_back, on_floor, Place::on_floor)
    ->Arg(500)
    ->Arg(2000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(come_and_go, plain, Cast::plain)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(come_and_go, apart, Cast::apart)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(come_and_go, on_floor, Cast::on_floor)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
