#include "graph_support.h"

#include <tweenfall/curves/number_text.h>

#include <limits>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

using Kind = GraphCondition::Kind;

/// Everything that a graph can have: parameters that follow, a blend, layers over a machine that settles.
GraphDescription rich() {
  return {
      .parameters = {{.name = "speed", .half_life = 0.1}, {.name = "aim"}},
      .poses = {
          {"move", BlendPose{{{"idle", 0.3}, {"walk", ByParameter{"speed"}}}}},
          {"body", MachinePose{.start = "move",
                               .states = {{"move", "move"}, {"jump", "jump"}},
                               .transitions = {{.to = "jump",
                                                .when = {{Kind::event, "jump"}},
                                                .change = {GraphChange::Kind::quintic, 0.3}},
                                               {{"jump"}, "move", {{Kind::clip_end}}, {.seconds = 0.25}}}}},
          {"all",
           LayersPose{
               .base = "body",
               .layers = {{.pose = "idle", .weight = ByParameter{"aim"}, .mask = {{.joints = "upper", .below = true}}},
                          {.pose = "walk", .adds = true, .reference = "idle", .weight = 0.4}}}}}};
}

void play_at_random(GraphPlayer& player, std::uint64_t seed, int inputs) {
  Random random(seed);
  for (int i = 0; i < inputs; ++i) {
    player.advance(random.between(0, 0.4));
    const double value = random.between(-0.5, 1.5);
    if (i % 3 == 0) player.set("speed", value);
    if (i % 3 == 1) player.set("aim", value);
    if (i % 3 == 2) player.send("jump");
  }
}

}  // namespace

TEST_CASE("a graph gives the same bits whatever the frames, forwards and back") {
  const auto graph = graph_of(rich());
  GraphPlayer coarse(graph), fine(graph);
  play_at_random(coarse, 5, 60);
  double time = 0;
  for (const GraphInput& input : coarse.inputs()) {
    while (time + 0.013 < input.time) fine.seek(time += 0.013);
    fine.seek(time = input.time);
    if (input.value)
      fine.set(input.name, *input.value);
    else
      fine.send(input.name);
  }
  fine.seek(coarse.time());
  CHECK(fine.hash() == coarse.hash());
  const double end = coarse.time();
  std::vector<std::vector<Motion>> forwards;
  for (int i = 0; i <= 200; ++i) forwards.push_back(pose_at(coarse, end * i / 200));
  for (int i = 200; i >= 0; --i) {
    CHECK(same_bits(pose_at(coarse, end * i / 200), forwards[static_cast<std::size_t>(i)]));
    CHECK(same_bits(pose_at(fine, end * i / 200), forwards[static_cast<std::size_t>(i)]));
  }
}

TEST_CASE("a graph saved and loaded goes on as it would have") {
  const auto graph = graph_of(rich());
  GraphPlayer player(graph), other(graph);
  play_at_random(player, 9, 30);
  const std::vector<std::byte> saved = player.save();
  other.load(saved);
  CHECK(other.time() == player.time());
  CHECK(other.hash() == player.hash());
  CHECK(other.inputs() == player.inputs());
  play_at_random(player, 10, 20);
  play_at_random(other, 10, 20);
  CHECK(other.hash() == player.hash());
  CHECK(same_bits(pose_at(other, other.time()), pose_at(player, player.time())));
  CHECK(other.save() == player.save());
}

TEST_CASE("hostile bytes are refused and change nothing") {
  const auto graph = graph_of(rich());
  GraphPlayer player(graph), victim(graph);
  play_at_random(player, 9, 12);
  play_at_random(victim, 3, 5);
  const std::uint64_t before = victim.hash();
  const std::vector<std::byte> saved = player.save();
  for (std::size_t cut = 0; cut < saved.size(); ++cut)
    CHECK_THROWS_AS(victim.load(std::span(saved).first(cut)), std::invalid_argument);
  for (std::size_t i = 0; i < saved.size(); ++i) {
    std::vector<std::byte> flipped = saved;
    flipped[i] ^= std::byte{0x10};
    CHECK_THROWS_AS(victim.load(flipped), std::invalid_argument);
  }
  GraphDescription renamed = rich();
  renamed.parameters[1].name = "gaze";
  std::get<LayersPose>(renamed.poses[2].operation).layers[0].weight = ByParameter{"gaze"};
  GraphPlayer stranger(graph_of(renamed));
  CHECK_THROWS_WITH_AS(stranger.load(saved), doctest::Contains("of another graph"), std::invalid_argument);
  CHECK(victim.hash() == before);
}

TEST_CASE("going back and doing something else forgets what was done later") {
  const auto graph = graph_of(rich());
  GraphPlayer changed(graph), fresh(graph);
  for (GraphPlayer* player : {&changed, &fresh}) {
    player->seek(0.5);
    player->set("speed", 1);
  }
  changed.seek(1);
  changed.send("jump");
  changed.seek(2);
  changed.set("aim", 0.7);
  changed.seek(0.8);
  fresh.seek(0.8);
  for (GraphPlayer* player : {&changed, &fresh}) {
    player->set("speed", 0.2);
    player->seek(3);
  }
  CHECK(changed.inputs() == fresh.inputs());
  CHECK(changed.hash() == fresh.hash());
  CHECK(same_bits(pose_at(changed, 2.5), pose_at(fresh, 2.5)));
}

