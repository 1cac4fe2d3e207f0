#pragma once

/// Deforms a mesh by the joints of a skin: positions, normals and tangents, with their exact rates on request, blended
/// linearly or by dual quaternions, after morph targets; and bounds the result by a box.
///
/// First `skin_joints` computes once per pose how each joint has moved the mesh's space; then `deform` moves each
/// vertex by its joints, any number of them.

#include <tweenfall/anim/mesh.h>

#include <limits>

namespace tweenfall {

/// How a joint has moved the space of a mesh since the mesh was bound to it.
struct SkinJoint {
  WorldFrame moved;                  ///< the joint's world frame times its inverse bind matrix
  Quat rotation{1, 0, 0, 0};         ///< the rotation in `moved`, unit; about the world's axes
  Vec3 spin{0, 0, 0};                ///< its angular velocity, rad/s
  Mat3 stretch = Mat3::Identity();   ///< the rest, scale and shear; `moved.linear` is rotation times stretch
  Mat3 stretch_rate = Mat3::Zero();  ///< 1/s
};

/// @param world   world motion of every node
/// @param joints  written, one per joint of the skin
void skin_joints(const Skin& skin, std::span<const WorldMotion> world, std::span<SkinJoint> joints) noexcept;

/// The same for a mesh without skin, which only its node moves, even if the mesh has influences for use with a skin.
[[nodiscard]] SkinJoint skin_joint(const WorldMotion& node) noexcept;

enum class SkinBlend {
  linear,           ///< the weighted mean of the vertex moved by each joint; limbs get thin where they twist
  dual_quaternion,  ///< a rigid motion between those of the joints; keeps volume
};

struct Deformation {
  SkinBlend blend = SkinBlend::linear;
  std::span<const double> weights{};       ///< one per morph target, or empty for the mesh's rest weights
  std::span<const double> weight_rates{};  ///< 1/s, one per weight; or empty where they do not change
};

/// The arrays for the results: one element per vertex, or empty for results that are not wanted.
struct DeformedMesh {
  std::span<Vec3> positions{};  ///< world, m
  std::span<Vec3> normals{};    ///< world, unit; for meshes with normals
  /// World, unit; for meshes with tangents; not made perpendicular to the normal. The fourth number of the mesh's
  /// tangent stays valid, except where joints mirror (by a negative scale): there it is the opposite.
  std::span<Vec3> tangents{};
  std::span<Vec3> velocities{};     ///< m/s
  std::span<Vec3> normal_rates{};   ///< 1/s
  std::span<Vec3> tangent_rates{};  ///< 1/s
};

/// Morphs first, then the joints. Normals stay perpendicular to the surface however it is stretched: they are
/// transformed by the inverse transpose of the blended matrix. A normal or tangent that has no direction left is zero.
///
/// @param joints those of the skin; a mesh without influences follows the first, and a single joint moves any
///                whole mesh Source of the dual quaternions: Kavan, Collins, Zara, O'Sullivan, "Geometric skinning
///                with approximate dual quaternion blending", 2008; stretch is blended linearly and applied
///                first.
void deform(const Mesh& mesh, std::span<const SkinJoint> joints, const Deformation& how,
            const DeformedMesh& out) noexcept;

/// An axis-aligned box. If it is empty, `low` is above `high`.
struct MeshBounds {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());    ///< m
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());  ///< m

  [[nodiscard]] bool contains(const Vec3& point) const noexcept;
};

[[nodiscard]] MeshBounds bounds_of(std::span<const Vec3> points) noexcept;

/// A box around a mesh for any pose of its joints, at the cost of one box per joint.
class SkinBounds {
 public:
  /// @param joints number of joints of the skin; 1 for a mesh without skin
  /// @throws std::invalid_argument when an influence names a joint beyond them, or has a negative weight
  SkinBounds(const Mesh& mesh, std::size_t joints);

  /// Contains every vertex by linear skinning; dual quaternions may move some outside it.
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
  std::vector<JointBox> boxes_;  // of the joints that influence a vertex
  std::vector<Range> offsets_;   // for each box, the ranges of all morph targets
  std::vector<double> rest_weights_;
  double least_sum_ = 1, most_sum_ = 1;  // range of the sums of a vertex's weights, which files round
};

}  // namespace tweenfall
