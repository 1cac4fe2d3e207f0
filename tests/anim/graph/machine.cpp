#include <tweenfall/anim/clip_jumps.h>

#include <limits>

#include "graph_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;
using Change = GraphChange::Kind;

/// Idle and walk by speed, a jump from anywhere that ends by itself, with the given changes.
GraphDescription walker(const GraphChange& change) {
  return {.parameters = {{.name = "speed"}},
          .poses = {{"body",
                     MachinePose{
                         .start = "idle",
                         .states = {{"idle", "idle"}, {"walk", "walk"}, {"jump", "jump"}},
                         .transitions = {
                             {.to = "jump", .when = {{Kind::event, "jump"}}, .change = change},
                             {.from = {"idle"}, .to = "walk", .when = {{Kind::above, "speed", 0.1}}, .change = change},
                             {.from = {"walk"}, .to = "idle", .when = {{Kind::below, "speed", 0.1}}, .change = change},
                             {.from = {"jump"}, .to = "idle", .when = {{Kind::event, "landed"}}, .change = change}}}}}};
}

std::vector<double> times_of(const std::vector<GraphPassage>& passages) {
  std::vector<double> times;
  for (const GraphPassage& each : passages) times.push_back(each.time);
  return times;
}
std::vector<std::size_t> states_of(const std::vector<GraphPassage>& passages) {
  std::vector<std::size_t> states;
  for (const GraphPassage& each : passages) states.push_back(each.state);
  return states;
}

}  // namespace

TEST_CASE("a machine shows the clip of its state bit for bit, before a fade and after it") {
  GraphPlayer player(graph_of(walker({.seconds = 0.3})));
  player.advance(0.7);
  player.set("speed", 1);
  player.advance(3);
  const Animation idle(limb(), *three_clips(), {{.clip = 0}}), walk(limb(), *three_clips(), {{.clip = 1, .at = 0.7}});
  std::vector<Motion> expected(4);
  for (const double time : {0.0, 0.31, 0.7}) {
    idle.sample(time, expected);
    CHECK(same_bits(pose_at(player, time), expected));
  }
  for (const double time : {1.0, 1.5, 3.7}) {
    walk.sample(time, expected);
    CHECK(same_bits(pose_at(player, time), expected));
  }
}

TEST_CASE("every change, interrupted at random times, shows the exact rate of what it shows") {
  for (const GraphChange& change : {GraphChange{Change::fade, 0.4}, GraphChange{Change::quintic, 0.4},
                                    GraphChange{Change::half_life, 0.1}, GraphChange{Change::dead_blend, 0.4}}) {
    CAPTURE(static_cast<int>(change.kind));
    Random random(7);
    GraphPlayer player(graph_of(walker(change)));
    double speed = 0;
    for (int i = 0; i < 40; ++i) {
      player.advance(random.between(0.01, 0.25));
      if (i % 5 == 3 || i % 5 == 4)
        player.send(i % 5 == 3 ? "jump" : "landed");
      else
        player.set("speed", speed = 1 - speed);
    }
    player.advance(1);
    const std::vector<GraphPassage> passages = player.passages(0);
    REQUIRE(passages.size() > 25);
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
      const double time = random.between(0.01, player.time());
      // A stencil must not reach over an instant at which something starts, or a clip has a key.
      const auto beside = [&](double instant) { return std::abs(time - instant) < 3e-4; };
      bool clear = true;
      for (const GraphPassage& each : passages) {
        clear = clear && !beside(each.time) && !beside(each.time + change.seconds);
        for (int key = 0; key < 40; ++key) clear = clear && !beside(each.time + 0.5 * key);
      }
      if (clear) worst = std::max(worst, rate_error(player, time));
    }
    CHECK(worst < 2e-6);
  }
}

TEST_CASE("no interruption makes what is shown jump, in value or in rate") {
  for (const GraphChange& change : {GraphChange{Change::fade, 0.4}, GraphChange{Change::quintic, 0.4},
                                    GraphChange{Change::half_life, 0.1}, GraphChange{Change::dead_blend, 0.4}}) {
    CAPTURE(static_cast<int>(change.kind));
    Random random(11);
    GraphPlayer player(graph_of(walker(change)));
    double speed = 0;
    for (int i = 0; i < 200; ++i) {
      player.advance(i % 7 == 0 ? 0 : random.between(0.001, 0.1));  // several at one instant too
      if (i % 5 == 3 || i % 5 == 4)
        player.send(i % 5 == 3 ? "jump" : "landed");
      else
        player.set("speed", speed = 1 - speed);
    }
    player.advance(1);
    Apart most;
    for (const GraphPassage& each : player.passages(0)) {
      if (each.time == 0) continue;
      const Apart here = apart(pose_at(player, each.time, Side::in), pose_at(player, each.time, Side::out));
      most = {std::max(most.value, here.value), std::max(most.rate, here.rate)};
    }
    CHECK(most.value < 1e-12);
    CHECK(most.rate < 1e-9);
  }
}