TEST_CASE("what the description gives is there whatever the caller does") {
  GraphDescription described = rich();
  described.inputs = {{1, "jump"}, {0.5, "speed", 1}, {2.5, "speed", 0}};
  GraphPlayer player(graph_of(described));
  player.seek(3);
  player.seek(0.2);
  player.set("aim", 1);
  player.seek(2.6);
  CHECK(player.inputs() ==
        std::vector<GraphInput>{{0.2, "aim", 1}, {0.5, "speed", 1}, {1, "jump", {}}, {2.5, "speed", 0}});
  CHECK(player.passages(0).size() == 2);
}

TEST_CASE("a half-life too short to be seen is none") {
  for (const double half_life : {0.0, 5e-324, 1e-300, 1e-10}) {
    GraphDescription described = rich();
    described.parameters[0].half_life = half_life;
    GraphPlayer player(graph_of(described));
    player.seek(0.2);
    player.set("speed", 1);
    const Sample<double> now = player.parameter("speed");
    CHECK(now.value == 1);
    CHECK(now.rate == 0);
    CHECK(now.acceleration == 0);
  }
}

TEST_CASE("poses follow a parameter that was set without a jump in value or rate") {
  GraphPlayer player(graph_of(rich()));
  player.seek(0.2);
  player.set("speed", 1);
  player.seek(0.3);
  CHECK(player.parameter("speed").value > 0.1);
  CHECK(player.parameter("speed").value < 0.9);
  const Sample<double> before = player.parameter("speed");
  player.set("speed", -2);
  CHECK(near(player.parameter("speed").value, before.value, 1e-15));
  CHECK(near(player.parameter("speed").rate, before.rate, 1e-15));
  player.seek(4);
  CHECK(near(player.parameter("speed").value, -2.0, 1e-9));
}

TEST_CASE("a gliding parameter arrives at what was set after 32 half-lives, without a jump that could be seen") {
  const double half_life = 0.25, arrival = 0.2 + 32 * half_life;
  GraphDescription described = rich();
  described.parameters[0].half_life = half_life;
  described.parameters[0].start = 3;
  for (const double goal : {1.0, -2.0, 0.0, 1e9, -1e-9}) {
    GraphPlayer player(graph_of(described));
    player.seek(0.2);
    player.set("speed", goal);
    player.seek(0.21);
    player.set("speed", goal);  // in full flight
    player.seek(std::nextafter(arrival + 0.01, 0.0));
    const double way = std::abs(3 - goal);
    const Sample<double> last = player.parameter("speed");
    CHECK(std::abs(last.value - goal) <= 1e-17 * way + 1.2e-16 * std::abs(goal));
    CHECK(std::abs(last.rate) <= 1e-16 * way);
    player.seek(std::nextafter(arrival + 0.01, 9.0));
    CHECK(player.parameter("speed").value == goal);
    CHECK(player.parameter("speed").rate == 0);
  }
}

TEST_CASE("blends and layers have the exact rate of what they show, those of their weights included") {
  const Curve<double> weight =
      keyed_curve<double>({{.time = 0, .value = 0.2, .ease = Ease::smooth()}, {.time = 6, .value = 0.9}});
  GraphDescription described = rich();
  std::get<LayersPose>(described.poses[2].operation).layers[1].weight = weight;
  GraphPlayer player(graph_of(described));
  player.set("speed", 0.8);
  player.seek(0.3);
  player.send("jump");
  player.seek(6);
  for (const double time : {0.11, 0.27, 0.41, 0.73, 1.9, 2.44, 3.1, 5.1}) {
    CAPTURE(time);
    CHECK(rate_error(player, time) < 1e-6);
  }
}

TEST_CASE("a layer of weight 0 shows what lies below it, and of weight 1 itself, bit for bit") {
  GraphDescription described = {
      .parameters = {{.name = "aim"}},
      .poses = {{"all", LayersPose{.base = "walk", .layers = {{.pose = "jump", .weight = ByParameter{"aim"}}}}}}};
  GraphPlayer player(graph_of(described));
  std::vector<Motion> walk(4), jump(4);
  Animation(limb(), *three_clips(), {{.clip = 1}}).sample(0.7, walk);
  Animation(limb(), *three_clips(), {{.clip = 2}}).sample(0.7, jump);
  CHECK(same_bits(pose_at(player, 0.7), walk));
  player.set("aim", 1);
  CHECK(same_bits(pose_at(player, 0.7), jump));
  player.set("aim", 40);
  CHECK(same_bits(pose_at(player, 0.7), jump));
}

