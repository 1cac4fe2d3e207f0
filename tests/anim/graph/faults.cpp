#include "graph_support.h"

#include <tweenfall/anim/graph_doubts.h>

#include <limits>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;

std::string faults_of(const GraphDescription& description) {
  std::string text;
  for (const GraphFault& fault : inspect(description, *limb(), *three_clips())) {
    for (const std::string& part : fault.place) text += "/" + part;
    text += ": " + fault.message + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("all faults of a graph are listed, each with its place") {
  const GraphDescription faulty = {
      .parameters = {{.name = "speed"}, {.name = "speed"}},
      .poses = {{"a", LayersPose{.base = "b", .layers = {{.pose = "walk", .mask = {{.joints = "uper"}}}}}},
                {"b", BlendPose{{{"idle", 1.0}, {"a", 1.0}}}},
                {"c", BlendPose{{{"idle", 0.0}, {"walk", 0.0}}}},
                {"d", ClipPose{"wlak"}},
                {"e", MachinePose{.start = "one",
                                  .states = {{"one", "idle"}, {"two", "runn"}},
                                  .transitions = {{{"one"}, "tow", {{Kind::above, "sped", 1}}}}}}},
      .output = "z"};
  CHECK(faults_of(faulty) ==
        "/parameters/speed: two parameters are named \"speed\"\n"
        "/poses/b/blend/1: poses go around in a circle: \"a\" -> \"b\" -> \"a\"\n"
        "/poses/a/layers/0/mask/0: no joint is named \"uper\"; did you mean \"upper\"?\n"
        "/poses/c/blend: these weights sum to zero; give one above 0\n"
        "/poses/d/clip: there is no clip \"wlak\"; did you mean \"walk\"?\n"
        "/poses/e/machine/states/two: there is no pose or clip \"runn\"\n"
        "/poses/e/machine/transitions/0/to: there is no state \"tow\"; did you mean \"two\"?\n"
        "/poses/e/machine/transitions/0/when: there is no parameter \"sped\"; did you mean \"speed\"?\n"
        "/output: there is no pose \"z\"\n");
  CHECK_THROWS_WITH_AS(Graph(limb(), three_clips(), faulty), doctest::Contains("/poses/c/blend: these weights"),
                       std::invalid_argument);
}

TEST_CASE("weights that sum to zero for a while are told, with the place and the time") {
  using Keys = std::vector<Key<double>>;
  const auto weight = [](const Keys& keys) { return GraphNumber(keyed_curve<double>(keys)); };
  const auto doubts_of = [](const std::vector<BlendPose::Part>& parts) {
    const Curve<double> keys = keyed_curve<double>({{.time = 0, .value = 1}, {.time = 2, .value = 0}});
    const GraphDescription described{.parameters = {{.name = "open"}, {.name = "keyed", .curve = keys}},
                                     .poses = {{"b", BlendPose{parts}}}};
    std::string text;
    for (const GraphFault& fault : inspect(described, *limb(), *three_clips())) text += fault.message + "\n";
    for (const GraphFault& doubt : doubts_about(described)) {
      for (const std::string& part : doubt.place) text += "/" + part;
      text += ": " + doubt.message + "\n";
    }
    return text;
  };
  const std::string shows = ": the pose below the graph shows then\n",
                    at = "/poses/b/blend: these weights sum to zero ";
  const Keys falls{{.time = 0, .value = 1}, {.time = 1, .value = 0}};
  const Keys rises{{.time = 1, .value = 0}, {.time = 2, .value = 1}};
  const Keys never{{.time = 0, .value = 0}, {.time = 2, .value = -1}};
  CHECK(doubts_of({{"walk", weight(falls)}}) == at + "from 1 s on" + shows);
  CHECK(doubts_of({{"walk", weight(falls)}, {"idle", 0.0}}) == at + "from 1 s on" + shows);
  CHECK(doubts_of({{"walk", weight(falls)}, {"idle", ByParameter{"keyed"}}}) == at + "from 2 s on" + shows);
  CHECK(doubts_of({{"walk", weight(rises)}, {"idle", 0.0}}) == at + "from 0 s to 1 s" + shows);
  CHECK(doubts_of({{"walk", weight({{.time = 0, .value = 0, .ease = Ease::hold()}, {.time = 1, .value = 1}})}}) ==
        at + "from 0 s to 1 s" + shows);
  CHECK(doubts_of({{"walk", weight(never)}}) == "these weights sum to zero; give one above 0\n");
  // A moment is not a while, and what an open parameter does nobody knows.
  CHECK(doubts_of({{"walk", weight(falls)}, {"idle", weight(rises)}}).empty());
  CHECK(doubts_of({{"walk", weight(falls)}, {"idle", 0.1}}).empty());
  CHECK(doubts_of({{"walk", weight(falls)}, {"idle", ByParameter{"open"}}}).empty());
  const Curve<double> again = keyed_curve<double>(falls).with_outside(Outside::hold, Outside::repeat);
  CHECK(doubts_of({{"walk", GraphNumber(again)}}).empty());
}

TEST_CASE("transitions without conditions that lead around are refused") {
  const GraphDescription faulty = {
      .poses = {{"a", MachinePose{.start = "one",
                                  .states = {{"one", "idle"}, {"two", "walk"}, {"three", "jump"}},
                                  .transitions = {{{"one"}, "two"}, {{"two"}, "three"}, {{"three"}, "two"}}}}}};
  CHECK(faults_of(faulty) ==
        "/poses/a/machine/states/two: transitions without conditions lead on from here for ever; give one of them a "
        "\"when\"\n");
}

TEST_CASE("numbers that are none, or out of their range, are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(faults_of({.poses = {{"a", ClipPose{"walk", nan}}}}) == "/poses/a/at: a clip starts at a finite time\n");
  CHECK(faults_of({.poses = {{"a", BlendPose{{{"walk", -1.0}}}}}}) ==
        "/poses/a/blend/0: a weight is 0 or more; it is -1\n");
  CHECK(faults_of({.poses = {{"a", LayersPose{.layers = {{.pose = "walk", .weight = 1.5}}}}}}) ==
        "/poses/a/layers/0/weight: the weight of a layer is 0 to 1; it is 1.5\n");
  CHECK(faults_of({.parameters = {{.name = "x", .half_life = -1}}, .poses = {{"a", RestPose{}}}}) ==
        "/parameters/x/half_life: a half-life is 0 s or more; it is -1 s\n");
  CHECK(faults_of({.poses = {{"a", RestPose{}}}, .inputs = {{-1, "x", 2}, {1, "jump"}}}) ==
        "/inputs/0: an input comes at 0 s or later; this one at -1 s\n/inputs/0: there is no parameter \"x\"\n"
        "/inputs/1: no machine waits for an event \"jump\"\n");
  CHECK(
      faults_of(
          {.parameters = {{.name = "x", .start = 1e308}}, .poses = {{"a", RestPose{}}}, .inputs = {{1, "x", -2e15}}}) ==
      "/parameters/x: a parameter starts as a number up to 1e15\n/inputs/0: a parameter is set to a number up to "
      "1e15\n");
  CHECK(faults_of({.parameters = {{.name = "x", .start = 1e15, .half_life = 1e-3}},
                   .poses = {{"a", RestPose{}}},
                   .inputs = {{1, "x", -1e15}}}) == "");
  const auto changing = [](const GraphChange& change) {
    return GraphDescription{
        .poses = {{"a", MachinePose{"one", {{"one", "idle"}, {"two", "walk"}}, {{{"one"}, "two", {}, change}}}}}};
  };
  CHECK(faults_of(changing({.seconds = -1})) ==
        "/poses/a/machine/transitions/0/fade: a fade lasts 0 s or more; this one -1 s\n");
  CHECK(faults_of(changing({GraphChange::Kind::quintic, 0})) ==
        "/poses/a/machine/transitions/0/settle: settling takes more than 0 s; this 0 s\n");
  CHECK(faults_of(changing({.seconds = 1, .ease = Ease::smooth()})) ==
        "/poses/a/machine/transitions/0/ease: \"smooth\" depends on keys, and a fade has none; say \"linear\" or a "
        "shape, "
        "such as \"quad-in-out\"\n");
}

TEST_CASE("a graph that comes to too much is refused, and at once") {
  GraphDescription doubling;
  doubling.poses.push_back({"p0", BlendPose{{{"walk"}, {"idle"}}}});
  for (int i = 1; i < 60; ++i) {
    const std::string below = "p" + std::to_string(i - 1);
    doubling.poses.push_back({"p" + std::to_string(i), BlendPose{{{below}, {below}}}});
  }
  CHECK(faults_of(doubling).find("it uses other poses again and again") != std::string::npos);
  GraphDescription deep;
  deep.poses.push_back({"p0", LayersPose{.layers = {{.pose = "walk"}}}});
  for (int i = 1; i < 200; ++i)
    deep.poses.push_back({"p" + std::to_string(i), LayersPose{.layers = {{.pose = "p" + std::to_string(i - 1)}}}});
  CHECK(faults_of(deep).find("nested more than 64 deep") != std::string::npos);
  std::ranges::reverse(deep.poses);
  CHECK(faults_of(deep).find("nested more than 64 deep") != std::string::npos);
}

TEST_CASE("a graph of nothing is refused, and one of the deepest and widest is played") {
  CHECK(faults_of({}) == "/poses: a graph has poses; this one has none\n");
  GraphDescription deep;
  deep.poses.push_back({"p0", BlendPose{{{"walk"}, {"idle"}, {"jump"}}}});
  for (int i = 1; i < 60; ++i)
    deep.poses.push_back(
        {"p" + std::to_string(i),
         LayersPose{.layers = {{.pose = "p" + std::to_string(i - 1), .adds = true, .reference = "walk"},
                               {.pose = "idle", .weight = 0.1}}}});
  GraphPlayer player(graph_of(deep));
  CHECK(rate_error(player, 0.7) < 1e-5);
}