TEST_CASE("more fades than can run at once go on without a jump, for the next one settles") {
  GraphPlayer player(graph_of(walker({.seconds = 10})));
  for (int i = 0; i < 30; ++i) {
    player.advance(0.05);
    player.set("speed", i % 2 == 0 ? 1 : 0);
  }
  const std::vector<GraphPassage> passages = player.passages(0);
  CHECK(std::ranges::count(passages, true, &GraphPassage::settles) == 3);
  for (const GraphPassage& each : passages) {
    if (each.time == 0) continue;
    const Apart here = apart(pose_at(player, each.time, Side::in), pose_at(player, each.time, Side::out));
    CHECK(here.value < 1e-12);
    CHECK(here.rate < 1e-9);
  }
  double sum = 0;
  for (const GraphActivity& each : player.activity(0)) sum += each.weight.value;
  CHECK(near(sum, 1.0, 1e-14));
  CHECK(player.activity(0).size() <= most_fades_at_once + 1);
}

TEST_CASE("a settle is over after its time: then the new clip shows bit for bit") {
  for (const Change kind : {Change::quintic, Change::dead_blend}) {
    GraphPlayer player(graph_of(walker({kind, 0.3})));
    player.advance(0.7);
    player.set("speed", 1);
    CHECK(player.activity(0).back().since == 0.7);
    player.advance(0.1);
    CHECK(player.activity(0).back().settling == player.time() - 0.7);
    const Animation walk(limb(), *three_clips(), {{.clip = 1, .at = 0.7}});
    std::vector<Motion> expected(4);
    walk.sample(1.001, expected);
    CHECK(same_bits(pose_at(player, 1.001), expected));
  }
}

TEST_CASE("a change of no length that could be seen is a cut, with no rate that no number holds") {
  GraphPlayer cut(graph_of(walker({Change::fade, 0})));
  cut.advance(0.7);
  cut.set("speed", 1);
  for (const Change kind : {Change::fade, Change::quintic, Change::half_life, Change::dead_blend})
    for (const double seconds : {5e-324, 1e-300, 1e-10}) {
      GraphPlayer player(graph_of(walker({kind, seconds})));
      player.advance(0.7);
      player.set("speed", 1);
      CHECK(same_bits(pose_at(player, 0.7), pose_at(cut, 0.7)));
      CHECK(same_bits(pose_at(player, 0.7, Side::in), pose_at(cut, 0.7, Side::in)));
    }
}

TEST_CASE("an event of a clip leads on at its exact time, whatever the frame") {
  for (const double frame : {10.0, 1.0 / 30, 0.017}) {
    GraphPlayer player(graph_of(walker({.seconds = 0.2})));
    player.seek(0.5);
    player.send("jump");
    while (player.time() < 3) player.advance(frame);
    CHECK(times_of(player.passages(0)) == std::vector<double>{0, 0.5, 1.75});
    CHECK(states_of(player.passages(0)) == std::vector<std::size_t>{0, 2, 0});
  }
}

TEST_CASE("an event that leads nowhere is lost, and one that leads on is used up") {
  GraphDescription steps = {.poses = {{"body", MachinePose{.start = "a",
                                                           .states = {{"a", "idle"}, {"b", "walk"}, {"c", "jump"}},
                                                           .transitions = {{{"a"}, "b", {{Kind::event, "go"}}},
                                                                           {{"b"}, "c", {{Kind::event, "go"}}},
                                                                           {{"c"}, "a", {{Kind::event, "stay"}}}}}}}};
  GraphPlayer player(graph_of(steps));
  player.send("stay");
  player.advance(1);
  player.send("go");
  CHECK(states_of(player.passages(0)) == std::vector<std::size_t>{0, 1});
  player.send("go");
  CHECK(states_of(player.passages(0)) == std::vector<std::size_t>{0, 1, 2});
  CHECK(times_of(player.passages(0)) == std::vector<double>{0, 1, 1});
}

