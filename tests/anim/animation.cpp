#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Curve<Vec3> places(std::uint64_t seed) {
  Random random(seed);
  std::vector<Key<Vec3>> keys;
  for (int i = 0; i < 5; ++i) keys.push_back({.time = 0.5 * i, .value = random.vector(1), .ease = Ease::smooth()});
  return keyed_curve<Vec3>(keys);
}
Curve<Quat> turns(std::uint64_t seed) {
  Random random(seed);
  std::vector<Key<Quat>> keys;
  for (int i = 0; i < 5; ++i) keys.push_back({.time = 0.5 * i, .value = random.rotation(), .ease = Ease::smooth()});
  return keyed_curve<Quat>(keys);
}

std::shared_ptr<const Hierarchy> arm() {
  return std::make_shared<const Hierarchy>(std::vector<Node>{{"shoulder", no_node, {.position = {0, 1, 0}}},
                                                             {"elbow", 0, {.position = {0.3, 0, 0}}},
                                                             {"wrist", 1, {.position = {0.25, 0, 0}}},
                                                             {"hat", no_node, {.position = {0, 2, 0}}}});
}

Clip waving(const std::string& name, std::uint64_t seed) {
  Clip clip;
  clip.name = name;
  clip.duration = 2;
  clip.tracks = {{"shoulder", "position", places(seed)},
                 {"shoulder", "rotation", turns(seed + 1)},
                 {"elbow", "rotation", turns(seed + 2)},
                 {"wrist", "rotation", turns(seed + 3)}};
  return clip;
}

}  // namespace

TEST_CASE("during a cross-fade the tip of a chain has the exact derivative, the rate of the weight included") {
  const auto weight =
      keyed_curve<double>({{.time = 0.5, .value = 0.0, .ease = Ease::smooth()}, {.time = 1.5, .value = 1.0}});
  const Animation animation(arm(), {waving("a", 1), waving("b", 20)},
                            {{.clip = 0}, {.clip = 1, .at = 0.25, .speed = 0.7, .weight = weight}});
  const double h = 1e-4;
  for (const double time : {0.61, 0.93, 1.07, 1.34, 1.9}) {
    const auto at = [&](double t) { return animation.world(2, t); };
    const Vec3 stencil = (8 * (at(time + h).motion.pose.position - at(time - h).motion.pose.position) -
                          (at(time + 2 * h).motion.pose.position - at(time - 2 * h).motion.pose.position)) /
                         (12 * h);
    CHECK(near(at(time).motion.twist.linear, stencil, 1e-9));
    const auto turned = [&](double d) {
      return log_map(at(time + d).motion.pose.rotation * at(time - d).motion.pose.rotation.conjugate());
    };
    const Vec3 one = turned(h), two = turned(2 * h);
    const Vec3 spin = (8 * one - two) / (12 * h);
    CHECK(near(at(time).motion.twist.angular, spin, 1e-8));
  }
}

TEST_CASE("weights 0 and 1 give the clips bit for bit") {
  const Animation a(arm(), {waving("a", 1)}, {{.clip = 0}}), b(arm(), {waving("b", 20)}, {{.clip = 0}});
  for (const double weight : {0.0, 1.0}) {
    const Animation both(arm(), {waving("a", 1), waving("b", 20)},
                         {{.clip = 0}, {.clip = 1, .weight = Curve<double>(weight)}});
    for (const double time : {0.0, 0.3, 1.7, 2.0}) {
      for (std::size_t node = 0; node < 4; ++node) {
        const Motion mixed = both.sample_node(node, time), pure = (weight == 0 ? a : b).sample_node(node, time);
        CHECK(mixed.pose.position == pure.pose.position);
        CHECK(mixed.pose.rotation.coeffs() == pure.pose.rotation.coeffs());
        CHECK(mixed.twist.linear == pure.twist.linear);
        CHECK(mixed.twist.angular == pure.twist.angular);
      }
    }
  }
}

TEST_CASE("a node that no track drives keeps its rest pose, and a mask keeps a play off the others") {
  const Animation animation(arm(), {waving("a", 1)}, {{.clip = 0, .mask = {"elb*"}}});
  CHECK(animation.sample_node(3, 1.0).pose.position == Vec3(0, 2, 0));
  CHECK(animation.sample_node(0, 1.0).pose.position == Vec3(0, 1, 0));
  CHECK_FALSE(animation.sample_node(1, 1.0).pose.rotation.coeffs() == Quat::Identity().coeffs());
  CHECK(animation.animates(2));  // through its parent
  CHECK_FALSE(animation.animates(0));
  CHECK_FALSE(animation.animates(3));
}

TEST_CASE("a relative track composes with the rest pose") {
  Clip clip;
  clip.duration = 1;
  clip.tracks = {{"elbow", "position", Curve<Vec3>(Vec3(0, 0.5, 0)), true}};
  const Animation animation(arm(), {clip}, {{}});
  CHECK(near(animation.sample_node(1, 0.0).pose.position, Vec3(0.3, 0.5, 0), 1e-15));
}

