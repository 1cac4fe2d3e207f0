// Springs in graphs: the same as alone, the same at every frame rate, through every instant without a jump, and saved.

#include "figure_support.h"
#include "processor_time.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/jiggle.h>
#include <tweenfall/anim/node_spring.h>
#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/spring_response.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;

/// A head on springs and a tail that swings over a base that jumps by a parameter and settles by a machine.
GraphDescription lively() {
  return {.parameters = {{.name = "jump"}, {.name = "lean", .half_life = 0.2}},
          .poses = {{"mix", BlendPose{{{"walk", ByParameter{"jump"}}, {"idle", 0.5}}}},
                    {"body", MachinePose{.start = "mix",
                                         .states = {{"mix", "mix"}, {"dance", "dance"}},
                                         .transitions = {{{"mix"}, "dance", {{Kind::event, "go"}}, {.seconds = 0}},
                                                         {{"dance"},
                                                          "mix",
                                                          {{Kind::time_in_state, "", 0.61}},
                                                          {GraphChange::Kind::quintic, 0.2}}}}},
                    {"head", SpringPose{.base = "body",
                                        .node = "head",
                                        .position = SpringSettings{.hz = 3, .damping = 0.3, .gravity = {0, -3, 0}},
                                        .rotation = SpringSettings{.hz = 2, .damping = 0.2, .steps_per_second = 90}}},
                    {"tail", JigglePose{.base = "head",
                                        .joints = {"tail 1", "tail 2", "tail 3", "tail 4"},
                                        .spring = {.hz = 2, .damping = 0.2, .gravity = {0, -5, 0}},
                                        .weight = 1.0}}}};
}

const std::vector<GraphInput> some_inputs = {{0.4031, "jump", 0.8}, {0.9, "go", {}},  {1.307, "lean", 1},
                                             {1.31, "jump", 0.1},   {2.2, "jump", 1}, {2.2, "go", {}}};

void give(GraphPlayer& player, const GraphInput& input) {
  if (input.value)
    player.set(input.name, *input.value);
  else
    player.send(input.name);
}

/// The index of a time among sixths of a second; -1 for none.
int frame_of_sixth(double time) {
  for (int i = 0; i <= 20; ++i)
    if (time == i / 6.0) return i;
  return -1;
}

Motion world_motion(const std::vector<Motion>& pose, const char* name) {
  return world_of_node(*figures(), *figures()->find(name), pose).motion;
}

}  // namespace

TEST_CASE("springs in a graph do as the springs alone, bit for bit") {
  const SpringSettings place{.hz = 3, .damping = 0.3, .gravity = {0, -3, 0}}, turn{.hz = 2, .damping = 0.2};
  const NodeSpring spring(*figures(), {"head", place, turn});
  const JiggleChain chain(*figures(),
                          {.joints = {"tail 1", "tail 2", "tail 3", "tail 4"}, .spring = place, .limit = 1});
  GraphPlayer walking(figure_graph({.poses = {{"walk", ClipPose{"walk"}}}}));
  const PoseAt pose_at = [&](double time, std::span<Motion> out) { walking.pose_at(time, out); };
  const auto keys = keyed_curve<double>({{.time = 0, .value = 0.2}, {.time = 6, .value = 0.9}});
  const GraphNumber weights[] = {0., 1., 0.35, keys};
  for (const GraphNumber& weight : weights) {
    GraphPlayer springy(figure_graph(
        {.poses = {{"s",
                    SpringPose{
                        .base = "walk", .node = "head", .position = place, .rotation = turn, .weight = weight}}}})),
        swinging(figure_graph({.poses = {{"s", JigglePose{.base = "walk",
                                                          .joints = {"tail 1", "tail 2", "tail 3", "tail 4"},
                                                          .spring = place,
                                                          .limit = 1,
                                                          .weight = weight}}}}));
    NodeSpringState state = spring.at_rest(0);
    JiggleState swing = chain.at_rest(0);
    std::vector<Motion> scratch(2 * figures()->size());
    for (const double time : {0.0, 0.004, 0.1, 0.37, 1.13, 2.4, 5.03}) {
      CAPTURE(time);
      Sample<double> now{1, 0, 0};
      if (const double* constant = std::get_if<double>(&weight)) now.value = *constant;
      if (weight.index() == 1) now = keys.sample(time);
      std::vector<Motion> expected = shown(walking, time), tail = expected;
      follow(spring, state, time, pose_at, now, scratch, expected);
      jiggle(chain, swing, time, pose_at, now, scratch, tail);
      CHECK(same_bits(shown(springy, time), expected));
      CHECK(same_bits(shown(swinging, time), tail));
    }
  }
}

