#pragma once

/// Transfers the poses of one skeleton to another with different proportions, intermediate joints and joint axes.
///
/// A joint of the target turns, in the space of the whole figure, as its source joint turns from rest: its rotation is
/// that turn applied to its own rotation at rest. Joints without a source keep their rest pose relative to their
/// parent. Displacements come from the joint that carries the figure, the hips, scaled by the ratio of the two hip
/// heights; all other joints keep the lengths of their own bones. Scales are the target's at rest. Rates are exact.
///
/// If the two rest poses differ (arms out, arms down), poses that match are given as stances. Scales of the rest poses
/// are taken into account if they are uniform up to their signs: joints may be mirrored, as by a scale of -1, 1, 1.

#include <tweenfall/anim/hierarchy.h>

#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// Two names, or two patterns of names in which `*` stands for the same text ("mixamorig:*" and "*"; both have the same
/// number of `*`); with a pattern, joints that the target lacks are skipped.
struct RetargetPair {
  std::string source, target;
  bool moves = false;  ///< transfers its scaled displacement from rest too; always for joints below no mapped one
};

struct RetargetSettings {
  double scale = 0;       ///< of displacements; 0: the ratio of the hip heights, of the highest mapped joint that moves
  Vec3 up{0, 1, 0};       ///< in the source's space; heights are measured along it from the origin
  Quat turn{1, 0, 0, 0};  ///< from the source figure's space to the target figure's
  std::vector<Pose> source_stance{}, target_stance{};  ///< local poses that match each other; empty: the rest poses
};

class Retarget {
 public:
  /// @throws std::invalid_argument listing all problems: names and patterns that match no joint, a joint mapped twice,
  /// a joint that is below another in the target but not in the source, no pairs, hips on the ground without a scale
  /// given, stances of another size.
  Retarget(const Hierarchy& source, const Hierarchy& target, std::span<const RetargetPair> pairs,
           const RetargetSettings& settings = {});

  /// Number of target joints.
  [[nodiscard]] std::size_t size() const noexcept { return joints_.size(); }
  /// The source joint of a target joint, or `no_node`.
  [[nodiscard]] std::size_t source_of(std::size_t joint) const noexcept { return joints_[joint].source; }
  /// The factor for displacements.
  [[nodiscard]] double scale() const noexcept { return scale_; }

  /// @param source  local motions of the source  @param out  written, one for each joint of the target; not the source
  void apply(std::span<const Motion> source, std::span<Motion> out) const noexcept;

 private:
  struct Joint {
    Motion rest;
    std::size_t source = no_node;
    std::size_t chain = 0, chain_end = 0;        ///< the source's joints down from the source of the next mapped parent
    Quat before{1, 0, 0, 0}, after{1, 0, 0, 0};  ///< its rotation is before * Q * after, with Q the chain's
    Vec3 reflection{1, 1, 1};                    ///< by which Q is mirrored first, component by component
    Vec3 chain_place{0, 0, 0};                   ///< position of the chain's end at rest
    Mat3 way = Mat3::Zero();                     ///< maps the displacement of the chain's end to its own
  };
  class Maker;

  std::vector<Joint> joints_;
  std::vector<std::size_t> chains_;
  double scale_ = 1;
};

}  // namespace tweenfall
