// At an instant at which a weight kinks, the arriving side has the rate of the piece before, and the leaving side that
// of the piece after.

#include "figure_support.h"
#include "graph_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Rises by 1 per second through 0 at 0.75 s and 1 at 1.75 s, or falls through them; exact in binary numbers.
Curve<double> passing(bool rises) {
  const double first = rises ? -0.75 : 1.75;
  return keyed_curve<double>(
      {{.time = 0, .value = first, .ease = Ease::linear()}, {.time = 4, .value = first + (rises ? 4 : -4)}});
}

/// How far the rates at an instant are from those just before and just behind it.
double missing_side(GraphPlayer& player, double time) {
  constexpr double hair = 1e-9;
  return std::max(apart(shown(player, time, Side::in), shown(player, time - hair)).rate,
                  apart(shown(player, time, Side::out), shown(player, time + hair)).rate);
}

double kink(GraphPlayer& player, double time) {
  return apart(shown(player, time, Side::in), shown(player, time, Side::out)).rate;
}

}  // namespace

TEST_CASE("where a weight passes 0 or 1 every operation has the rate of each side") {
  for (const bool rises : {true, false}) {
    const GraphNumber share = passing(rises);
    FeetPose stepping = stand(1.0);
    stepping.feet[0].weight = share;
    const std::vector<PoseOperation> operations = {
        grip(share),
        look(share),
        curl(share, ChainMethod::fabrik),
        stand(share),
        stepping,
        mirrored(share),
        taken_over(share),
        on_the_spot(share),
        BlendPose{{{"walk", 1.0}, {"idle", share}}},
        LayersPose{.base = "walk", .layers = {{.pose = "dance", .weight = share}}},
        LayersPose{.base = "walk", .layers = {{.pose = "dance", .adds = true, .reference = "idle", .weight = share}}},
        SpacePose{.by = {share}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}}},
        SpacePose{.by = {share}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}}, .sync = "*"},
        SpacePose{.by = {share, 0.25}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}, {"dance", {0, 1}}}},
        SpacePose{
            .by = {share, 0.25}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}, {"dance", {0, 1}}}, .bands = true},
    };
    for (std::size_t i = 0; i < operations.size(); ++i) {
      CAPTURE(i);
      CAPTURE(rises);
      GraphDescription description = graph_with(operations[i]);
      description.inputs.clear();
      GraphPlayer player(figure_graph(description));
      double most = 0;
      for (const double time : {0.75, 1.75}) {
        CHECK(missing_side(player, time) < 1e-6);
        most = std::max(most, kink(player, time));
      }
      CHECK(most > 1e-3);
    }
  }
}

TEST_CASE("where a fade ends, it arrives at the rate that it had") {
  GraphPlayer player(figure_graph(
      {.poses = {{"legs", MachinePose{.start = "a",
                                      .states = {{"a", "walk"}, {"b", "idle"}},
                                      .transitions = {{.to = "b",
                                                       .when = {{GraphCondition::Kind::time_in_state, {}, 0.375}},
                                                       .change = {.seconds = 0.25, .ease = Ease::linear()}}}}}}}));
  for (const double time : {0.375, 0.625}) {
    CHECK(missing_side(player, time) < 1e-6);
    CHECK(kink(player, time) > 1e-3);
  }
}