TEST_CASE("springs come the same way at 30, 60 and 144 frames per second, forwards and back, given or put in") {
  GraphDescription given = lively();
  given.inputs = some_inputs;
  std::vector<std::vector<Motion>> at_common;  // every sixth of a second
  GraphPlayer all(figure_graph(given));
  for (int i = 0; i <= 20; ++i) at_common.push_back(shown(all, i / 6.0));
  for (const int rate : {30, 60, 144}) {
    CAPTURE(rate);
    GraphPlayer player(figure_graph(lively()));
    std::size_t next = 0;
    std::vector<std::pair<double, std::vector<Motion>>> seen;
    for (int frame = 0; frame <= rate * 20 / 6; ++frame) {
      const double time = static_cast<double>(frame) / rate;
      while (next < some_inputs.size() && some_inputs[next].time <= time) {
        // What shows until just before does not depend on what comes.
        for (const double before : {some_inputs[next].time - 0.003, some_inputs[next].time - 1e-7})
          if (before > player.time()) seen.emplace_back(before, shown(player, before));
        player.seek(std::max(player.time(), some_inputs[next].time));
        give(player, some_inputs[next++]);
      }
      player.seek(time);
      seen.emplace_back(time, shown(player, time));
    }
    for (const auto& each : seen) {
      const double time = each.first;
      const auto& pose = each.second;
      CAPTURE(time);
      CHECK(same_bits(shown(all, time), pose));
      if (frame_of_sixth(time) >= 0) CHECK(same_bits(at_common[static_cast<std::size_t>(frame_of_sixth(time))], pose));
    }
    for (std::size_t i = seen.size(); i-- > 0;) CHECK(same_bits(shown(player, seen[i].first), seen[i].second));
  }
}

TEST_CASE("no instant makes what a spring holds jump, in place or in velocity") {
  GraphDescription given = lively();
  given.inputs = some_inputs;
  GraphPlayer player(figure_graph(given));
  player.seek(4);
  std::vector<double> instants;
  for (const GraphInput& input : some_inputs) instants.push_back(input.time);
  for (const GraphPassage& passage : player.passages(0)) instants.push_back(passage.time);
  REQUIRE(instants.size() > 9);
  GraphDescription without = given;
  without.output = "body";
  GraphPlayer base(figure_graph(without));
  double jump = 0;
  for (const double instant : instants) {
    if (instant == 0) continue;
    CAPTURE(instant);
    const std::vector<Motion> before = shown(player, instant, Side::in), after = shown(player, instant);
    jump = std::max(jump, (world_motion(shown(base, instant, Side::in), "head").pose.position -
                           world_motion(shown(base, instant), "head").pose.position)
                              .norm());
    const Motion head = world_motion(before, "head"), later = world_motion(after, "head");
    CHECK(near(head.pose.position, later.pose.position, 1e-12));
    CHECK(near(head.pose.rotation, later.pose.rotation, 1e-12));
    CHECK(near(head.twist.linear, later.twist.linear, 1e-9));
    CHECK(near(head.twist.angular, later.twist.angular, 1e-9));
    if (instant > 0.1) CHECK(head.twist.linear.norm() > 1e-3);
  }
  CHECK(jump > 0.005);  // of the base
}

