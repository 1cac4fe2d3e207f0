// Springs over springs, and far from their beginning: they see nothing of what is to come, and look for each jump once.

#include "figure_support.h"

#include <tweenfall/anim/marker_sync.h>

#include <array>
#include <cmath>
#include <optional>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A tail that swings behind hips on springs, over a base that jumps by a parameter.
GraphDescription hips_and_tail() {
  return {.parameters = {{.name = "jump"}},
          .poses = {{"mix", BlendPose{{{"walk", ByParameter{"jump"}}, {"idle", 0.5}}}},
                    {"hips", SpringPose{.base = "mix",
                                        .node = "hips",
                                        .position = SpringSettings{.hz = 3, .damping = 0.3, .gravity = {0, -3, 0}},
                                        .rotation = SpringSettings{.hz = 2, .damping = 0.2, .steps_per_second = 90}}},
                    {"tail", JigglePose{.base = "hips",
                                        .joints = {"tail 1", "tail 2", "tail 3", "tail 4"},
                                        .spring = {.hz = 2, .damping = 0.2, .gravity = {0, -5, 0}}}}}};
}

/// A walk and a run with steps, whose loops begin anew somewhere else, in phase while the weight glides.
std::shared_ptr<const Graph> gliding_in_phase() {
  std::vector<Clip> clips;
  for (const double duration : {0.9017, 1.3}) {
    const bool walk = clips.empty();
    Clip& clip = clips.emplace_back(Clip{.name = walk ? "walk" : "run", .duration = duration});
    clip.events = {{.from = 0.1 * duration, .to = 0.1 * duration, .name = "left", .data = {}},
                   {.from = 0.7 * duration, .to = 0.7 * duration, .name = "right", .data = {}}};
    clip.tracks.push_back(
        {"hips", "position",
         keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = duration, .value = {walk ? 0.3 : 0.5, 1, 0}}})});
  }
  const auto weight = keyed_curve<double>({{.time = 0, .value = 0.1}, {.time = 40, .value = 0.9}});
  return std::make_shared<const Graph>(
      figures(), std::make_shared<const std::vector<Clip>>(clips),
      GraphDescription{
          .poses = {{"gait", SpacePose{.by = {weight}, .entries = {{"walk", {0, 0}}, {"run", {1, 0}}}, .sync = "*"}},
                    {"hips", SpringPose{.base = "gait", .node = "hips", .position = SpringSettings{}}}}});
}

}  // namespace

TEST_CASE("springs over springs see nothing of what is to come") {
  for (const double instant : {0.4031, 0.9, 1.307}) {
    GraphDescription given = hips_and_tail();
    given.inputs = {{instant, "jump", 0.8}};
    GraphPlayer without(figure_graph(hips_and_tail())), with(figure_graph(given)), loaded(figure_graph(given));
    with.seek(3);
    for (const double before : {0.1, 0.02, 0.01, 0.003, 1e-7}) {
      CAPTURE(instant);
      CAPTURE(before);
      const std::vector<Motion> expected = shown(without, instant - before);
      // Whether later times were looked at before or not.
      CHECK(same_bits(shown(with, instant - before), expected));
      const std::vector<Motion> later = shown(with, instant + 0.3);
      CHECK(same_bits(shown(with, instant - before), expected));
      CHECK(same_bits(shown(with, instant + 0.3), later));
      GraphPlayer fresh(figure_graph(given));
      CHECK(same_bits(shown(fresh, instant + 0.3), later));
    }
    // The velocity is the derivative up to there.
    const std::vector<Motion> arriving = shown(with, instant, Side::in);
    for (const std::size_t node : {std::size_t{0}, std::size_t{10}, std::size_t{12}}) {
      CAPTURE(node);
      const double h = 1e-6;
      const Motion in = world_of_node(*figures(), node, arriving).motion;
      const Motion before = world_of_node(*figures(), node, shown(with, instant - h)).motion;
      CHECK(near(Vec3((in.pose.position - before.pose.position) / h), in.twist.linear, 1e-3));
    }
  }
}

TEST_CASE("springs look for each jump of what lies below once, however many frames are shown after an instant") {
  double searched = 0;
  const GraphGround ground{.next_jump = [&](double since, double after, double until) {
    CHECK(since <= after);
    searched += std::max(0.0, until - after);
    return std::optional<double>();
  }};
  GraphDescription described = hips_and_tail();
  described.output = "hips";
  GraphPlayer player(figure_graph(described), ground);
  for (int frame = 0; frame <= 1200; ++frame) {
    player.seek(frame / 60.0);
    static_cast<void>(shown(player, player.time()));
  }
  // Each frame looks two steps ahead of it.
  CHECK(searched < 1.2 * 20);
}

TEST_CASE(
    "a spring over clips in phase, whose weight glides, meets their jumps at the same instants however it is asked") {
  const auto graph = gliding_in_phase();
  GraphPlayer all(graph), forwards(graph);
  const std::vector<Motion> last = shown(all, 12.0);
  for (int frame = 0; frame < 12 * 57; ++frame) static_cast<void>(shown(forwards, frame / 57.0));
  CHECK(same_bits(shown(forwards, 12.0), last));
  for (const double time : {11.99, 3.7, 0.9, 0.91, 7.123, 0.0, 12.0}) {
    CAPTURE(time);
    GraphPlayer fresh(graph);
    const std::vector<Motion> expected = shown(fresh, time);
    CHECK(same_bits(shown(forwards, time), expected));
    CHECK(same_bits(shown(all, time), expected));
  }
}

TEST_CASE("of jumps that follow each other too fast to tell apart, springs answer one in a millisecond") {
  std::size_t searches = 0;
  const GraphGround ground{.next_jump = [&](double, double after, double until) {
    ++searches;
    double count = std::floor(after * 1e6) + 1;
    if (!(count * 1e-6 > after)) count += 1;
    return count * 1e-6 <= until ? std::optional(count * 1e-6) : std::nullopt;
  }};
  GraphDescription described = hips_and_tail();
  described.output = "hips";
  GraphPlayer player(figure_graph(described), ground);
  const std::vector<Motion> there = shown(player, 1.0);
  CHECK(there[0].pose.position.allFinite());
  CHECK(searches < 100'000);
  // Still the same way, however it is looked at.
  GraphPlayer frames(figure_graph(described), ground);
  for (int frame = 0; frame < 77; ++frame) static_cast<void>(shown(frames, frame / 77.0));
  CHECK(same_bits(shown(frames, 1.0), there));
}

TEST_CASE("the rate of a phase alone has the bits of the running phase") {
  const MarkerSync sync({{.duration = 1.2, .markers = {{0.1, "left"}, {0.7, "right"}}},
                         {.duration = 0.7, .markers = {{0.05, "right"}, {0.45, "left"}}},
                         {.duration = 4}});
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    std::array<Sample<double>, 3> weights;
    std::array<double, 3> values{};
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = {random.between(-0.3, 1), random.between(-1, 1), 0};
      if (i % 7 == 0) weights[k].value = 0;
      values[k] = weights[k].value;
    }
    const double phase = random.between(-20, 20);
    CHECK(sync.rate(phase, values) == sync.running(phase, weights).rate);
  }
}
