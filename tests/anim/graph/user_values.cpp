// Tracks of the user's own, mixed by plays and graphs as poses are.

#include "graph_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Curve<double> ramp(double from, double to) {
  return keyed_curve<double>({{.time = 0, .value = from, .ease = Ease::linear()}, {.time = 2, .value = to}});
}

/// "idle" and "walk" with tracks of every kind, "jump" with none.
std::vector<Clip> clips_with_values() {
  std::vector<Clip> clips = *three_clips();
  for (std::size_t c = 0; c < 2; ++c) {
    const double own = c == 0 ? 0.2 : 1;
    const std::string word = c == 0 ? "calm" : "quick";
    clips[c].tracks.push_back({"upper", "effort", ramp(c == 0 ? 0 : own, c == 0 ? own : 0)});
    clips[c].tracks.push_back({"upper", "glow", Curve<Color>(Color{Vec4(own, 0, 1 - own, c == 0 ? 1 : 0.5)})});
    clips[c].tracks.push_back({"lower", "wind", Curve<Vec3>(Vec3(own, 2, -own))});
    clips[c].tracks.push_back({"lower", "lit", StepCurve<bool>({{0, c == 1}})});
    clips[c].tracks.push_back({"lower", "mood", StepCurve<std::string>({{0, word}})});
    clips[c].tracks.push_back({"lower", "aim", Curve<Quat>(exp_map({0, own, 0}))});
  }
  return clips;
}

std::shared_ptr<const std::vector<Clip>> shared_clips() {
  return std::make_shared<const std::vector<Clip>>(clips_with_values());
}

Sample<double> number(const UserValue& value) {
  return std::get<Sample<double>>(value);
}

GraphPlayer player_of(GraphDescription description) {
  return GraphPlayer(graph_of(std::move(description), shared_clips()));
}

}  // namespace

TEST_CASE("user tracks go through blends and fades as poses do, with their rates") {
  using Kind = GraphCondition::Kind;
  GraphPlayer player =
      player_of({.poses = {{"mixed", BlendPose{{{"idle", 1.0}, {"walk", 3.0}}}},
                           {"body", MachinePose{.start = "idle",
                                                .states = {{"idle", "idle"}, {"mixed", "mixed"}},
                                                .transitions = {{.to = "mixed",
                                                                 .when = {{Kind::time_in_state, {}, 0.5}},
                                                                 .change = {.seconds = 0.4}}}}}}});
  const auto effort = [&](double time) { return number(player.user_value_at("upper.effort", time)); };
  CHECK(near(effort(0.3).value, 0.2 * 0.15, 1e-15));
  CHECK(near(effort(0.3).rate, 0.1, 1e-15));
  CHECK(near(effort(1.4).value, 0.25 * 0.2 * 0.45 + 0.75 * 0.55, 1e-12));
  CHECK(near(effort(1.4).rate, 0.25 * 0.1 - 0.75 * 0.5, 1e-12));
  // Half way through the fade; u^2 (3 - 2 u) rises at 1.5 / 0.4 s.
  const double before = 0.2 * 0.35, after = 0.25 * 0.2 * 0.1 + 0.75 * 0.9;
  CHECK(near(effort(0.7).value, 0.5 * (before + after), 1e-12));
  CHECK(near(effort(0.7).rate, 0.5 * (0.1 + 0.25 * 0.1 - 0.75 * 0.5) + 1.5 / 0.4 * (after - before), 1e-12));

  // Colors on premultiplied coordinates: alpha .25 + .375, of which the first color has .25.
  const Color glow = std::get<Sample<Color>>(player.user_value_at("upper.glow", 1.4)).value;
  CHECK(near(glow.rgba, Vec4((0.25 * 0.2 + 0.375) / 0.625, 0, 0.25 * 0.8 / 0.625, 0.625), 1e-12));
  CHECK(near(std::get<Sample<Vec3>>(player.user_value_at("lower.wind", 1.4)).value, Vec3(0.8, 2, -0.8), 1e-12));
  CHECK(near(std::get<Sample<Quat>>(player.user_value_at("lower.aim", 1.4)).value, exp_map({0, 0.8, 0}), 1e-12));
  CHECK_FALSE(std::get<bool>(player.user_value_at("lower.lit", 0.2)));
  CHECK(std::get<bool>(player.user_value_at("lower.lit", 1.4)));
  CHECK(std::get<std::string>(player.user_value_at("lower.mood", 0.2)) == "calm");
  CHECK(std::get<std::string>(player.user_value_at("lower.mood", 1.4)) == "quick");
}