TEST_CASE("a spring whose target jumps at an instant goes there as the closed form says") {
  // The base jumps from rest to a place of its own, which no clip moves.
  std::vector<Clip> clips(2);
  for (std::size_t i = 0; i < 2; ++i) {
    clips[i] = {.name = i == 0 ? "a" : "b", .duration = 9};
    const Vec3 place(0.5 * static_cast<double>(i), 1, 0);
    clips[i].tracks.push_back({"hips", "position", keyed_curve<Vec3>({{.time = 0, .value = place}})});
  }
  const double instant = 0.41234, hz = 1.7, damping = 0.35, w = 2 * pi * hz;
  const GraphDescription described = {
      .parameters = {{.name = "there"}},
      .poses = {{"target", LayersPose{.base = "a", .layers = {{.pose = "b", .weight = ByParameter{"there"}}}}},
                {"spring",
                 SpringPose{
                     .base = "target", .node = "hips", .position = SpringSettings{.hz = hz, .damping = damping}}}},
      .inputs = {{instant, "there", 1}}};
  GraphPlayer player(
      std::make_shared<const Graph>(figures(), std::make_shared<const std::vector<Clip>>(clips), described));
  for (const double time : {0.2, 0.41234, 0.42, 0.6, 1.0, 1.77, 3.3}) {
    CAPTURE(time);
    const SpringResponse response = spring_response(w * std::max(0.0, time - instant), damping);
    const std::vector<Motion> pose = shown(player, time);
    const double expected = time < instant ? 0 : 0.5 * (1 - response.displaced);
    CHECK(near(pose[0].pose.position, Vec3(expected, 1, 0), 1e-12));
    CHECK(near(pose[0].twist.linear, Vec3(time < instant ? 0 : 0.5 * w * response.struck, 0, 0), 1e-11));
  }
}

TEST_CASE(
    "a spring over a clip that jumps, at keys and where it loops, goes there as the closed form says, not before") {
  const double step = 0.41234, round = 0.9017, hz = 1.7, damping = 0.35, w = 2 * pi * hz;
  Clip clip{.name = "steps", .duration = round, .loop = {.mode = LoopMode::repeat}};
  clip.tracks.push_back({"hips", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}, .ease = Ease::hold()},
                                            {.time = step, .value = {0.5, 1, 0}}})});
  const auto clips = std::make_shared<const std::vector<Clip>>(std::vector{clip});
  const SpringSettings spring{.hz = hz, .damping = damping};
  const GraphDescription described = {
      .poses = {{"spring", SpringPose{.base = "steps", .node = "hips", .position = spring}}}};
  for (const bool often : {false, true}) {
    GraphPlayer player(std::make_shared<const Graph>(figures(), clips, described));
    for (const double time : {0.2, 0.41, 0.412, 0.42, 0.6, 0.899, 0.9016, 0.9018, 1.3, 1.314, 1.315, 2.7, 9.1}) {
      CAPTURE(time);
      if (often)
        for (double between = player.time(); between < time; between += 0.0171)
          static_cast<void>(shown(player, between));
      // Each jump moves it as if it were the only one.
      Vec3 place(0, 1, 0), velocity(0, 0, 0);
      for (int i = 0; i * round <= time; ++i)
        for (const auto& [instant, way] : {std::pair{i * round, i > 0 ? -0.5 : 0.0}, {i * round + step, 0.5}}) {
          const SpringResponse response = spring_response(w * std::max(0.0, time - instant), damping);
          place.x() += way * (1 - response.displaced);
          velocity.x() += way * w * response.struck;
        }
      const std::vector<Motion> pose = shown(player, time);
      CHECK(near(pose[0].pose.position, place, 1e-11));
      CHECK(near(pose[0].twist.linear, velocity, 1e-10));
    }
  }
}

namespace {

constexpr double formula_step = 0.41234, formula_round = 0.9017;

/// The hips step aside and back by a formula, for ever or in a clip that repeats.
Clip steps_by_formula(bool endless) {
  const std::string text = endless ? "0.5 * step(0.41234, mod(t, 0.9017))" : "0.5 * step(0.41234, t)";
  Clip clip{.name = "steps", .duration = endless ? std::numeric_limits<double>::infinity() : formula_round};
  if (!endless) clip.loop = {.mode = LoopMode::repeat};
  clip.tracks.push_back(
      {"hips", "position", parametric(expression_curve(Expression(text)), Curve<double>(1.0), Curve<double>(0.0))});
  return clip;
}

/// The same by keys.
Clip steps_by_keys() {
  Clip clip{.name = "steps", .duration = formula_round, .loop = {.mode = LoopMode::repeat}};
  clip.tracks.push_back({"hips", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}, .ease = Ease::hold()},
                                            {.time = formula_step, .value = {0.5, 1, 0}}})});
  return clip;
}

