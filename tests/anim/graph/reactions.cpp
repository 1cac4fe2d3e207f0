// What a graph does on events of clips, and graphs in an animation that get inputs.

#include "graph_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;

/// Walks until something lands; while it jumps, its arm is up.
GraphDescription reacting() {
  return {.name = "figure",
          .parameters = {{.name = "arm", .half_life = 0.1}, {.name = "steps"}},
          .poses = {{"body", MachinePose{.start = "walk",
                                         .states = {{"walk", "walk"}, {"jump", "jump"}},
                                         .transitions = {{.from = {"walk"},
                                                          .to = "jump",
                                                          .when = {{Kind::event, "jump"}},
                                                          .change = {GraphChange::Kind::quintic, 0.3}},
                                                         {.from = {"jump"},
                                                          .to = "walk",
                                                          .when = {{Kind::event, "down"}},
                                                          .change = {.seconds = 0.25}}}}},
                    {"all",
                     LayersPose{
                         .base = "body",
                         .layers = {{.pose = "idle", .weight = ByParameter{"arm"}, .mask = {{.joints = "upper"}}}}}}},
          .reactions = {{"off", "arm", 1}, {"landed", "arm", 0}, {"landed", "down"}, {"right", "steps", 1}}};
}

Animation animated(std::vector<GraphDescription> graphs, std::vector<Play> plays = {}) {
  return Animation(limb(), *three_clips(), std::move(plays)).with_graphs(std::move(graphs));
}

std::vector<Motion> pose_of(const Animation& animation, double time) {
  std::vector<Motion> pose(animation.nodes().size());
  animation.sample(time, pose);
  return pose;
}

}  // namespace

TEST_CASE("events of clips that show set parameters and send events, at their exact instants") {
  GraphPlayer player(graph_of(reacting()));
  player.seek(0.4);
  player.send("jump");
  CHECK(player.parameter("arm").value == 0);
  player.seek(0.4 + 1e-9);
  CHECK(player.parameter("arm").value > 0);  // the jump begins on "off"
  player.seek(4);
  const std::vector<GraphPassage> passages = player.passages(0);
  REQUIRE(passages.size() == 3);
  CHECK(passages[1].time == 0.4);
  CHECK(near(passages[2].time, 0.4 + 1.25, 1e-15));
  CHECK(player.parameter("steps").value == 1);
  CHECK(player.inputs().size() == 1);  // what follows by itself is no input
  player.seek(0.9);
  CHECK(player.parameter("steps").value == 0);
}

TEST_CASE("a graph that reacts gives the same bits whatever the frames, saved and loaded") {
  const auto graph = graph_of(reacting());
  Random random(77);
  GraphPlayer coarse(graph), fine(graph), loaded(graph);
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) times.push_back(1.7 * i + random.between(0, 1.5));
  for (const double time : times) {
    coarse.seek(time);
    coarse.send("jump");
  }
  coarse.seek(80);
  double at = 0;
  for (const double time : times) {
    while (at + 0.0171 < time) fine.seek(at += 0.0171);
    fine.seek(at = time);
    fine.send("jump");
  }
  fine.seek(80);
  CHECK(fine.hash() == coarse.hash());
  loaded.load(coarse.save());
  CHECK(loaded.hash() == coarse.hash());
  CHECK(coarse.passages(0).size() > 30);
  for (int i = 100; i-- > 0;) CHECK(same_bits(pose_at(coarse, 0.8 * i), pose_at(fine, 0.8 * i)));
}

TEST_CASE("an event that happens twice at one instant has the graph react once, and a circle of events ends") {
  GraphDescription described = reacting();
  std::vector<Clip> clips = *three_clips();
  clips[1].events = {{1, 1, "turn", ""}, {1, 1, "turn", ""}};
  clips[2].events = {{0, 0, "turn", ""}};
  described.reactions = {{"turn", "flip"}};
  MachinePose& machine = std::get<MachinePose>(described.poses[0].operation);
  machine.transitions = {{.to = "jump", .when = {{Kind::event, "flip"}}},
                         {.to = "walk", .when = {{Kind::event, "flip"}}}};
  machine.transitions[0].from = {"walk"};
  machine.transitions[1].from = {"jump"};
  GraphPlayer player(graph_of(described, std::make_shared<const std::vector<Clip>>(clips)));
  player.seek(5);
  CHECK(player.stops().empty());
  REQUIRE(player.passages(0).size() == 2);
  CHECK(player.passages(0)[1].time == 1);
}

