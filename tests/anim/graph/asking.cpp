// Evaluating an animation that has graphs: from many threads, without memory allocation, at times that are NaN.

#include "curves/counted_allocations.h"
#include "graph_support.h"

#include <cmath>
#include <limits>
#include <thread>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Two graphs, one over the other: machines that settle and fade, clips in phase, springs.
std::vector<GraphDescription> two_graphs() {
  GraphDescription below{
      .name = "below",
      .parameters = {{.name = "speed", .half_life = 0.1}},
      .poses = {{"gait", SpacePose{.by = {ByParameter{"speed"}},
                                   .entries = {{"idle", {0, 0}}, {"walk", {1, 0}}},
                                   .sync = std::string()}},
                {"body",
                 MachinePose{
                     .start = "gait",
                     .states = {{"gait", "gait"}, {"jump", "jump"}},
                     .transitions = {{.to = "jump",
                                      .when = {{GraphCondition::Kind::time_in_state, {}, 1.1}},
                                      .change = {GraphChange::Kind::quintic, 0.3}},
                                     {{"jump"}, "gait", {{GraphCondition::Kind::clip_end}}, {.seconds = 0.25}}}}}},
      .output = "",
      .inputs = {{0.3, "speed", 0.8}, {2.2, "speed", 0.2}}};
  GraphDescription above{.name = "above",
                         .parameters = {},
                         .poses = {{"hat", SpringPose{.node = "upper", .position = SpringSettings{.hz = 3}}}},
                         .output = ""};
  return {below, above};
}

Animation two_graphs_over_a_play() {
  return Animation(limb(), *three_clips(), {Play{}}).with_graphs(two_graphs());
}

std::vector<Motion> sampled(const Animation& animation, double time, Side side = Side::out) {
  std::vector<Motion> local(animation.nodes().size());
  animation.sample(time, local, side);
  return local;
}

}  // namespace

TEST_CASE("threads that ask one animation at once get the bits that one alone gets") {
  Animation alone = two_graphs_over_a_play(), asked = two_graphs_over_a_play();
  for (Animation* each : {&alone, &asked}) *each = each->with_input("below", {1.7, "speed", 0.5});
  constexpr int times = 120;
  std::vector<std::vector<Motion>> expected;
  for (int i = 0; i < times; ++i) expected.push_back(sampled(alone, 0.05 * i));
  std::vector<int> wrong(12, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < times; ++i) {
        const int at = (i * (t % 2 == 0 ? 1 : 7) + static_cast<int>(5 * t)) % times;
        if (!same_bits(sampled(asked, 0.05 * at), expected[static_cast<std::size_t>(at)])) ++wrong[t];
      }
    });
  for (std::thread& each : threads) each.join();
  for (const int each : wrong) CHECK(each == 0);
}

TEST_CASE("a graph that was given away asks what lies below it on its own") {
  Animation animation = two_graphs_over_a_play();
  GraphPlayer player = animation.graph("above", 1.4);
  const std::vector<Motion> expected = sampled(animation, 1.4);
  animation = two_graphs_over_a_play().with_input("below", {1.0, "speed", 5});
  std::vector<Motion> local(player.graph().nodes().size());
  player.pose(local);
  CHECK(same_bits(local, expected));
  CHECK_FALSE(same_bits(sampled(animation, 1.4), expected));
}

TEST_CASE("asking frame by frame allocates nothing while machines stay where they are") {
  const Animation animation = two_graphs_over_a_play();
  std::vector<Motion> local(animation.nodes().size());
  double time = 2.4;
  for (int i = 0; i < 20; ++i) animation.sample(time += 1.0 / 60, local);
  const std::size_t before = allocations();
  for (int i = 0; i < 16; ++i) {
    animation.sample(time += 1.0 / 60, local);
    animation.sample(time, local, Side::in);
    local[0] = animation.sample_node(1, time);
  }
  CHECK(allocations() == before);
}

TEST_CASE("a time that is none is taken as the start") {
  const Animation animation = two_graphs_over_a_play();
  const std::vector<Motion> start = sampled(animation, 0);
  for (const double time : {-1., -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
    CHECK(same_bits(sampled(animation, time), start));
}
