#pragma once

// Two figures and a ball, with smooth clips that move all of it, for graphs that reach, look, stand and swing.

#include "anim/chains/chain_support.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/keys.h>

#include <memory>
#include <string>
#include <vector>

namespace tweenfall::test {

inline const std::shared_ptr<const Hierarchy>& figures() {
  static const auto nodes =
      std::make_shared<const Hierarchy>(std::vector<Node>{{"hips", no_node, {.position = {0, 1, 0}}},
                                                          {"thigh.L", 0, {.position = {0.1, 0, 0}}},
                                                          {"shin.L", 1, {.position = {0, -0.45, 0.03}}},
                                                          {"foot.L", 2, {.position = {0, -0.45, -0.03}}},
                                                          {"thigh.R", 0, {.position = {-0.1, 0, 0}}},
                                                          {"shin.R", 4, {.position = {0, -0.45, 0.03}}},
                                                          {"foot.R", 5, {.position = {0, -0.45, -0.03}}},
                                                          {"spine", 0, {.position = {0, 0.3, 0}}},
                                                          {"head", 7, {.position = {0, 0.3, 0}}},
                                                          {"tail 1", 0, {.position = {0, 0.05, -0.1}}},
                                                          {"tail 2", 9, {.position = {0, 0, -0.2}}},
                                                          {"tail 3", 10, {.position = {0, 0, -0.2}}},
                                                          {"tail 4", 11, {.position = {0, 0, -0.2}}},
                                                          {"ball", no_node, {.position = {0.3, 1.5, 1}}},
                                                          {"other/hips", no_node, {.position = {3, 1.5, 0}}},
                                                          {"other/spine", 14, {.position = {0, 0.5, 0.1}}},
                                                          {"other/head", 15, {.position = {0, 0.4, 0}}}});
  return nodes;
}

/// Loops of two seconds that move and turn every node but those of the other figure. Keys at every half second.
inline std::shared_ptr<const std::vector<Clip>> figure_clips() {
  std::vector<Clip> clips;
  for (const char* name : {"walk", "idle", "dance"}) {
    Random random(clips.size() + 77);
    Clip& clip = clips.emplace_back(Clip{.name = name, .duration = 2, .loop = {.mode = LoopMode::repeat}});
    for (const Node& node : figures()->nodes()) {
      if (node.name.find("other") == 0) continue;
      std::vector<Key<Vec3>> places;
      std::vector<Key<Quat>> turns;
      for (int i = 0; i < 5; ++i) {
        const Vec3 away = random.vector(0.06), turn = random.vector(0.3);
        places.push_back({.time = 0.5 * i, .value = node.rest.position + away, .ease = Ease::smooth()});
        turns.push_back({.time = 0.5 * i, .value = exp_map(turn), .ease = Ease::smooth()});
      }
      places.back().value = places.front().value;
      turns.back().value = turns.front().value;
      clip.tracks.push_back({node.name, "position", keyed_curve<Vec3>(places, {.ends = Ends::wrap})});
      clip.tracks.push_back({node.name, "rotation", keyed_curve<Quat>(turns, {.ends = Ends::wrap})});
    }
  }
  return std::make_shared<const std::vector<Clip>>(std::move(clips));
}

inline std::shared_ptr<const Graph> figure_graph(GraphDescription description) {
  return std::make_shared<const Graph>(figures(), figure_clips(), std::move(description));
}

/// A slope with bumps, so wide that a figure stays between four of its heights.
inline HeightGrid bumpy_ground() {
  return {.columns = 4,
          .heights = {0.1, 0, 0.2, 0.1, 0.05, -0.1, 0.15, 0.3, 0, 0.1, -0.05, 0.1, 0.2, 0.1, 0, 0.1},
          .spacing_x = 3,
          .spacing_z = 3};
}

// One of each, over "walk"
inline GraphPlace place_of(double x, double y, double z) {
  return {.at = {x, y, z}};
}
inline TwoBonePose grip(GraphNumber weight) {
  return {.base = "walk",
          .start = "thigh.L",
          .middle = "shin.L",
          .end = "foot.L",
          .target = {.node = "tail 1", .at = {0.1, -0.55, ByParameter{"reach"}}},
          .pole = GraphPlace{.node = "ball", .at = {0., 0., 1.}},
          .softness = 0.3,
          .weight = std::move(weight)};
}
inline LookAtPose look(GraphNumber weight) {
  return {.base = "walk",
          .joints = {{"spine", 0.3}, {"head"}},
          .target = {.node = "ball"},
          .upright = Vec3(0, 1, 0),
          .eye = {0, 0.1, 0.1},
          .limit = 1.4,
          .weight = std::move(weight)};
}
inline ReachPose curl(GraphNumber weight, ChainMethod method) {
  return {.base = "walk",
          .joints = {{"tail 1"}, {"tail 2", ConeLimit{.swing = 1.3}}, {"tail 3"}, {"tail 4"}},
          .target = place_of(0.25, 1.2, -0.3),
          .method = method,
          .weight = std::move(weight)};
}
inline FeetPose stand(GraphNumber weight) {
  return {.base = "walk",
          .pelvis = "hips",
          .feet = {{.start = "thigh.L", .middle = "shin.L", .end = "foot.L"},
                   {.start = "thigh.R", .middle = "shin.R", .end = "foot.R", .weight = ByParameter{"reach"}}},
          .ground = bumpy_ground(),
          .floor = 0.02,
          .evenness = 0.05,
          .softness = 0.3,
          .weight = std::move(weight)};
}
inline MirrorPose mirrored(GraphNumber weight) {
  return {.base = "walk", .pairs = {{"*.L", "*.R"}}, .figure = "hips", .weight = std::move(weight)};
}
inline RetargetPose taken_over(GraphNumber weight) {
  return {.base = "walk",
          .source = "hips",
          .target = "other/hips",
          .pairs = {{"hips", "other/hips", true}, {"spine", "other/spine"}, {"head", "other/head"}},
          .weight = std::move(weight)};
}
inline RootMotionPose on_the_spot(GraphNumber weight, const std::string& onto = {}) {
  return {.base = "walk", .node = "spine", .onto = onto, .weight = std::move(weight)};
}

/// The operation over "walk", and what it looks at.
inline GraphDescription graph_with(PoseOperation operation) {
  return {.parameters = {{.name = "reach", .start = 0.2, .half_life = 0.3}, {.name = "weight", .half_life = 0.25}},
          .poses = {{"changed", std::move(operation)}},
          .inputs = {{0.1, "reach", 0.6}, {0.1, "weight", 0.9}, {1.6, "weight", 0.2}}};
}

inline std::vector<Motion> shown(GraphPlayer& player, double time, Side side = Side::out) {
  std::vector<Motion> pose(player.graph().nodes().size());
  player.pose_at(time, pose, side);
  return pose;
}

/// Saves a player of the graph at 2.71 s, after all its inputs: another goes on from there to the same bits, and bytes
/// that are cut or changed are refused.
inline void check_saved(const std::shared_ptr<const Graph>& graph, GraphPlayer& player) {
  player.seek(2.71);
  static_cast<void>(shown(player, 2.71));
  const std::vector<std::byte> saved = player.save();
  GraphPlayer other(graph), victim(graph);
  other.load(saved);
  CHECK(other.save() == saved);
  for (const double time : {2.71, 2.72, 4.0, 1.1}) CHECK(same_bits(shown(other, time), shown(player, time)));
  for (std::size_t cut = 0; cut < saved.size(); cut += 7)
    CHECK_THROWS_AS(victim.load(std::span(saved).first(cut)), std::invalid_argument);
  for (std::size_t i = 0; i < saved.size(); i += 3) {
    std::vector<std::byte> flipped = saved;
    flipped[i] ^= std::byte{0x10};
    CHECK_THROWS_AS(victim.load(flipped), std::invalid_argument);
  }
}

}  // namespace tweenfall::test