/// Where a spring is after all steps until a time: each moves it as if it were the only one.
Sample<double> after_steps(double hz, double damping, double began, double time) {
  const double w = 2 * pi * hz;
  Sample<double> sum{0, 0, 0};
  for (int i = 0; began + i * formula_round <= time; ++i)
    for (const auto& [instant, way] :
         {std::pair{i * formula_round, i > 0 ? -0.5 : 0.0}, {i * formula_round + formula_step, 0.5}}) {
      const SpringResponse response = spring_response(w * std::max(0.0, time - began - instant), damping);
      sum.value += way * (1 - response.displaced);
      sum.rate += way * w * response.struck;
    }
  return sum;
}

}  // namespace

TEST_CASE("a spring goes where plays below its graph jump, or formulas do, as the closed form says, not before") {
  const double hz = 1.7, damping = 0.35;
  const SpringSettings spring{.hz = hz, .damping = damping};
  for (const Clip& clip : {steps_by_keys(), steps_by_formula(false), steps_by_formula(true)})
    for (const std::string base : {"", "steps"}) {
      CAPTURE(base);
      const double began = base.empty() ? 0.2 : 0;
      const Animation plays(figures(), {clip}, {{.clip = 0, .at = began}});
      const Animation with = plays.with_graphs(
          {{.name = "g", .poses = {{"spring", SpringPose{.base = base, .node = "hips", .position = spring}}}},
           {.name = "over", .poses = {{"same", RestPose{}}}}});
      const Animation often = plays.with_graphs({with.graphs().begin(), with.graphs().end()});
      std::vector<Motion> pose(figures()->size()), between(figures()->size());
      double last = 0;
      for (const double time :
           {0.2, 0.41, 0.412, 0.42, 0.6, 0.612, 0.613, 0.899, 0.9016, 0.9018, 1.1, 1.11, 1.3, 1.314, 1.315, 2.7, 9.1}) {
        CAPTURE(time);
        for (; last < time; last += 0.0171) often.sample(last, between);
        with.sample(time, pose);
        const Sample<double> expected = after_steps(hz, damping, began, time);
        CHECK(near(pose[0].pose.position, Vec3(expected.value, 1, 0), 1e-11));
        CHECK(near(pose[0].twist.linear, Vec3(expected.rate, 0, 0), 1e-10));
        often.sample(time, between);
        CHECK(same_bits(pose, between));
      }
    }
}

TEST_CASE("a spring over a graph whose parameter jumps, or a play that is sought, moves from then on") {
  const double hz = 1.7, damping = 0.35, instant = 0.41234, w = 2 * pi * hz;
  std::vector<Clip> clips(1);
  clips[0] = {.name = "way", .duration = 9};
  clips[0].events = {{.from = 2, .to = 2, .name = "passed", .data = {}},
                     {.from = 5.5, .to = 8, .name = "on", .data = {}}};
  clips[0].tracks.push_back({"hips", "position",
                             keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}, .ease = Ease::hold()},
                                                {.time = 5, .value = {0.5, 1, 0}, .ease = Ease::hold()}})});
  const GraphDescription springy{
      .name = "spring",
      .poses = {{"s", SpringPose{.node = "hips", .position = SpringSettings{.hz = hz, .damping = damping}}}}};
  const GraphDescription below{
      .name = "below",
      .parameters = {{.name = "there"}},
      .poses = {{"later", ClipPose{.clip = "way", .at = -6}},
                {"mix", LayersPose{.layers = {{.pose = "later", .weight = ByParameter{"there"}}}}}},
      .inputs = {{instant, "there", 1}}};
  const Animation plays(figures(), clips, {{.clip = 0}});
  const Animation by_graph = plays.with_graphs({below, springy});
  const Animation by_seek =
      plays.with_graphs({springy}).with_change({.time = instant, .play = "way", .action = playing::Seek{.time = 6}});
  const Animation telling = plays.with_graphs({springy}).with_change(
      {.time = instant, .play = "way", .action = playing::Seek{.time = 6, .events = true}});
  std::vector<Motion> pose(figures()->size());
  for (const Animation& animation : {by_graph, by_seek, telling})
    for (const double time : {0.2, 0.4123, 0.42, 0.6, 1.0, 1.77, 3.3}) {
      CAPTURE(time);
      animation.sample(time, pose);
      const SpringResponse response = spring_response(w * std::max(0.0, time - instant), damping);
      CHECK(near(pose[0].pose.position, Vec3(0.5 * (1 - response.displaced), 1, 0), 1e-11));
      CHECK(near(pose[0].twist.linear, Vec3(0.5 * w * response.struck, 0, 0), 1e-10));
    }
}