TEST_CASE("a clip without a user track shows what lies below: nothing, or what plays have") {
  const GraphDescription half{.name = "half", .poses = {{"half", BlendPose{{{"walk", 1.0}, {"jump", 1.0}}}}}};
  GraphPlayer alone = player_of(half);
  CHECK(near(number(alone.user_value_at("upper.effort", 0.5)).value, 0.5 * 0.75, 1e-15));
  // Against nothing, a color fades by its alpha.
  CHECK(near(std::get<Sample<Color>>(alone.user_value_at("upper.glow", 0.5)).value.rgba, Vec4(1, 0, 0, 0.25), 1e-15));

  const Animation plain(limb(), clips_with_values(), {Play{.clip = 0}});
  const Animation both = plain.with_graphs({half});
  CHECK(near(number(both.user_value("upper.effort", 0.5)).value, 0.5 * (0.75 + 0.05), 1e-15));
  CHECK(near(number(both.user_value("upper.effort", 0.5)).rate, 0.5 * (-0.5 + 0.1), 1e-15));
  CHECK(both.user_tracks() ==
        std::vector<std::string>{"upper.effort", "upper.glow", "lower.wind", "lower.lit", "lower.mood", "lower.aim"});
  CHECK(Animation(limb(), clips_with_values(), {Play{.clip = 2}}).user_tracks().empty());
  CHECK_THROWS_WITH(static_cast<void>(plain.user_value("upper.efort", 0)), doctest::Contains("upper.effort"));
  CHECK_THROWS_WITH(static_cast<void>(alone.user_value_at("uper.effort", 0)), doctest::Contains("upper.effort"));
}

TEST_CASE("layers go over and add user tracks where their masks reach") {
  const auto shown = [](bool adds, std::string reference, std::string masked) {
    std::vector<MaskPart> mask;
    if (!masked.empty()) mask = {{.joints = {masked}}};
    return player_of({.poses = {{"all", LayersPose{.base = "idle",
                                                   .layers = {{.pose = "walk",
                                                               .adds = adds,
                                                               .reference = std::move(reference),
                                                               .weight = 0.25,
                                                               .mask = std::move(mask)}}}}}});
  };
  const auto effort = [](GraphPlayer player) { return number(player.user_value_at("upper.effort", 0.5)); };
  const double base = 0.05, over = 0.75, rate = 0.1, over_rate = -0.5;
  CHECK(near(effort(shown(false, {}, {})).value, 0.75 * base + 0.25 * over, 1e-15));
  CHECK(near(effort(shown(false, {}, "upper")).value, 0.75 * base + 0.25 * over, 1e-15));
  CHECK(effort(shown(false, {}, "lower")).value == 0.05);
  CHECK(near(effort(shown(true, {}, {})).value, base + 0.25 * over, 1e-15));
  CHECK(near(effort(shown(true, {}, {})).rate, rate + 0.25 * over_rate, 1e-15));
  CHECK(near(effort(shown(true, "idle", {})).value, base + 0.25 * (over - base), 1e-15));
  CHECK(near(effort(shown(true, "idle", {})).rate, rate + 0.25 * (over_rate - rate), 1e-15));
}

