#pragma once

// A small skeleton with clips that move all of it, and graphs over them.

#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cstring>
#include <memory>

namespace tweenfall::test {

inline std::shared_ptr<const Hierarchy> limb() {
  return std::make_shared<const Hierarchy>(std::vector<Node>{{"root", no_node, {.position = {0, 1, 0}}},
                                                             {"upper", 0, {.position = {0.3, 0, 0}}},
                                                             {"lower", 1, {.position = {0.25, 0, 0}}},
                                                             {"hat", no_node, {.position = {0, 2, 0}}}});
}

/// A clip of two seconds that moves, turns and scales smoothly, within half a right angle of rest. The hat rests.
inline Clip moving(const std::string& name, std::uint64_t seed, LoopMode loop = LoopMode::once) {
  Random random(seed);
  Clip clip{.name = name, .duration = 2, .loop = {.mode = loop}};
  for (const char* node : {"root", "upper", "lower"}) {
    std::vector<Key<Vec3>> places, scales;
    std::vector<Key<Quat>> turns;
    for (int i = 0; i < 5; ++i) {
      const Vec3 place = random.vector(1), scale = random.vector(0.3), turn = random.vector(0.4);
      places.push_back({.time = 0.5 * i, .value = place, .ease = Ease::smooth()});
      scales.push_back({.time = 0.5 * i, .value = Vec3(1, 1, 1) + scale, .ease = Ease::smooth()});
      turns.push_back({.time = 0.5 * i, .value = exp_map(turn), .ease = Ease::smooth()});
    }
    if (loop == LoopMode::repeat) {
      places.back().value = places.front().value;
      scales.back().value = scales.front().value;
      turns.back().value = turns.front().value;
    }
    clip.tracks.push_back({node, "position", keyed_curve<Vec3>(places, {.ends = Ends::wrap})});
    clip.tracks.push_back({node, "rotation", keyed_curve<Quat>(turns, {.ends = Ends::wrap})});
    clip.tracks.push_back({node, "scale", keyed_curve<Vec3>(scales, {.ends = Ends::wrap})});
  }
  return clip;
}

inline std::shared_ptr<const std::vector<Clip>> three_clips() {
  std::vector<Clip> clips = {moving("idle", 1, LoopMode::repeat), moving("walk", 2, LoopMode::repeat),
                             moving("jump", 3)};
  clips[0].events = {{0.5, 0.5, "breath", ""}};
  clips[1].events = {{0, 0, "left", ""}, {1, 1, "right", ""}};
  clips[2].events = {{0, 0, "off", ""}, {1.25, 1.25, "landed", ""}};
  return std::make_shared<const std::vector<Clip>>(std::move(clips));
}

inline std::shared_ptr<const Graph> graph_of(GraphDescription description,
                                             std::shared_ptr<const std::vector<Clip>> clips = three_clips()) {
  return std::make_shared<const Graph>(limb(), std::move(clips), std::move(description));
}

inline std::vector<Motion> pose_at(GraphPlayer& player, double time, Side side = Side::out) {
  std::vector<Motion> pose(player.graph().nodes().size());
  player.pose_at(time, pose, side);
  return pose;
}

inline bool same_bits(const std::vector<Motion>& a, const std::vector<Motion>& b) {
  static_assert(sizeof(Motion) == 19 * sizeof(double));
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Motion)) == 0;
}

/// The largest difference of any value, and of any rate.
struct Apart {
  double value = 0, rate = 0;
};
inline Apart apart(const std::vector<Motion>& a, const std::vector<Motion>& b) {
  Apart most;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 turn = log_map(a[i].pose.rotation * b[i].pose.rotation.conjugate());
    for (const Vec3& part :
         {Vec3(a[i].pose.position - b[i].pose.position), turn, Vec3(a[i].pose.scale - b[i].pose.scale)})
      most.value = std::max(most.value, part.cwiseAbs().maxCoeff());
    for (const Vec3& part : {Vec3(a[i].twist.linear - b[i].twist.linear), Vec3(a[i].twist.angular - b[i].twist.angular),
                             Vec3(a[i].scale_rate - b[i].scale_rate)})
      most.rate = std::max(most.rate, part.cwiseAbs().maxCoeff());
  }
  return most;
}

/// How far the rates are from those of the values, by a stencil of order 4.
inline double rate_error(GraphPlayer& player, double time, double h = 1e-4) {
  const std::vector<Motion> now = pose_at(player, time);
  const std::vector<Motion> far[4] = {pose_at(player, time - 2 * h), pose_at(player, time - h),
                                      pose_at(player, time + h), pose_at(player, time + 2 * h)};
  double most = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto stencil = [&](const auto& of) {
      return Vec3((8 * (of(far[2][i]) - of(far[1][i])) - (of(far[3][i]) - of(far[0][i]))) / (12 * h));
    };
    const Vec3 position = stencil([](const Motion& m) { return m.pose.position; });
    const Vec3 scale = stencil([](const Motion& m) { return m.pose.scale; });
    const Vec3 turn =
        stencil([&](const Motion& m) { return log_map(m.pose.rotation * now[i].pose.rotation.conjugate()); });
    most = std::max({most, (position - now[i].twist.linear).cwiseAbs().maxCoeff(),
                     (scale - now[i].scale_rate).cwiseAbs().maxCoeff(),
                     (turn - now[i].twist.angular).cwiseAbs().maxCoeff()});
  }
  return most;
}

}  // namespace tweenfall::test