TEST_CASE("faults of reactions are told by place") {
  GraphDescription described = reacting();
  described.reactions = {
      {"landed", "amr", 1}, {"", "arm", 1}, {"landed", "arm"}, {"landed", "arm", std::nan("")}, {"landed", "dwon"}};
  const std::vector<GraphFault> faults = inspect(described, *limb(), *three_clips());
  REQUIRE(faults.size() == 5);
  CHECK(faults[0].place == std::vector<std::string>{"on", "0"});
  CHECK(faults[0].message == "there is no parameter \"amr\"; did you mean \"arm\"?");
  CHECK(faults[4].message == "no machine waits for an event \"dwon\"; did you mean \"down\"?");
}

TEST_CASE("a graph reacts to events of plays and graphs that it lies on") {
  GraphDescription above = reacting();
  above.name = "above";
  above.reactions = {{"landed", "steps", 3}, {"breath", "arm", 1}};
  const Animation animation = animated({reacting(), above}, {Play{.clip = 0, .at = 0.25}});
  const Animation told = animation.with_input("figure", {.time = 0.5, .name = "jump"});
  CHECK(told.graph("above", 0.7).parameter("arm").value == 0);
  CHECK(told.graph("above", 0.75 + 1e-6).parameter("arm").value > 0);
  CHECK(told.graph("above", 1.7).parameter("steps").value == 0);
  CHECK(told.graph("above", 1.76).parameter("steps").value == 3);
  CHECK(animation.graph("above", 1.76).parameter("steps").value == 0);
}

TEST_CASE("what comes in to a graph of an animation leaves what was before it, bit for bit") {
  const Animation before = animated({reacting()}, {Play{.clip = 0}});
  const Animation after = before.with_input("figure", {.time = 0.5, .name = "arm", .value = 0.5});
  for (const double time : {0.0, 0.2, 0.4999}) CHECK(same_bits(pose_of(before, time), pose_of(after, time)));
  CHECK_FALSE(same_bits(pose_of(before, 0.6), pose_of(after, 0.6)));
  GraphPlayer player = after.graph("figure", 0.9);
  CHECK(player.time() == 0.9);
  CHECK(player.own_inputs().size() == 1);
  player.set("arm", 0);
  CHECK(after.graph("figure", 0.9).own_inputs().size() == 1);
  CHECK_THROWS_WITH_AS(static_cast<void>(before.with_input("figrue", {})),
                       "there is no graph \"figrue\"; did you mean \"figure\"?", std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(before.with_input("figure", {.time = 1, .name = "amr", .value = 1})),
                       "there is no parameter \"amr\"; did you mean \"arm\"?", std::invalid_argument);
}

TEST_CASE("what came in to a graph survives a change of the plays below it, and of the nodes") {
  const Animation before = animated({reacting()}, {Play{.clip = 0}});
  Animation told = before;
  for (int i = 0; i < 200; ++i)
    told = told.with_input("figure", {.time = 0.01 * i, .name = "arm", .value = 0.5 + 0.002 * i});
  told = told.with_input("figure", {.time = 2.1, .name = "jump"});
  const Animation stopped = told.with_change({.time = 2.2, .play = "idle", .action = playing::SetSpeed{{{0, 0.5}}}});
  CHECK(stopped.graph("figure", 3).own_inputs() == told.graph("figure", 3).own_inputs());
  CHECK(stopped.graph("figure", 3).hash() == told.graph("figure", 3).hash());
  for (const double time : {0.1, 1.5, 2.1}) CHECK(same_bits(pose_of(stopped, time), pose_of(told, time)));
  std::vector<Node> nodes(told.nodes().nodes().begin(), told.nodes().nodes().end());
  nodes.push_back({"more"});
  const Animation wider = told.with_nodes(std::make_shared<const Hierarchy>(nodes));
  CHECK(wider.graph("figure", 3).own_inputs() == told.graph("figure", 3).own_inputs());
  std::vector<Motion> wide = pose_of(wider, 2.4);
  wide.pop_back();
  CHECK(same_bits(wide, pose_of(told, 2.4)));
}

TEST_CASE("springs follow what is changed below them the same, however far they were asked for before") {
  const GraphDescription below{
      .name = "below",
      .parameters = {{.name = "much"}},
      .poses = {{"plays", RestPose{}}, {"mix", BlendPose{{{"plays", 1.0}, {"walk", ByParameter{"much"}}}}}}};
  const GraphDescription above{
      .name = "above",
      .poses = {{"base", RestPose{}},
                {"head", SpringPose{.base = "base", .node = "lower", .position = SpringSettings{}}}}};
  const double at = 0.5031;  // between two points of the springs' grid
  const auto sought = [&](const Animation& animation) {
    return animation.with_change({.time = at, .play = "idle", .action = playing::Seek{1.4}});
  };
  const auto set = [&](const Animation& animation) {
    return animation.with_input("below", {.time = at, .name = "much", .value = 1});
  };
  const Animation fresh = animated({below, above}, {Play{.clip = 0}});
  const Animation sought_fresh = sought(fresh), set_fresh = set(fresh);
  const Animation asked = animated({below, above}, {Play{.clip = 0}});
  for (const double time : {0.1, at, 0.6, 1.0, 3.0}) static_cast<void>(pose_of(asked, time));
  const Animation sought_asked = sought(asked), set_asked = set(asked);
  for (const double time : {at, 0.51, 0.7, 1.1, 2.0, 3.5}) {
    CHECK(same_bits(pose_of(sought_asked, time), pose_of(sought_fresh, time)));
    CHECK(same_bits(pose_of(set_asked, time), pose_of(set_fresh, time)));
    CHECK_FALSE(same_bits(pose_of(sought_fresh, time), pose_of(set_fresh, time)));
  }
}

