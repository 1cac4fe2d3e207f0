#pragma once

/// Mirroring whole poses: the left side does what the right side does, and vice versa.
///
/// Each joint does what its partner across the plane does, measured from the rest pose, in the space of the whole
/// figure: it turns by the mirror image of its partner's turn from rest, and moves by the mirror image of its
/// displacement. So the joints' own axes may point anywhere, and differ between the sides; where the rest pose is
/// symmetrical in the figure's space the mirrored pose is the mirror image, and where it is not, each side keeps its
/// own rest pose and proportions. Scales are exchanged between axes that are each other's mirror images; where there
/// are no such axes, with the axis nearest to the image. For a figure whose rest pose is asymmetrical, a stance can be
/// given, a symmetrical pose to measure from. Rates are mirrored with the poses, exactly. The mirror of a mirrored pose
/// is the pose: bit for bit where the rest pose is symmetrical in the joints' own axes, to rounding else.

#include <tweenfall/anim/hierarchy.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// Two names, or two patterns of names in which `*` stands for the same text on both sides ("*.L" and "*.R", "Left*"
/// and "Right*"; both have the same number of `*`).
struct MirrorPair {
  std::string left, right;
};

/// The usual ways of naming sides (".L", "_r", "Left") that this figure uses.
[[nodiscard]] std::vector<MirrorPair> usual_sides(const Hierarchy& nodes);

class Mirror {
 public:
  /// A joint that is in no pair is its own partner.
  /// @param normal  of the mirror plane, which goes through the origin of the figure's space; any length
  /// @param stance  local poses to measure from; empty: the rest poses
  /// @throws std::invalid_argument listing all problems: a pair that no joint matches, a joint without its partner, one
  /// with two, partners whose parents are not partners, a normal of no length, a stance of another size.
  Mirror(const Hierarchy& nodes, std::span<const MirrorPair> pairs, const Vec3& normal = {1, 0, 0},
         std::span<const Pose> stance = {});

  [[nodiscard]] std::size_t size() const noexcept { return joints_.size(); }
  [[nodiscard]] std::size_t partner(std::size_t joint) const noexcept { return joints_[joint].partner; }

  /// @param pose  local motions, one for each node  @param out  written, of the same size; may be the pose itself
  void apply(std::span<const Motion> pose, std::span<Motion> out) const noexcept;

 private:
  struct Joint {
    std::size_t partner = 0;
    Quat before{1, 0, 0, 0}, after{1, 0, 0, 0};  ///< its rotation is before * (partner's, mirrored) * after
    Vec3 offset{0, 0, 0};                        ///< its position at rest minus the mirrored one
    std::array<int, 3> axes{0, 1, 2};            ///< the partner's axes nearest to the images of its own
    Vec3 own_signs{1, 1, 1};                     ///< of the scales above it at rest, which mirror what is below
    Vec3 partner_signs{1, 1, 1};                 ///< ... and above its partner
    Vec3 sizes{1, 1, 1};                         ///< ratios of its scale to the partner's along these axes
  };
  [[nodiscard]] Vec3 mirrored_way(const Joint& joint, const Vec3& way) const noexcept;
  [[nodiscard]] Motion mirrored(const Joint& joint, const Motion& partner) const noexcept;

  std::vector<Joint> joints_;
  Vec3 normal_;
};

}  // namespace tweenfall