TEST_CASE("events come from the clips that show, with how much of them shows, each once") {
  GraphDescription described = {.parameters = {{.name = "w"}},
                                .poses = {{"mix", BlendPose{{{"idle", 0.75}, {"walk", ByParameter{"w"}}}}}}};
  GraphPlayer player(graph_of(described));
  const std::vector<GraphEvent> alone = player.events(-1, 2.6);
  REQUIRE(alone.size() == 2);
  CHECK(alone[0].name == "breath");
  CHECK(alone[1].time == 2.5);
  player.set("w", 0.25);
  std::vector<GraphEvent> all;
  for (double from = -1, to = 0.1; to < 4; from = to, to += 0.3)
    for (const GraphEvent& event : player.events(from, to)) all.push_back(event);
  std::vector<std::string> names;
  for (const GraphEvent& event : all) names.push_back(event.name);
  CHECK(names == std::vector<std::string>{"left", "breath", "right", "left", "breath", "right"});
  CHECK(all[1].weight == 0.75);
  CHECK(all[2].weight == 0.25);
}

TEST_CASE("a clip that started before its graph tells nothing from before, and the interval that it is in") {
  std::vector<Clip> clips = {moving("walk", 4, LoopMode::repeat)};
  clips[0].events = {{0.25, 0.25, "past", ""}, {0.3, 0.75, "over", ""}, {0.4, 0.45, "gone", ""}, {0.5, 0.5, "now", ""}};
  GraphPlayer player(graph_of({.poses = {{"x", ClipPose{.clip = "walk", .at = -0.5}}}},
                              std::make_shared<const std::vector<Clip>>(std::move(clips))));
  std::string told;
  for (const GraphEvent& event : player.events(-1, 1.6))
    told += event.name + " " + std::to_string(static_cast<int>(event.kind)) + " at " + number_text(event.time) + "\n";
  CHECK(told == "over 1 at 0\nnow 0 at 0\nover 2 at 0.25\n");
  CHECK(player.events(0, 0.2).empty());
}

TEST_CASE("what lies below a graph shows where its clips do nothing") {
  const auto graph = graph_of({.poses = {{"walk", ClipPose{"walk"}}}});
  const Motion high = [] {
    Motion motion;
    motion.pose.position = {7, 8, 9};
    motion.twist.linear = {1, 2, 3};
    return motion;
  }();
  GraphPlayer player(graph, {.pose = [&](double, Side, std::span<Motion> out) { std::ranges::fill(out, high); }});
  const std::vector<Motion> pose = pose_at(player, 0.3);
  CHECK(pose[3].pose.position == high.pose.position);
  CHECK(pose[3].twist.linear == high.twist.linear);
  CHECK(pose[0].pose.position != high.pose.position);
}

TEST_CASE("a player refuses what is no input, and stays as it was") {
  GraphPlayer player(graph_of(rich()));
  const std::uint64_t before = player.hash();
  CHECK_THROWS_WITH_AS(player.set("sped", 1), "there is no parameter \"sped\"; did you mean \"speed\"?",
                       std::invalid_argument);
  CHECK_THROWS_AS(player.set("speed", std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  CHECK_THROWS_AS(player.advance(-1e-9), std::invalid_argument);
  CHECK_THROWS_AS(player.advance(std::numeric_limits<double>::infinity()), std::invalid_argument);
  CHECK_THROWS_AS(player.seek(-0.1), std::invalid_argument);
  CHECK(player.hash() == before);
}

TEST_CASE("a machine that settles for ever keeps little, and goes back far to the same bits, under springs too") {
  const GraphChange settle{GraphChange::Kind::quintic, 0.3};
  const GraphDescription description{
      .poses = {
          {"legs",
           MachinePose{.start = "idle",
                       .states = {{"idle", "idle"}, {"walk", "walk"}},
                       .transitions = {{{"idle"}, "walk", {{GraphCondition::Kind::time_in_state, {}, 0.2}}, settle},
                                       {{"walk"}, "idle", {{GraphCondition::Kind::time_in_state, {}, 0.37}}, settle}}}},
          {"hat", SpringPose{.base = "legs", .node = "upper", .position = SpringSettings{.hz = 2}}}}};
  GraphPlayer player(graph_of(description)), other(graph_of(description));
  std::vector<std::vector<Motion>> seen;
  for (int i = 0; i < 20; ++i) seen.push_back(pose_at(player, 0.25 * i));
  player.seek(120);  // it keeps no more than 320 offsets
  const std::vector<Motion> last = pose_at(player, 120);
  const std::uint64_t hash = player.hash();
  for (const int i : {3, 19, 0, 11}) CHECK(same_bits(pose_at(player, 0.25 * i), seen[static_cast<std::size_t>(i)]));
  CHECK(player.hash() == hash);
  CHECK(same_bits(pose_at(player, 120), last));
  CHECK(same_bits(pose_at(other, 120), last));
  other.seek(30);
  player.seek(30);
  other.seek(130);
  player.advance(100);
  CHECK(other.hash() == player.hash());
  CHECK(same_bits(pose_at(player, 130), pose_at(other, 130)));
}