TEST_CASE("no time is too far away for a graph that waits for events of loops") {
  const GraphDescription waiting{
      .name = "figure",
      .parameters = {{.name = "ready"}},
      .poses = {{"body", MachinePose{.start = "walk",
                                     .states = {{"walk", "walk"}, {"jump", "jump"}},
                                     .transitions = {{.from = {"walk"},
                                                      .to = "jump",
                                                      .when = {{Kind::event, "right"}, {Kind::above, "ready", 0.5}},
                                                      .change = {.seconds = 0.1}}}}}}};
  const Animation animation = animated({waiting});
  const std::vector<Motion> near = pose_of(animation, 10.3);
  for (const Motion& motion : pose_of(animation, 1e17)) CHECK(motion.pose.position.allFinite());
  CHECK(same_bits(pose_of(animation, 10.3), near));
  const GraphDescription spaced{
      .name = "figure",
      .parameters = {{.name = "pace"}},
      .poses = {{"gait", SpacePose{.by = {ByParameter{"pace"}}, .entries = {{"walk", {0, 0}}, {"idle", {1, 0}}}}}},
      .reactions = {{"landed", "pace", 1}}};  // which neither fires
  for (const Motion& motion : pose_of(animated({spaced}), 1e17)) CHECK(motion.pose.position.allFinite());
  // Inputs from outside still count, there and earlier.
  const Animation told = animation.with_input("figure", {.time = 10.5, .name = "ready", .value = 1});
  CHECK(told.graph("figure", 10.9).passages(0).size() == 1);
  CHECK(told.graph("figure", 11).passages(0).size() == 2);
}

TEST_CASE("a first event that lies outside of what is played is not looked for round by round") {
  const Clip clip = (*three_clips())[0];  // fires one at 0.5 s
  const Player outside({.clip = 0, .from = 0.6}, clip), inside({.clip = 0, .from = 0.4, .to = 1.4}, clip);
  CHECK_FALSE(outside.first_event(clip, 0, 1e17, false, "breath"));
  CHECK(inside.first_event(clip, 10, 1e17, false, "breath")->time == doctest::Approx(10.1));
  // When it is moved elsewhere, it reports what it met before that.
  const Player moved = inside.changed(clip, 5, playing::SetSpeed{{{0, 0}}});
  CHECK(moved.first_event(clip, 4, 1e17, false, "breath")->time == doctest::Approx(4.1));
}

TEST_CASE("tens of thousands of inputs to a graph do not copy each other, and are all kept") {
  const auto run = [](int count) {
    Animation told = animated({reacting()});
    for (int i = 0; i < count; ++i)
      told = told.with_input("figure", {.time = 0.001 * i, .name = "steps", .value = static_cast<double>(i)});
    return told.graph("figure", 0.001 * count).own_inputs().size();
  };
  CHECK(run(30000) == 30000);
}

TEST_CASE("seams, jumps of tracks and of keyed numbers are instants of a graph") {
  std::vector<Clip> clips = *three_clips();
  clips[1].tracks[0].curve =
      keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::linear()}, {.time = 2, .value = {1, 0, 0}}});
  clips[2].tracks[0].curve = keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}, .ease = Ease::hold()},
                                                {.time = 0.75, .value = {1, 0, 0}},
                                                {.time = 2, .value = {1, 0, 0}}});
  GraphDescription described = reacting();
  described.reactions = {};
  described.parameters[1].curve =
      keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 2.5, .value = 1}})
          .with_outside(Outside::hold, Outside::repeat);
  GraphPlayer player(graph_of(described, std::make_shared<const std::vector<Clip>>(clips)));
  CHECK(player.first_instant(0, 1.9) == std::nullopt);
  CHECK(player.first_instant(0, 2.2) == 2.0);
  CHECK(player.first_instant(2, 3) == 2.5);
  CHECK(player.first_instant(4, 5.5) == 5.0);
  player.seek(2.25);
  player.send("jump");
  CHECK(player.first_instant(2.5, 3.9) == 3.0);  // a jump of the state that was entered at 2.25 s
}