TEST_CASE("layers that add, add morph weights and colors") {
  std::vector<Clip> clips = *three_clips();
  clips[0].tracks.push_back({"upper", "weights", WeightCurves{ramp(0.5, 0.5), ramp(0, 1)}});
  clips[1].tracks.push_back({"upper", "weights", WeightCurves{ramp(0, 1), ramp(0.25, 0.25)}});
  clips[0].tracks.push_back({"upper", "color", Curve<Color>(Color{Vec4(0.2, 0.4, 0.6, 1)})});
  clips[1].tracks.push_back({"upper", "color", Curve<Color>(Color{Vec4(0.9, 1, 1, 1)})});
  const GraphDescription adding{
      .name = "face",
      .poses = {{"all", LayersPose{.base = "idle", .layers = {{.pose = "walk", .adds = true, .weight = 0.5}}}}}};
  // The node itself is white, so what is added is half of (-0.1, 0, 0).
  const Animation animation = Animation(limb(), clips, {}).with_graphs({adding});
  const NodeLook look = animation.look(1, 1.5);
  CHECK(near(look.weights[0].value, 0.5 + 0.5 * 0.75, 1e-15));
  CHECK(near(look.weights[0].rate, 0.25, 1e-15));
  CHECK(near(look.weights[1].value, 0.75 + 0.5 * 0.25, 1e-15));
  CHECK(near(look.color->value.rgba, Vec4(0.15, 0.4, 0.6, 1), 1e-15));
}

TEST_CASE("layers add neither switches nor texts") {
  const auto adding = [](std::string base, std::string added) {
    return player_of({.poses = {{"all", LayersPose{.base = std::move(base),
                                                   .layers = {{.pose = std::move(added), .adds = true}}}}}});
  };
  GraphPlayer lacks_them = adding("walk", "jump");
  CHECK(std::get<std::string>(lacks_them.user_value_at("lower.mood", 0.5)) == "quick");
  CHECK(std::get<bool>(lacks_them.user_value_at("lower.lit", 0.5)));
  GraphPlayer has_others = adding("walk", "idle");
  CHECK(std::get<std::string>(has_others.user_value_at("lower.mood", 0.5)) == "quick");
  CHECK(std::get<bool>(has_others.user_value_at("lower.lit", 0.5)));
}

TEST_CASE("of switches and texts that several clips share, the weights count together") {
  std::vector<Clip> clips = clips_with_values();
  clips[2].tracks.push_back({"lower", "lit", StepCurve<bool>({{0, false}})});
  clips[2].tracks.push_back({"lower", "mood", StepCurve<std::string>({{0, "calm"}})});
  const auto shared = std::make_shared<const std::vector<Clip>>(std::move(clips));
  const auto shown = [&](double of_walk) {
    return GraphPlayer(
        graph_of({.poses = {{"all", BlendPose{{{"walk", of_walk}, {"idle", 0.3}, {"jump", 0.3}}}}}}, shared));
  };
  GraphPlayer less = shown(0.4), more = shown(0.7);
  CHECK(std::get<std::string>(less.user_value_at("lower.mood", 0.5)) == "calm");
  CHECK_FALSE(std::get<bool>(less.user_value_at("lower.lit", 0.5)));
  CHECK(std::get<std::string>(more.user_value_at("lower.mood", 0.5)) == "quick");
  CHECK(std::get<bool>(more.user_value_at("lower.lit", 0.5)));
}

