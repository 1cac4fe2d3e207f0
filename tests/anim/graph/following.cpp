// Chains that follow their target in graphs: as alone, the same at every frame rate and in any order, and saved.

#include "figure_support.h"
#include "graph_support.h"

#include <tweenfall/anim/following_chain.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const JointLimit bend_of_tail = HingeLimit{{1, 0, 0}, -0.4, 1.2};

GraphDescription wagging(const GraphNumber& weight) {
  return {.parameters = {{.name = "x", .start = 0.1, .half_life = 0.1}},
          .poses = {{"walk", ClipPose{"walk"}},
                    {"tail", ReachPose{.base = "walk",
                                       .joints = {{"tail 1", ConeLimit{.swing = 0.8}},
                                                  {"tail 2", bend_of_tail},
                                                  {"tail 3", bend_of_tail},
                                                  {"tail 4"}},
                                       .target = {.at = {ByParameter{"x"}, 1.1, -0.5}},
                                       .leaps = true,
                                       .follows = true,
                                       .weight = weight}}}};
}

struct PlacePut {
  double time, x;
};
constexpr PlacePut some_places[] = {{0.31, 0.3}, {0.9, -0.4}, {0.97, 0.2}, {1.8, 3}, {2.5, 0.1}};

}  // namespace

TEST_CASE("a chain that follows in a graph does as it does alone in steps of a sixtieth of a second") {
  const JointChain chain(
      *figures(),
      {.links = {{"tail 1", ConeLimit{.swing = 0.8}}, {"tail 2", bend_of_tail}, {"tail 3", bend_of_tail}, {"tail 4"}},
       .leaps = true});
  GraphPlayer walking(figure_graph({.poses = {{"walk", ClipPose{"walk"}}}}));
  for (const double weight : {1.0, 0.4}) {
    GraphPlayer player(figure_graph(wagging(weight)));
    const Sample<Vec3> target{{0.1, 1.1, -0.5}, {0, 0, 0}, {0, 0, 0}};
    ChainMemory memory;
    int step = 0;
    for (const double time : {0.0, 0.004, 0.1, 0.37, 1.13, 2.4, 5.03}) {
      CAPTURE(time);
      for (; step / 60.0 < time; ++step) {
        std::vector<Motion> pose = shown(walking, step / 60.0);
        follow(chain, target, step == 0 ? 0 : 1 / 60.0, {1, 0, 0}, memory, pose);
      }
      ChainMemory now = memory;
      std::vector<Motion> expected = shown(walking, time);
      follow(chain, target, std::min(time - (step - 1) / 60.0, 1 / 60.0), {weight, 0, 0}, now, expected);
      CHECK(same_bits(shown(player, time), expected));
    }
  }
}

TEST_CASE("a chain that follows has the rates with which it arrives, at the points of its grid too") {
  const auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{{"a", no_node, {}},
                                                                         {"b", 0, {.position = {0, -1, 0.1}}},
                                                                         {"c", 1, {.position = {0, -1, -0.1}}},
                                                                         {"t", no_node, {}}});
  Clip moves{.name = "m", .duration = 2};
  moves.tracks.push_back(
      {"t", "position",
       keyed_curve<Vec3>(std::vector<Key<Vec3>>{{.time = 0, .value = {0.3, -1.2, 0.2}, .ease = Ease::smooth()},
                                                {.time = 0.7, .value = {0.5, -0.9, 0.9}, .ease = Ease::smooth()},
                                                {.time = 1.3, .value = {-0.3, -1.5, -0.5}, .ease = Ease::smooth()},
                                                {.time = 2, .value = {0.2, -0.5, -0.9}}})});
  for (const bool leaps : {false, true}) {
    const ReachPose reach{.base = "m",
                          .joints = {{"a", ConeLimit{.swing = 1.05}}, {"b", HingeLimit{{1, 0, 0}, -0.09, 2.44}}, {"c"}},
                          .target = {.node = "t"},
                          .leaps = leaps,
                          .follows = true};
    GraphPlayer player(
        std::make_shared<const Graph>(nodes, std::make_shared<const std::vector<Clip>>(std::vector<Clip>{moves}),
                                      GraphDescription{.poses = {{"m", ClipPose{"m"}}, {"x", reach}}}));
    double most = 0;
    for (int i = 1; i < 118; ++i) {
      constexpr double h = 1e-5;
      const double time = i / 60.0;
      const std::vector<Motion> before = pose_at(player, time - h), now = pose_at(player, time);
      for (const std::size_t joint : {0, 1}) {
        const Vec3 turned = log_map(now[joint].pose.rotation * before[joint].pose.rotation.conjugate()) / h;
        most = std::max(most, (turned - now[joint].twist.angular).norm());
      }
    }
    // A second derivative of 200 rad/s^2 makes a difference of 1e-3 rad/s.
    CAPTURE(most);
    CHECK(most < 5e-3);
  }
}