TEST_CASE("a state left at the instant it was entered never shows") {
  GraphDescription steps = {
      .poses = {{"body", MachinePose{.start = "a",
                                     .states = {{"a", "idle"}, {"b", "walk"}, {"c", "jump"}},
                                     .transitions = {{{"a"}, "b", {{Kind::event, "go"}}, {.seconds = 0.5}},
                                                     {{"b"}, "c", {}, {.seconds = 0.5}}}}}}};
  GraphDescription straight = steps;
  std::get<MachinePose>(straight.poses[0].operation).transitions[0].to = "c";
  GraphPlayer through(graph_of(steps)), directly(graph_of(straight));
  for (GraphPlayer* player : {&through, &directly}) {
    player->seek(0.3);
    player->send("go");
    player->advance(0.2);
  }
  CHECK(through.passages(0).size() == 3);
  CHECK(same_bits(pose_at(through, 0.45), pose_at(directly, 0.45)));
  CHECK(through.events(-1, 0.5).size() == directly.events(-1, 0.5).size());
}

TEST_CASE("times in a state and ends of clips are met exactly") {
  GraphDescription timed = {
      .poses = {{"body", MachinePose{.start = "wait",
                                     .states = {{"wait", "idle"}, {"jump", "jump"}},
                                     .transitions = {{{"wait"}, "jump", {{Kind::time_in_state, "", 0.3}}},
                                                     {{"jump"}, "wait", {{Kind::clip_end}}}}}}}};
  GraphPlayer player(graph_of(timed));
  player.seek(5);
  std::vector<double> expected = {0};
  while (expected.back() < 5) expected.push_back(expected.back() + (expected.size() % 2 == 1 ? 0.3 : 2.0));
  expected.pop_back();
  CHECK(times_of(player.passages(0)) == expected);
}

TEST_CASE("a parameter that has keys leads on at the first number at which it compares") {
  const Curve<double> wave = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::smooth()},
                                                  {.time = 1, .value = 1, .ease = Ease::smooth()},
                                                  {.time = 2, .value = -1, .ease = Ease::smooth()},
                                                  {.time = 4, .value = 2}});
  GraphDescription described = {
      .parameters = {{.name = "height", .curve = wave}},
      .poses = {{"body", MachinePose{.start = "low",
                                     .states = {{"low", "idle"}, {"high", "walk"}},
                                     .transitions = {{{"low"}, "high", {{Kind::above, "height", 0.5}}},
                                                     {{"high"}, "low", {{Kind::below, "height", 0.25}}}}}}}};
  GraphPlayer player(graph_of(described));
  player.seek(4);
  const std::vector<GraphPassage> passages = player.passages(0);
  REQUIRE(states_of(passages) == std::vector<std::size_t>{0, 1, 0, 1});
  for (std::size_t i = 1; i < passages.size(); ++i) {
    const double time = passages[i].time, before = std::nextafter(time, 0.0);
    if (passages[i].state == 1) {
      CHECK(wave.value(time) > 0.5);
      CHECK_FALSE(wave.value(before) > 0.5);
    } else {
      CHECK(wave.value(time) < 0.25);
      CHECK_FALSE(wave.value(before) < 0.25);
    }
  }
}

TEST_CASE("a parameter that is held between keys leads on where it jumps, around a loop too") {
  const Curve<double> steps = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::hold()},
                                                   {.time = 0.75, .value = 3, .ease = Ease::hold()},
                                                   {.time = 1, .value = 0}})
                                  .with_outside(Outside::hold, Outside::repeat);
  GraphDescription described = {
      .parameters = {{.name = "mode", .curve = steps}},
      .poses = {{"body", MachinePose{.start = "a",
                                     .states = {{"a", "idle"}, {"b", "walk"}},
                                     .transitions = {{{"a"}, "b", {{Kind::equals, "mode", 3}}},
                                                     {{"b"}, "a", {{Kind::below, "mode", 1}}}}}}}};
  GraphPlayer player(graph_of(described));
  player.seek(3.9);
  CHECK(times_of(player.passages(0)) == std::vector<double>{0, 0.75, 1, 1.75, 2, 2.75, 3, 3.75});
}

