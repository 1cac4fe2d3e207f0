#pragma once

// Figures and clips for the tests of crowds: trees of joints, moved by curves of every sort.

#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/crowd.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <memory>
#include <string>
#include <vector>

namespace tweenfall::test {

inline std::shared_ptr<const Hierarchy> random_figure(std::uint64_t seed, std::size_t size) {
  Random random(seed);
  auto nodes = std::make_shared<Hierarchy>();
  for (std::size_t i = 0; i < size; ++i) {
    Node node{.name = "joint" + std::to_string(i)};
    if (i > 0)
      node.parent = random.unit() < 0.7 ? i - 1 : static_cast<std::size_t>(random.unit() * static_cast<double>(i));
    node.rest.position = random.vector(0.1);
    node.rest.rotation = random.rotation();
    nodes->add(node);
  }
  return nodes;
}

inline Ease random_ease(Random& random) {
  const double draw = random.unit();
  if (draw < 0.25) return Ease::hold();
  if (draw < 0.5) return Ease::linear();
  if (draw < 0.7) return Ease::smooth();
  if (draw < 0.8) return Ease::bezier(0.4, 0, 0.2, 1);
  if (draw < 0.9) return Ease::spring(0.4, 0.3);
  return Ease::smooth_clamped();
}

/// Keys at uneven times, each leaving by an ease of its own; or lines, steps and jumps, sometimes two within a
/// microsecond.
template <class T, class Draw>
Curve<T> random_keys(Random& random, double duration, const Draw& draw) {
  std::vector<Key<T>> keys;
  double time = random.unit() < 0.5 ? 0 : random.between(0, 0.2);
  const bool even = random.unit() < 0.3, sharp = random.unit() < 0.4;
  while (time < duration) {
    const bool jumps = !keys.empty() && keys.back().ease == Ease::linear() && random.unit() < 0.3;
    const Ease ease = !sharp ? random_ease(random) : random.unit() < 0.3 ? Ease::hold() : Ease::linear();
    keys.push_back({.time = time, .value = draw(), .ease = ease});
    if (jumps) keys.back().value_in = draw();
    time += even ? 0.1 : sharp && random.unit() < 0.1 ? 1e-6 : random.between(0.03, 0.3);
  }
  return keyed_curve<T>(keys);
}

inline Clip random_clip(std::uint64_t seed, const Hierarchy& nodes, double duration) {
  Random random(seed);
  Clip clip{.name = "random", .duration = duration, .loop = {.mode = LoopMode::repeat}};
  const EulerOrder order;
  for (const Node& node : nodes.nodes()) {
    const bool relative = random.unit() < 0.2;
    if (random.unit() < 0.6)
      clip.tracks.push_back(
          {node.name, "position", random_keys<Vec3>(random, duration, [&] { return random.vector(0.2); }), relative});
    if (random.unit() < 0.8) {
      if (random.unit() < 0.2) {
        const auto angles = random_keys<Vec3>(random, duration, [&] { return random.vector(3); });
        clip.tracks.push_back({node.name, "rotation", euler_curve(angles, order), relative});
      } else {
        const auto turns = random_keys<Quat>(random, duration, [&] { return random.rotation(); });
        clip.tracks.push_back({node.name, "rotation", turns, relative});
      }
    }
    if (random.unit() < 0.4)
      clip.tracks.push_back(
          {node.name, "scale",
           random_keys<Vec3>(random, duration, [&]() -> Vec3 { return Vec3(1, 1, 1) + random.vector(0.3); }),
           relative});
  }
  return clip;
}

inline Pose pose_of(std::span<const CrowdGroup> pose, std::size_t joint) {
  const CrowdGroup& group = pose[joint / CrowdGroup::size];
  const std::size_t lane = joint % CrowdGroup::size;
  Pose out;
  for (int c = 0; c < 3; ++c) {
    out.position[c] = group.translation[c][lane];
    out.scale[c] = group.scale[c][lane];
  }
  for (int c = 0; c < 4; ++c) out.rotation.coeffs()[c] = group.rotation[c][lane];
  return out;
}

/// The largest distance, in the space of the figure, of points `arm` away from each joint on each axis.
inline double distance(const Hierarchy& nodes, std::span<const Motion> exact, std::span<const CrowdGroup> pose,
                       double arm) {
  std::vector<Motion> found(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) found[i].pose = pose_of(pose, i);
  std::vector<WorldMotion> there(nodes.size()), here(nodes.size());
  nodes.world_motions(exact, there);
  nodes.world_motions(found, here);
  double farthest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-arm, arm}) {
        const Vec3 tip = side * Vec3::Unit(axis);
        const double apart = (there[i].point(tip) - here[i].point(tip)).norm();
        farthest = apart <= farthest ? farthest : apart;
        if (!(apart < 1e300)) return 1e300;
      }
  return farthest;
}

/// The distance of the crowd's clip from the exact path at a time of the stage.
inline double distance(const Animation& exact, const CrowdClip& clip, double stage_time, double arm = 0.1) {
  std::vector<Motion> wanted(exact.nodes().size());
  exact.sample(stage_time, wanted);
  std::vector<CrowdGroup> pose(clip.groups());
  clip.sample(clip.clock(exact.players()[0].at(), exact.players()[0].play().speed.at(0), stage_time), pose);
  return distance(exact.nodes(), wanted, pose, arm);
}

}  // namespace tweenfall::test
