// Weights by keys change between their first key and their last one only: before and after, nothing waits for them.

#include "figure_support.h"

#include <tweenfall/anim/graph_player.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A walk at 1 m/s and a run at 2 m/s, by the weight of the run; the hips accumulate the way.
std::shared_ptr<const Graph> faster(const GraphNumber& weight, bool in_phase, bool by_parameter) {
  std::vector<Clip> clips;
  for (const double duration : {1.25, 0.75}) {
    const bool walk = clips.empty();
    Clip& clip = clips.emplace_back(
        Clip{.name = walk ? "walk" : "run", .duration = duration, .loop = {.mode = LoopMode::repeat}});
    const double way = (walk ? 1 : 2) * duration;
    clip.tracks.push_back(
        {"hips", "position",
         keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = duration, .value = {0, 1, way}}})});
  }
  GraphDescription described;
  GraphNumber by = weight;
  if (by_parameter) {
    described.parameters = {{.name = "run", .curve = std::get<Curve<double>>(weight)}};
    by = ByParameter{"run"};
  }
  if (in_phase)
    described.poses = {{"gait", SpacePose{.by = {by}, .entries = {{"walk", {0, 0}}, {"run", {1, 0}}}, .sync = ""}}};
  else
    described.poses = {{"gait", LayersPose{.base = "walk", .layers = {{.pose = "run", .weight = by}}}}};
  described.poses.push_back({"way", RootMotionPose{.base = "gait", .node = "hips", .accumulates = true}});
  return std::make_shared<const Graph>(figures(), std::make_shared<const std::vector<Clip>>(clips), described);
}

double way_at(GraphPlayer& player, double time) {
  return shown(player, time)[0].pose.position.z();
}

}  // namespace

TEST_CASE("a way by weights with keys goes on steadily before the first and after the last, a million seconds far") {
  for (const bool by_parameter : {false, true})
    for (const double first : {1.0, 1e6}) {
      CAPTURE(first);
      const auto keys = keyed_curve<double>({{.time = first, .value = 0}, {.time = first + 1, .value = 1}});
      GraphPlayer player(faster(keys, false, by_parameter));
      // The speed is 1 m/s, then grows evenly to 2 m/s.
      for (const double time : {0.3, 0.999, first, first + 0.5, first + 1, first + 1.7, first + 1e6, first + 2.5}) {
        CAPTURE(time);
        const double in = std::clamp(time - first, 0.0, 1.0), past = std::max(0.0, time - first - 1);
        const double expected = std::min(time, first) + in + in * in / 2 + 2 * past;
        CHECK(std::abs(way_at(player, time) - expected) <= 1e-9 * std::max(1.0, expected));
        const double speed = shown(player, time)[0].twist.linear.z();
        CHECK(std::abs(speed - (1 + in)) <= 1e-9);
      }
    }
}

TEST_CASE("clips in phase by a weight with keys run as one of them before the first and after the last") {
  for (const bool by_parameter : {false, true})
    for (const double first : {1.0, 1e6}) {
      CAPTURE(first);
      const auto keys = keyed_curve<double>({{.time = first, .value = 0}, {.time = first + 1, .value = 1}});
      GraphPlayer player(faster(keys, true, by_parameter));
      CHECK(std::abs(way_at(player, first - 0.25) - (first - 0.25)) <= 1e-9 * first);
      const double there = way_at(player, first + 1);
      CHECK(there - first > 1);
      CHECK(there - first < 2);
      for (const double later : {0.5, 7.3, 1e5, 1e6}) {
        CAPTURE(later);
        CHECK(std::abs(way_at(player, first + 1 + later) - there - 2 * later) <= 1e-2 / 480 + 1e-9 * (first + later));
      }
      // Played through to the same bits.
      GraphPlayer frames(faster(keys, true, by_parameter));
      const double from = std::max(0.0, first - 1);
      for (int frame = 0; frame <= 240; ++frame) static_cast<void>(way_at(frames, from + frame / 60.0));
      GraphPlayer fresh(faster(keys, true, by_parameter));
      CHECK(way_at(frames, from + 4) == way_at(fresh, from + 4));
    }
}

TEST_CASE("weights whose keys come around are still followed after hours") {
  const auto keys =
      keyed_curve<double>({{.time = 0, .value = 0.2}, {.time = 1, .value = 0.8}, {.time = 2, .value = 0.2}})
          .with_outside(Outside::hold, Outside::repeat);
  GraphPlayer player(faster(keys, true, false));
  const double way = way_at(player, 20'000);
  CHECK(std::isfinite(way));
  CHECK(way > 20'000);
  CHECK(way < 40'000);
}