TEST_CASE("a chain follows the same way at 30, 60 and 144 frames per second, forwards and back, given or put in") {
  GraphDescription given = wagging(1.0);
  for (const PlacePut& each : some_places) given.inputs.push_back({each.time, "x", each.x});
  GraphPlayer all(figure_graph(given));
  for (const int rate : {30, 60, 144}) {
    CAPTURE(rate);
    GraphPlayer player(figure_graph(wagging(1.0)));
    std::size_t next = 0;
    std::vector<std::pair<double, std::vector<Motion>>> seen;
    for (int i = 0; i <= 3 * rate; ++i) {
      const double time = static_cast<double>(i) / rate;
      for (; next < std::size(some_places) && some_places[next].time <= time; ++next) {
        player.seek(std::max(player.time(), some_places[next].time));
        player.set("x", some_places[next].x);
      }
      player.seek(time);
      seen.emplace_back(time, shown(player, time));
    }
    for (const auto& one : seen) {
      CAPTURE(one.first);
      CHECK(same_bits(shown(all, one.first), one.second));
    }
    for (std::size_t i = seen.size() - 1; i > 20; i -= 19)
      CHECK(same_bits(shown(player, seen[i].first), seen[i].second));
  }
}

TEST_CASE("the rates of a chain that follows in a graph are the derivatives of its pose") {
  GraphDescription given = wagging(1.0);
  for (const PlacePut& each : some_places) given.inputs.push_back({each.time, "x", each.x});
  GraphPlayer player(figure_graph(given));
  int asked = 0, kinks = 0;
  for (int i = 0; i < 170; ++i) {
    const double time = (i + 0.37) / 60;
    const auto is_near = [&](const PlacePut& each) { return std::abs(each.time - time) < 0.01; };
    if (std::ranges::any_of(some_places, is_near)) continue;
    ++asked;
    if (rate_error(player, time, 2e-5) > 1e-4) ++kinks;
  }
  // Where a joint comes to its limit, or it leaps, a difference says nothing.
  MESSAGE(kinks, " of ", asked, " at a kink");
  CHECK(kinks <= 3);
}

TEST_CASE("a graph with a chain that follows is saved and loaded with where it is, and goes on to the same bits") {
  const auto graph = figure_graph(wagging(1.0));
  GraphPlayer player(graph);
  for (const PlacePut& each : some_places) {
    player.seek(each.time);
    player.set("x", each.x);
  }
  check_saved(graph, player);
}

TEST_CASE(
    "whoever asks for which times, a chain that follows begins anew at the same ones, and finds the farthest at once") {
  GraphPlayer played(figure_graph(wagging(1.0))), asked(figure_graph(wagging(1.0)));
  for (const double time : {0.5, 600.0, 600.1, 600.37}) static_cast<void>(shown(played, time));
  for (const double time : {600.37, 600.5}) CHECK(same_bits(shown(asked, time), shown(played, time)));
  for (const double time : {600 * 1666 + 0.1, 1e14, 1e17, 1e18, 1e300}) {
    CAPTURE(time);
    const std::vector<Motion> there = shown(asked, time);
    CHECK(std::ranges::all_of(there, [](const Motion& motion) { return motion.pose.rotation.coeffs().allFinite(); }));
  }
  CHECK(same_bits(shown(asked, 0.5), shown(played, 0.5)));
}
