#pragma once

/// What the joints of a skin make of a mesh: positions, normals and tangents, with their exact rates on request,
/// blended linearly or by dual quaternions, after morph targets; and the box that holds it.
///
/// First `skin_joints` tells once for a pose how each joint has carried the mesh's space; then `deform` asks each
/// vertex for its joints, however many they are.

#include <tweenfall/anim/mesh.h>

#include <limits>

namespace tweenfall {

/// How a joint has carried the space of a mesh since it was bound to it.
struct SkinJoint {
  WorldFrame moved;                  ///< the joint's world frame times its inverse bind matrix
  Quat rotation{1, 0, 0, 0};         ///< of that, unit; about the world's axes
  Vec3 spin{0, 0, 0};                ///< its angular velocity, rad/s
  Mat3 stretch = Mat3::Identity();   ///< what is left: scale and shear; `moved.linear` is rotation times stretch
  Mat3 stretch_rate = Mat3::Zero();  ///< 1/s
};

/// @param world   world motion of every node
/// @param joints  written, one per joint of the skin
void skin_joints(const Skin& skin, std::span<const WorldMotion> world, std::span<SkinJoint> joints) noexcept;

/// The same of a mesh without skin, which its node alone carries, even where it has influences for a skin elsewhere.
[[nodiscard]] SkinJoint skin_joint(const WorldMotion& node) noexcept;

enum class SkinBlend {
  linear,           ///< the weighted mean of what the joints make of the vertex; limbs get thin where they twist
  dual_quaternion,  ///< the rigid motion between those of the joints; keeps volume
};

struct Deformation {
  SkinBlend blend = SkinBlend::linear;
  std::span<const double> weights{};       ///< one per morph target, or empty for the mesh's rest weights
  std::span<const double> weight_rates{};  ///< 1/s, one per weight; or empty where they do not change
};

/// Where the results go: one per vertex each, or empty for what is not asked for.
struct DeformedMesh {
  std::span<Vec3> positions{};      ///< world, m
  std::span<Vec3> normals{};        ///< world, unit; for meshes with normals
  std::span<Vec3> tangents{};       ///< world, unit; for meshes with tangents; not made to stand across the normal
  std::span<Vec3> velocities{};     ///< m/s
  std::span<Vec3> normal_rates{};   ///< 1/s
  std::span<Vec3> tangent_rates{};  ///< 1/s
};

/// Morphs first, then the joints. Normals stand across the surface however it is stretched: they go by the inverse
/// transpose of the blended matrix. What no direction is left of is zero.
///
/// @param joints  those of the skin; of a mesh without influences the first carries all, and one alone carries all of
///                any mesh
/// Source of the dual quaternions: Kavan, Collins, Zara, O'Sullivan, "Geometric skinning with approximate dual
/// quaternion blending", 2008; stretch is blended linearly and applied before.
void deform(const Mesh& mesh, std::span<const SkinJoint> joints, const Deformation& how,
            const DeformedMesh& out) noexcept;

/// A box along the axes. Empty when nothing was put into it: `low` is then above `high`.
struct MeshBounds {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());    ///< m
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< m

  [[nodiscard]] bool contains(const Vec3& point) const noexcept;
};

[[nodiscard]] MeshBounds bounds_of(std::span<const Vec3> points) noexcept;

/// A box around a mesh wherever its joints are, at the price of a box for each joint.
class SkinBounds {
 public:
  /// @param joints  of the skin; 1 for a mesh without
  /// @throws std::invalid_argument when an influence names a joint beyond them, or has a negative weight
  SkinBounds(const Mesh& mesh, std::size_t joints);

  /// Holds every vertex that linear skinning gives; dual quaternions may carry some beyond it.
  /// @param joints, weights  as in `deform`
  [[nodiscard]] MeshBounds world(std::span<const SkinJoint> joints,
                                 std::span<const double> weights = {}) const noexcept;

 private:
  struct Range {
    Vec3 low, high;
  };
  struct JointBox {
    std::uint32_t joint;
    Range rest;
  };
  std::vector<JointBox> boxes_;  // of the joints that pull on something
  std::vector<Range> offsets_;   // for each box, those of all morph targets
  std::vector<double> rest_weights_;
  double least_sum_ = 1, most_sum_ = 1;  // of the weights of a vertex, which files round
};

}  // namespace tweenfall