TEST_CASE("springs go on the same way after a change of the plays, whether they were looked at before or not") {
  GraphDescription first = lively(), second = lively();
  first.name = "first";
  second.name = "second";
  const Animation start =
      Animation(figures(), *figure_clips(), {{.clip = 0}, {.clip = 1}}).with_graphs({first, second});
  std::vector<Motion> pose(figures()->size()), other(figures()->size());
  Random random(26);
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    // Springs take steps of 1/120 s.
    const double input = random.between(0.3, 0.5), change = input + random.between(0, 0.02);
    const char* const told = random.bits() % 2 ? "first" : "second";
    const PlayChange sought{
        .time = change, .play = "idle", .action = playing::Seek{.time = 1.3, .fade = random.between(0, 0.1)}};
    const Animation before = start.with_input(told, {input, "jump", random.unit()});
    for (int look = 0; look < 6; ++look) before.sample(random.between(0.25, change + 0.02), pose);
    const Animation seen = before.with_change(sought),
                    unseen = start.with_input(told, before.graph(told, input).inputs().back()).with_change(sought);
    for (const double time : {change, change + 0.01, 1.0}) {
      seen.sample(time, pose);
      unseen.sample(time, other);
      CHECK(same_bits(pose, other));
    }
  }
}

TEST_CASE("springs over clips in phase whose weights glide look no further ahead than they must") {
  // Each round begins where it began, so that every seam is a jump.
  std::vector<Clip> clips;
  for (const double length : {1.0, 0.73, 1.37}) {
    Clip clip{.name = "gait " + std::to_string(clips.size()), .duration = length, .loop = {.mode = LoopMode::repeat}};
    clip.tracks.push_back({"hips", "position",
                           keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = length, .value = {0, 1, 1}}})});
    clips.push_back(clip);
  }
  const SpringSettings spring{.hz = 2, .damping = 0.4, .steps_per_second = 480};
  const GraphDescription described{
      .parameters = {{.name = "speed", .half_life = 0.15}},
      .poses = {{"gaits", SpacePose{.by = {ByParameter{"speed"}},
                                    .entries = {{"gait 0", {0, 0}}, {"gait 1", {0.5, 0}}, {"gait 2", {1, 0}}},
                                    .sync = ""}},
                {"head", SpringPose{.base = "gaits", .node = "head", .position = spring, .rotation = spring}},
                {"tail", JigglePose{.base = "head", .joints = {"tail 1", "tail 2", "tail 3"}, .spring = spring}}},
      .inputs = {{0.01, "speed", 0.6}}};
  GraphPlayer player(
      std::make_shared<const Graph>(figures(), std::make_shared<const std::vector<Clip>>(clips), described));
  const double before = processor_seconds();
  CHECK(std::isfinite(shown(player, 0.08)[8].pose.position.x()));
  const double taken = processor_seconds() - before;
  MESSAGE("a first frame takes " << taken << " s");
  CHECK(taken < 0.5);  // nine times as long with a look a second ahead
}

