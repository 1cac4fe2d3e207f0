// Values that pass through graphs beside poses, and inputs from outside.

#include "graph_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("colors and morph weights go through a graph as the clips that show have them") {
  auto clips = *three_clips();
  const auto glow = [](double from, double to) {
    return keyed_curve<double>({{.time = 0, .value = from, .ease = Ease::linear()}, {.time = 2, .value = to}});
  };
  for (std::size_t c = 0; c < 2; ++c) {
    const double own = c == 0 ? 0.2 : 1;
    clips[c].tracks.push_back({"upper", "color", Curve<Color>(Color{Vec4(own, 0, 1 - own, 1)})});
    clips[c].tracks.push_back({"upper", "weights", WeightCurves{glow(0, own), glow(own, 0)}});
  }
  using Kind = GraphCondition::Kind;
  const auto graph = graph_of({.poses = {{"mixed", BlendPose{{{"idle", 1.0}, {"walk", 3.0}}}},
                                         {"body", MachinePose{.start = "idle",
                                                              .states = {{"idle", "idle"}, {"mixed", "mixed"}},
                                                              .transitions = {{.to = "mixed",
                                                                               .when = {{Kind::time_in_state, {}, 0.5}},
                                                                               .change = {.seconds = 0.4}}}}}}},
                              std::make_shared<const std::vector<Clip>>(clips));
  GraphPlayer player(graph);
  const auto look = [&](double time) { return player.look_at(1, time); };
  CHECK(look(0.3).color->value.rgba == Vec4(0.2, 0, 0.8, 1));
  CHECK(near(look(0.3).weights[0].value, 0.2 * 0.15, 1e-15));
  // The machine's states begin their clips: at 1.4 s the blend has run 0.9 s.
  CHECK(near(look(1.4).color->value.rgba, Vec4(0.25 * 0.2 + 0.75, 0, 0.25 * 0.8, 1), 1e-12));
  CHECK(near(look(1.4).weights[0].value, (0.25 * 0.2 + 0.75) * 0.45, 1e-12));
  CHECK(near(look(1.4).weights[0].rate, (0.25 * 0.2 + 0.75) / 2, 1e-12));
  // Halfway through the fade; u^2 (3 - 2 u) rises at 1.5 / 0.4 s.
  const double before = 0.2 * 0.35, after = 0.8 * 0.1;
  CHECK(near(look(0.7).weights[0].value, 0.5 * (before + after), 1e-12));
  CHECK(near(look(0.7).weights[0].rate, 0.5 * (0.1 + 0.4) + 1.5 / 0.4 * (after - before), 1e-12));
  CHECK_FALSE(player.look_at(0, 1).color);
  CHECK(player.look_at(0, 1).weights.empty());

  const Animation animation =
      Animation(limb(), clips, {Play{.clip = 1}}).with_graphs({{.name = "g", .poses = {{"rest", RestPose{}}}}});
  CHECK(animation.look(1, 0.7).color->value.rgba == Vec4(1, 0, 0, 1));
}

TEST_CASE("numbers beyond 1e15 and events for which nobody waits are refused wherever they come in") {
  const GraphDescription plain{
      .parameters = {{.name = "speed"}},
      .poses = {{"body", MachinePose{.start = "idle",
                                     .states = {{"idle", "idle"}, {"walk", "walk"}},
                                     .transitions = {{.to = "walk", .when = {{GraphCondition::Kind::event, "go"}}}}}}}};
  const auto refused = [&](const auto& change) {
    GraphDescription description = plain;
    change(description);
    return inspect(description, *limb(), *three_clips()).size() == 1;
  };
  CHECK(inspect(plain, *limb(), *three_clips()).empty());
  CHECK(refused([](GraphDescription& d) { d.parameters[0].start = 2e15; }));
  CHECK(refused([](GraphDescription& d) { d.inputs = {{1, "speed", -2e15}}; }));
  CHECK(refused([](GraphDescription& d) { d.reactions = {{"left", "speed", 2e15}}; }));
  CHECK(refused([](GraphDescription& d) { d.inputs = {{1, "goo"}}; }));
  GraphPlayer player(graph_of(plain));
  CHECK_THROWS_AS(player.set("speed", 2e15), std::invalid_argument);
  CHECK_THROWS_WITH(player.send("goo"), doctest::Contains("did you mean \"go\""));
  CHECK(player.inputs().empty());
  player.set("speed", 1e15);
  player.send("go");
  CHECK(player.inputs().size() == 2);
}