TEST_CASE("a parameter that comes around ten million times a second is looked at where it may compare") {
  const auto machine_of = [](const Curve<double>& curve, double level) {
    return graph_of(
        {.parameters = {{.name = "number", .curve = curve}},
         .poses = {{"body", MachinePose{.start = "a",
                                        .states = {{"a", "idle"}, {"b", "walk"}},
                                        .transitions = {{{"a"}, "b", {{Kind::above, "number", level}}}}}}}});
  };
  const auto up = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1e-7, .value = 1e-7}});
  GraphPlayer never(machine_of(up.with_outside(Outside::hold, Outside::repeat), 1));
  never.seek(1e5);
  CHECK(never.passages(0).size() == 1);
  GraphPlayer back(machine_of(up.with_outside(Outside::hold, Outside::pingpong), 1));
  back.seek(1e5);
  CHECK(back.passages(0).size() == 1);
  // It gains as much as it lasts: at each time it is that time.
  const Curve<double> climbing = up.with_outside(Outside::hold, Outside::repeat_offset);
  GraphPlayer later(machine_of(climbing, 1000));
  later.seek(1e5);
  REQUIRE(later.passages(0).size() == 2);
  const double time = later.passages(0)[1].time;
  CHECK(time == doctest::Approx(1000).epsilon(1e-9));
  CHECK(climbing.value(time) > 1000);
  CHECK_FALSE(climbing.value(std::nextafter(time, 0.0)) > 1000);
}

TEST_CASE("the next jump of a number that comes around is found however many rounds are behind and before it") {
  const auto saw = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1e-7, .value = 1}})
                       .with_outside(Outside::hold, Outside::repeat);
  CHECK(first_jump(saw, 1, 1e6) == doctest::Approx(1 + 1e-7).epsilon(1e-9));
  CHECK_FALSE(std::isnan(first_jump(saw, 1e17, 1e18)));
  const auto even = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()},
                                         {.time = 5e-8, .value = 1, .ease = Ease::linear()},
                                         {.time = 1e-7, .value = 0}})
                        .with_outside(Outside::hold, Outside::repeat);
  CHECK(first_jump(even, 0, 1e6) == std::numeric_limits<double>::infinity());
}

TEST_CASE("of several transitions that may be taken the first is") {
  GraphDescription described = {
      .parameters = {{.name = "x"}, {.name = "y"}},
      .poses = {{"body", MachinePose{.start = "a",
                                     .states = {{"a", "idle"}, {"b", "walk"}, {"c", "jump"}},
                                     .transitions = {{{"a"}, "b", {{Kind::above, "x", 0}, {Kind::above, "y", 0}}},
                                                     {{"a"}, "c", {{Kind::above, "x", 0}}}}}}}};
  GraphPlayer one(graph_of(described)), two(graph_of(described));
  one.set("x", 1);
  CHECK(states_of(one.passages(0)) == std::vector<std::size_t>{0, 2});
  // At one instant, everything that is set holds before anything is read.
  two.set("x", 1);
  two.set("y", 1);
  CHECK(states_of(two.passages(0)) == std::vector<std::size_t>{0, 1});
}

TEST_CASE("a machine that turns in a circle at one instant is stopped, and told") {
  GraphDescription described = {
      .parameters = {{.name = "x"}},
      .poses = {{"body", MachinePose{.start = "a",
                                     .states = {{"a", "idle"}, {"b", "walk"}},
                                     .transitions = {{{"a"}, "b", {{Kind::above, "x", 0}}},
                                                     {{"b"}, "a", {{Kind::above, "x", 0}}}}}}}};
  GraphPlayer player(graph_of(described));
  player.seek(1);
  CHECK(player.stops().empty());
  player.set("x", 1);
  CHECK(player.stops() == std::vector<GraphStop>{{1, 0}});
  CHECK(player.passages(0).size() == 1 + most_transitions_at_once);
  player.advance(5);
  CHECK(player.stops().size() == 1);
  CHECK(rate_error(player, 3.2) < 1e-6);
}

TEST_CASE("a machine within a state of another runs by its own, and its events are heard outside") {
  GraphDescription described = {
      .poses = {{"legs", MachinePose{.start = "run",
                                     .states = {{"run", "walk"}, {"leap", "jump"}},
                                     .transitions = {{{"run"}, "leap", {{Kind::time_in_state, "", 1.5}}},
                                                     {{"leap"}, "run", {{Kind::clip_end}}}}}},
                {"all", MachinePose{.start = "free",
                                    .states = {{"free", "legs"}, {"down", "idle"}},
                                    .transitions = {{{"free"}, "down", {{Kind::event, "landed"}}}}}}},
      .output = "all"};
  GraphPlayer player(graph_of(described));
  player.seek(4);
  CHECK(times_of(player.passages(1)) == std::vector<double>{0, 2.75});
  CHECK(times_of(player.passages(0)) == std::vector<double>{0, 1.5, 3.5});
}