TEST_CASE("springs know when plays were changed although nodes were added since") {
  const Animation start = Animation(figures(), *figure_clips(), {{.clip = 0}}).with_graphs({lively()});
  const Animation changed =
      start.with_change({.time = 0.41, .play = "walk", .action = playing::SetSpeed{.speed = {{0, 0.1}}}});
  Hierarchy more = *figures();
  more.add({"hat", 8, {}});
  const Animation grown = changed.with_nodes(std::make_shared<const Hierarchy>(more));
  std::vector<Motion> pose(figures()->size()), other(more.size());
  for (const double time : {0.405, 0.409, 0.42, 0.6, 2.0}) {
    CAPTURE(time);
    changed.sample(time, pose);
    grown.sample(time, other);
    CHECK(same_bits(pose, std::span(other).first(pose.size())));
  }
}

TEST_CASE("a graph with springs is saved and loaded with their state, and goes on to the same bits") {
  const auto graph = figure_graph(lively());
  GraphPlayer player(graph);
  for (const GraphInput& input : some_inputs) {
    player.seek(input.time);
    give(player, input);
  }
  check_saved(graph, player);
}

TEST_CASE("the state of a node's springs goes to bytes and back") {
  const NodeSpringState state{{7, {1, 2, 3}, {4, 5, 6}}, {-9, {0.1, 0.2, 0.3}, {-1, -2, -3}}};
  CHECK(state.bytes().size() == 112);
  CHECK(NodeSpringState::from_bytes(state.bytes()) == state);
  std::vector<std::byte> bytes = state.bytes();
  bytes.pop_back();
  CHECK_THROWS_AS((void)NodeSpringState::from_bytes(bytes), std::invalid_argument);
}

TEST_CASE("a spring begins at rest with the state that shows it, each time it is entered") {
  GraphDescription described = lively();
  described.poses[2].operation =
      SpringPose{.base = "walk", .node = "head", .position = SpringSettings{.hz = 2, .damping = 0.1}};
  described.poses[3].operation =
      MachinePose{.start = "still",
                  .states = {{"still", "idle"}, {"springy", "head"}},
                  .transitions = {{{"still"}, "springy", {{Kind::above, "lean", 0.5}}, {.seconds = 0}},
                                  {{"springy"}, "still", {{Kind::below, "lean", 0.5}}, {.seconds = 0}}}};
  described.inputs = {{0.5, "lean", 1}, {1.5, "lean", 0}, {2.5, "lean", 1}};
  GraphPlayer player(figure_graph(described));
  std::vector<Motion> walk(figures()->size());
  for (const double entered : {0.5, 2.5})
    for (const double since : {0.0, 0.05, 0.7}) {
      GraphPlayer alone(figure_graph({.poses = {{"s", described.poses[2].operation}}}));
      CHECK(difference_of(shown(player, entered + since), shown(alone, since)) < 1e-12);
    }
}

TEST_CASE("springs that are not there are refused with their place") {
  const auto told = [](const PoseOperation& operation) {
    std::string text;
    for (const GraphFault& fault : inspect({.poses = {{"p", operation}}}, *figures(), *figure_clips())) {
      for (const std::string& part : fault.place) text += "/" + part;
      text += ": " + fault.message + "\n";
    }
    return text;
  };
  CHECK(told(SpringPose{.node = "haed", .position = SpringSettings{}}) ==
        "/poses/p/spring/node: there is no node \"haed\"; did you mean \"head\"?\n");
  CHECK(told(SpringPose{.node = "head"}).find("neither a position nor a rotation") != std::string::npos);
  CHECK(told(SpringPose{.node = "head", .position = SpringSettings{.hz = -1}}).find("/poses/p/spring") == 0);
  CHECK(told(JigglePose{.joints = {"tail 1"}}).find("/poses/p/jiggle") == 0);
  CHECK(told(JigglePose{.joints = {"tail 1", "tial 2"}}) ==
        "/poses/p/jiggle/joints/1: there is no node \"tial 2\"; did you mean \"tail 2\"?\n");
  CHECK(told(JigglePose{.joints = {"tail 1", "head"}}).find("must be below") != std::string::npos);
}