TEST_CASE("layers add colors number by number, over nothing, over a reference and over a mix") {
  std::vector<Clip> clips = *three_clips();
  const Color own[] = {{Vec4(0, 0, 1, 1)}, {Vec4(1, 0, 0, 1)}, {Vec4(0, 1, 0, 0.5)}};
  for (std::size_t c = 0; c < 3; ++c)
    for (const char* name : {"glow", "color"}) clips[c].tracks.push_back({"upper", name, Curve<Color>(own[c])});
  using Layer = LayersPose::Layer;
  const auto shown = [&](std::string base, const Layer& layer) {
    const GraphDescription description{.poses = {{"mixed", BlendPose{{{"idle", 1.0}, {"jump", 1.0}}}},
                                                 {"all", LayersPose{.base = std::move(base), .layers = {layer}}}}};
    return Animation(limb(), clips, {}).with_graphs({description});
  };
  const auto glow = [](const Animation& animation, double time = 0.5) {
    return std::get<Sample<Color>>(animation.user_value("upper.glow", time));
  };
  const auto color = [](const Animation& animation) { return animation.look(1, 0.5).color->value.rgba; };

  // Nothing below a track of the user's own is transparent black, and below a node's color it is white.
  const Animation whole = shown("idle", {.pose = "walk", .adds = true});
  CHECK(near(glow(whole).value.rgba, Vec4(1, 0, 1, 2), 1e-15));
  CHECK(near(color(whole), Vec4(0, -1, 0, 1), 1e-15));
  const Animation quarter = shown("idle", {.pose = "walk", .adds = true, .weight = 0.25});
  CHECK(near(glow(quarter).value.rgba, Vec4(0.25, 0, 1, 1.25), 1e-15));
  const Animation differing = shown("idle", {.pose = "walk", .adds = true, .reference = "jump"});
  CHECK(near(glow(differing).value.rgba, Vec4(1, -1, 1, 1.5), 1e-15));
  CHECK(near(color(differing), Vec4(1, -1, 1, 1.5), 1e-15));

  // What is below is mixed on premultiplied coordinates first: (0, 1/3, 2/3) with an alpha of 3/4.
  const Animation over_mix = shown("mixed", {.pose = "walk", .adds = true, .reference = "idle", .weight = 0.5});
  CHECK(near(glow(over_mix).value.rgba, Vec4(0.5, 1.0 / 3, 2.0 / 3 - 0.5, 0.75), 1e-15));
  CHECK(near(color(over_mix), Vec4(0.5, 1.0 / 3, 2.0 / 3 - 0.5, 0.75), 1e-15));

  // A weight that rises by 1/4 per second brings the difference in at that rate.
  const Animation rising = shown("idle", {.pose = "walk", .adds = true, .reference = "jump", .weight = ramp(0, 0.5)});
  CHECK(near(glow(rising, 1).value.rgba, Vec4(0.25, -0.25, 1, 1.125), 1e-15));
  CHECK(near(glow(rising, 1).rate, Vec4(0.25, -0.25, 0, 0.125), 1e-15));
}

TEST_CASE("what an animation shows of colors and morph weights is what its graphs make of them") {
  std::vector<Clip> clips = *three_clips();
  for (std::size_t c = 0; c < 2; ++c)
    clips[c].tracks.push_back({"upper", "color", Curve<Color>(Color{Vec4(c == 0 ? 0.2 : 1, 0, 0, 1)})});
  const Animation animation = Animation(limb(), clips, {Play{.clip = 0}})
                                  .with_graphs({{.name = "g", .poses = {{"walk 2", ClipPose{.clip = "walk"}}}}});
  CHECK(animation.look(1, 0.7).color->value.rgba == Vec4(1, 0, 0, 1));
}

TEST_CASE("plays mix user tracks by their weights, fades and masks, the ends bit for bit") {
  const auto shown = [](const Play& upper) { return Animation(limb(), clips_with_values(), {Play{.clip = 0}, upper}); };
  const Animation fading = shown(Play{.clip = 1, .at = 0.5, .fade_in = 1});
  // As long as it has not begun it has no say; half way in, its weight is 1/2.
  CHECK(number(fading.user_value("upper.effort", 0.25)).value == number(UserValue(ramp(0, 0.2).sample(0.25))).value);
  const Sample<double> weight = fading.players()[1].weight(1.0);
  const Sample<double> below = ramp(0, 0.2).sample(1.0), over = ramp(1, 0).sample(0.5);
  const Sample<double> half = number(fading.user_value("upper.effort", 1.0));
  CHECK(near(half.value, (1 - weight.value) * below.value + weight.value * over.value, 1e-15));
  CHECK(near(half.rate,
             (1 - weight.value) * below.rate + weight.value * over.rate + weight.rate * (over.value - below.value),
             1e-14));
  CHECK(number(fading.user_value("upper.effort", 1.75)).value == ramp(1, 0).value(1.25));
  CHECK(std::get<std::string>(fading.user_value("lower.mood", 0.75)) == "calm");
  CHECK(std::get<std::string>(fading.user_value("lower.mood", 1.25)) == "quick");
  const Animation masked = shown(Play{.clip = 1, .mask = {"upper"}});
  CHECK(number(masked.user_value("upper.effort", 0.5)).value == ramp(1, 0).value(0.5));
  CHECK(std::get<std::string>(masked.user_value("lower.mood", 0.5)) == "calm");
}