TEST_CASE("a repeat-offset loop goes on from where it was and turns on from where it faced") {
  Clip clip;
  clip.duration = 1;
  clip.loop = {LoopMode::repeat_offset, 0};
  clip.tracks = {{"hat", "position",
                  keyed_curve<Vec3>({{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::linear()},
                                     {.time = 1, .value = Vec3(2, 0, 0)}})},
                 {"hat", "rotation",
                  keyed_curve<Quat>({{.time = 0, .value = Quat(1, 0, 0, 0), .ease = Ease::linear()},
                                     {.time = 1, .value = exp_map(Vec3(0, 0.5, 0))}})}};
  const Animation animation(arm(), {clip}, {{}});
  const Motion later = animation.sample_node(3, 3.25);
  CHECK(near(later.pose.position, Vec3(6.5, 0, 0), 1e-14));
  CHECK(near(later.pose.rotation, exp_map(Vec3(0, 3.25 * 0.5, 0)), 1e-14));
  CHECK(near(later.twist.angular, Vec3(0, 0.5, 0), 1e-14));
}

TEST_CASE("tracks that fit no node and tracks of the wrong type are all named") {
  Clip clip;
  clip.name = "wrong";
  clip.tracks = {{"nobody", "position", Curve<Vec3>(Vec3(0, 0, 0))}, {"hat", "rotation", Curve<double>(1.0)}};
  CHECK_THROWS_WITH_AS(Animation(nullptr, {}, {}), "an animation needs nodes", std::invalid_argument);
  CHECK_THROWS_WITH_AS(Animation(arm(), {clip}, {}),
                       "clips do not fit their nodes:\n  clip \"wrong\": there is no node \"nobody\"\n"
                       "  clip \"wrong\": track \"hat.rotation\" must carry rotations",
                       std::invalid_argument);
}

TEST_CASE("patterns match as people expect") {
  CHECK(matches("arm/*", "arm/left"));
  CHECK(matches("*", ""));
  CHECK(matches("a*b*c", "a-b-b-c"));
  CHECK_FALSE(matches("arm/*", "leg/left"));
  CHECK_FALSE(matches("arm", "arm2"));
}

TEST_CASE("before a play starts its first frame holds, with the weight it has then") {
  const auto fade = keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::linear()}, {.time = 1, .value = 1.0}});
  Clip clip;
  clip.name = "up";
  clip.duration = 1;
  clip.tracks = {{"hat", "position", Curve<Vec3>(Vec3(0, 4, 0))}};
  const Animation faded(arm(), {clip}, {{.clip = 0, .at = 1, .weight = fade}});
  CHECK(near(faded.sample_node(3, 0.5).pose.position, Vec3(0, 2, 0), 1e-15));
  CHECK(near(faded.sample_node(3, 1.5).pose.position, Vec3(0, 3, 0), 1e-15));
  const Animation whole(arm(), {clip}, {{.clip = 0, .at = 1}});
  CHECK(near(whole.sample_node(3, 0.5).pose.position, Vec3(0, 4, 0), 1e-15));
}

namespace {

bool same(const Motion& a, const Motion& b) {
  return a.pose.position == b.pose.position && a.pose.rotation.coeffs() == b.pose.rotation.coeffs() &&
         a.pose.scale == b.pose.scale && a.twist.linear == b.twist.linear && a.twist.angular == b.twist.angular &&
         a.scale_rate == b.scale_rate;
}

// Everything at once: a fade, a mask, a play that starts later, a loop with offset, a relative track.
Animation busy() {
  const auto fade =
      keyed_curve<double>({{.time = 0.5, .value = 0.0, .ease = Ease::smooth()}, {.time = 1.5, .value = 1.0}});
  Clip lifted = waving("lifted", 40);
  lifted.loop = {LoopMode::repeat_offset, 0};
  lifted.tracks.push_back({"hat", "position", places(50), true});
  return {arm(),
          {waving("a", 1), waving("b", 20), lifted},
          {{.clip = 0},
           {.clip = 1, .at = 0.25, .speed = 0.7, .weight = fade},
           {.clip = 2, .at = 1, .speed = 1.3, .mask = {"hat", "wr*"}}}};
}

}  // namespace

TEST_CASE("a whole pose and its nodes one by one are the same bits") {
  const Animation animation = busy();
  const ClockOverride later{.stage = 2, .timeline = 0.8},
      alone{.stage = 1.2, .timeline = 1, .clip = 1, .starts_by = 0.5};
  for (const ClockOverride& clock : {ClockOverride{}, later, alone})
    for (const Side side : {Side::in, Side::out})
      for (const double time : {0.0, 0.25, 0.4, 1.0, 1.31, 1.5, 2.0, 5.7}) {
        std::vector<Motion> pose(4);
        animation.sample(time, pose, side, clock);
        for (std::size_t node = 0; node < 4; ++node)
          CHECK(same(pose[node], animation.sample_node(node, time, side, clock)));
      }
}

TEST_CASE("where nodes came later, the pose of those before is written and nothing beside it") {
  Hierarchy nodes = *arm();
  nodes.add({.name = "late", .parent = 0, .rest = {.position = {0, 0, 1}}});
  const Animation animation = busy().with_more_nodes(std::make_shared<const Hierarchy>(nodes));
  std::vector<Motion> pose(5);
  pose[4].pose.position = Vec3(7, 8, 9);
  animation.sample(0.4, std::span(pose).first(4));
  for (std::size_t node = 0; node < 4; ++node) CHECK(same(pose[node], animation.sample_node(node, 0.4)));
  CHECK(pose[4].pose.position == Vec3(7, 8, 9));
  animation.sample(0.4, pose);
  CHECK(pose[4].pose.position == Vec3(0, 0, 1));
}

TEST_CASE("by another clock plays and their weights are where they were to be at its time") {
  const Animation animation = busy();
  const ClockOverride held{.stage = 3, .timeline = 1.125};
  for (const double since : {0.0, 0.25, 0.875})
    for (std::size_t node = 0; node < 4; ++node)
      CHECK(same(animation.sample_node(node, 3 + since, Side::out, held),
                 animation.sample_node(node, 1.125 + since, Side::out)));
}

TEST_CASE("a clip alone is followed whole, by the play that it has or from where it is said to start") {
  const Animation animation = busy();
  const Animation pure(arm(), {waving("b", 20)}, {{.clip = 0, .at = 0.25, .speed = 0.7}});
  const Animation none(arm(), {waving("a", 1), waving("b", 20)}, {{.clip = 0}});
  const Animation fresh(arm(), {waving("b", 20)}, {{.clip = 0, .at = 2}});
  const ClockOverride alone{.clip = 1, .starts_by = 2};
  for (const double time : {2.0, 2.5, 3.25})
    for (std::size_t node = 0; node < 4; ++node) {
      CHECK(same(animation.sample_node(node, time, Side::out, alone), pure.sample_node(node, time)));
      CHECK(same(none.sample_node(node, time, Side::out, alone), fresh.sample_node(node, time)));
    }
  std::vector<double> starts;
  none.for_each_play(alone, 2, [&](const RunningPlay& play) { starts.push_back(play.at()); });
  CHECK(starts == std::vector<double>{2});
  starts.clear();
  none.for_each_play(alone, 3, [&](const RunningPlay& play) { starts.push_back(play.at()); });
  CHECK(starts.empty());
}

TEST_CASE("the first play's morph weights and color fade from what the node shows at rest") {
  Node face{"face"};
  face.color = Color{Vec4(1, 0, 0, 1)};
  face.weights = {0.5, 1};
  const auto nodes = std::make_shared<const Hierarchy>(std::vector<Node>{face, {"plain"}});
  const auto fade = keyed_curve<double>({{.time = 0, .value = 0.0, .ease = Ease::linear()}, {.time = 2, .value = 1.0}});
  const Curve<Color> green(Color{Vec4(0, 1, 0, 1)});
  const WeightCurves weights{Curve<double>(1.0), Curve<double>(0.0), Curve<double>(0.25)};
  Clip clip{.name = "look", .duration = 5};
  clip.tracks = {{"face", "color", green}, {"face", "weights", weights}, {"plain", "weights", weights}};
  const Animation animation(nodes, {clip}, {{.clip = 0, .weight = fade}});

  const NodeLook half = animation.look(0, 1);
  REQUIRE(half.color);
  CHECK(near(half.color->value.rgba, Vec4(0.5, 0.5, 0, 1), 1e-15));
  CHECK(near(half.color->rate, Vec4(-0.5, 0.5, 0, 0), 1e-15));
  REQUIRE(half.weights.size() == 3);
  CHECK(half.weights[0].value == 0.75);
  CHECK(half.weights[0].rate == 0.25);
  CHECK(half.weights[1].value == 0.5);
  CHECK(half.weights[1].rate == -0.5);
  CHECK(half.weights[2].value == 0.125);  // for a target that the node does not give: from 0
  CHECK(animation.look(0, 0).color->value == *face.color);
  CHECK(animation.look(0, 0).weights[1].value == 1);
  CHECK(animation.look(0, 3).color->value == Color{Vec4(0, 1, 0, 1)});
  CHECK(animation.look(0, 3).weights[1].value == 0);
  CHECK(animation.look(1, 1).weights[0].value == 0.5);
}

TEST_CASE("an animation, a player and a step curve that were moved from can still be asked") {
  Animation animation(arm(), {waving("a", 1)}, {{.clip = 0}});
  const Motion before = animation.sample_node(2, 0.4);
  Animation taken = std::move(animation);
  CHECK(animation.sample_node(2, 0.4).pose.position == before.pose.position);
  CHECK(taken.sample_node(2, 0.4).pose.position == before.pose.position);
  Player player({.clip = 0, .at = 0.25}, waving("a", 1));
  const Player taken_player = std::move(player);
  CHECK(player.at() == 0.25);
  CHECK(taken_player.at() == 0.25);
  StepCurve<std::string> steps({{0, "left"}, {1, "right"}});
  const StepCurve<std::string> taken_steps = std::move(steps);
  CHECK(taken_steps.value(2) == "right");
  CHECK(steps.value(2).size() <= 5);
}