TEST_CASE("of texts in plays over each other, the one with the largest weight of all shows") {
  // .45 over .45 over 1 leaves .55 * .55 = .3025 of the lowest, and .55 * .45 = .2475 of the one in between.
  const auto shown = [](const std::vector<std::string>& moods) {
    std::vector<Clip> clips = *three_clips();
    std::vector<Play> plays;
    for (std::size_t c = 0; c < 3; ++c) {
      clips[c].tracks.push_back({"lower", "mood", StepCurve<std::string>({{0, moods[c]}})});
      plays.push_back({.clip = c, .weight = Curve<double>(c == 0 ? 1.0 : 0.45)});
    }
    return std::get<std::string>(Animation(limb(), clips, plays).user_value("lower.mood", 0.5));
  };
  CHECK(shown({"low", "middle", "high"}) == "high");
  CHECK(shown({"low", "low", "high"}) == "low");
  CHECK(shown({"same", "other", "same"}) == "same");
  CHECK(shown({"low", "high", "high"}) == "high");
}

TEST_CASE("a user track gains in each round of a loop with offset, and is of the kind that its first clip gives it") {
  std::vector<Clip> clips = *three_clips();
  clips[0].loop = {.mode = LoopMode::repeat_offset};
  clips[0].tracks.push_back({"upper", "way", ramp(1, 4)});
  clips[1].tracks.push_back({"upper", "way", Curve<Vec3>(Vec3(1, 2, 3))});
  const Animation animation(limb(), clips, {Play{.clip = 0}, Play{.clip = 1}});
  CHECK(near(number(animation.user_value("upper.way", 4.5)).value, 1 + 1.5 * 4.5, 1e-12));
  CHECK(near(number(animation.user_value("upper.way", 4.5)).rate, 1.5, 1e-15));
}

TEST_CASE("user tracks of a graph that never rests have the rates of their values") {
  const Curve<double> swell = keyed_curve<double>({{.time = 0, .value = 0.1, .ease = Ease::smooth()},
                                                   {.time = 1, .value = 0.9, .ease = Ease::smooth()},
                                                   {.time = 3, .value = 0.3}});
  using Kind = GraphCondition::Kind;
  GraphPlayer player = player_of(
      {.parameters = {{.name = "speed", .half_life = 0.2}},
       .poses = {{"gaits", SpacePose{.by = {ByParameter{"speed"}},
                                     .entries = {{"idle", {0, 0}}, {"walk", {1, 0}}},
                                     .sync = std::string()}},
                 {"more", LayersPose{.base = "gaits", .layers = {{.pose = "walk", .adds = true, .weight = swell}}}},
                 {"body", MachinePose{.start = "a",
                                      .states = {{"a", "more"}, {"b", "idle"}},
                                      .transitions = {{{"a"}, "b", {{Kind::event, "go"}}, {.seconds = 0.7}},
                                                      {{"b"}, "a", {{Kind::event, "go"}}, {.seconds = 0.5}}}}}},
       .inputs = {{0.3, "speed", 0.8}, {0.6, "go", {}}, {1.0, "go", {}}, {1.2, "speed", 0.1}, {1.3, "go", {}}}});
  for (const std::string track : {"upper.effort", "lower.wind", "upper.glow"})
    for (const double time : {0.2, 0.45, 0.8, 1.1, 1.25, 1.57, 1.9, 2.4}) {
      CAPTURE(track);
      CAPTURE(time);
      const auto numbers = [&](double at) {
        const UserValue value = player.user_value_at(track, at);
        if (const auto* one = std::get_if<Sample<double>>(&value))
          return std::pair(Vec4(one->value, 0, 0, 0), Vec4(one->rate, 0, 0, 0));
        if (const auto* three = std::get_if<Sample<Vec3>>(&value))
          return std::pair(Vec4(three->value.x(), three->value.y(), three->value.z(), 0),
                           Vec4(three->rate.x(), three->rate.y(), three->rate.z(), 0));
        const auto& color = std::get<Sample<Color>>(value);
        return std::pair(color.value.rgba, color.rate);
      };
      const double h = 1e-4;
      const Vec4 slope = (8 * (numbers(time + h).first - numbers(time - h).first) -
                          (numbers(time + 2 * h).first - numbers(time - 2 * h).first)) /
                         (12 * h);
      CHECK(near(numbers(time).second, slope, 1e-8));
    }
}
