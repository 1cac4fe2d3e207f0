#pragma once

/// A skinned skeleton as rigid bodies: one call fits a capsule to what each joint of the skin carries, distributes the
/// mass, and joins them with limits; a map leads from the animation's poses to the bodies and back.

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/world.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall {

inline constexpr std::size_t no_bone = static_cast<std::size_t>(-1);

/// One rigid part of a figure, for the figure's size at rest.
struct RagdollBone {
  std::size_t node = no_node;    ///< of the hierarchy; the body's origin is its origin
  std::size_t parent = no_bone;  ///< the bone it is joined to, an earlier one; `no_bone` for a root
  Shape shape = {};              ///< a capsule on the node, m
  double mass = 0;               ///< kg
  Pose frame_on_parent = {};     ///< of the joint, on the parent's node; x along the bone
  Pose frame = {};               ///< the same on its own node
  SwingTwistJoint joint = {};    ///< its coordinates are 0 at rest
};

struct RagdollSettings {
  double mass = 70;        ///< kg, of all bones together, distributed by volume; > 0
  double smallest = 0.06;  ///< a part that measures less than this share of the figure belongs to its parent; 0 to 1
  double swing = 0.7;      ///< half angle of the joints' cones, rad
  double twist = 0.35;     ///< how far joints twist each way, rad
  /// Other limits, by the names of the moving nodes.
  std::vector<std::pair<std::string, SwingTwistJoint>> limits{};
};

/// A mesh and the skin that moves it.
struct SkinnedMesh {
  const Mesh* mesh = nullptr;
  const Skin* skin = nullptr;
};

/// Bones of a figure of one or more skinned meshes, parents first. Each vertex belongs to the joint with the greatest
/// weight on it; joints that carry little belong to the nearest ancestor that carries more.
/// @param world  of every node of the hierarchy, at rest: gives the figure's size, and where its joints are at 0
/// @throws std::invalid_argument for a mesh without skin, a skin that does not fit mesh and hierarchy, a scale that is
/// not the same along all axes, settings out of range, or a limit for a node that is no bone
[[nodiscard]] std::vector<RagdollBone> fit_ragdoll(const Hierarchy& hierarchy, std::span<const SkinnedMesh> meshes,
                                                   std::span<const WorldMotion> world,
                                                   const RagdollSettings& settings = {});

/// Settings common to all bodies of a figure.
struct RagdollBody {
  double friction = 0.8;
  double restitution = 0;
  double linear_damping = 0.05;  ///< 1/s
  double angular_damping = 0.2;  ///< 1/s
  Drive drive = Drive::free();
  std::uint64_t groups = 0;  ///< that the bones of a stage belong to and do not collide with; 0: a free one
};

/// The bodies and joints of a figure in a world, by bone. Bones that overlap at rest pass through each other.
class Ragdoll {
 public:
  /// Adds the bodies where the animation has its nodes, with their velocities.
  /// @param world_motions  of every node of the hierarchy
  /// @throws std::invalid_argument as `World::add` and `World::add_joint`, for fewer motions than the bones' nodes
  /// need, or a bone whose parent does not come before it; the world is unchanged then
  Ragdoll(World& world, std::span<const RagdollBone> bones, std::span<const WorldMotion> world_motions,
          const RagdollBody& body = {});

  [[nodiscard]] std::span<const RagdollBone> bones() const noexcept { return bones_; }
  [[nodiscard]] std::span<const BodyId> bodies() const noexcept { return bodies_; }   ///< by bone
  [[nodiscard]] std::span<const JointId> joints() const noexcept { return joints_; }  ///< by bone; none for a root

  /// Where keyed or driven bodies must be at the end of the next step.
  void follow(World& world, std::span<const WorldMotion> end_of_step) const;
  /// Hands all bodies over to another drive, with their present velocities.
  void set_drive(World& world, const Drive& drive) const;
  void remove(World& world) const;  ///< removes the joints too

  /// The figure as the bodies are: local motions, value and rate, of the nodes that have a bone. A root takes position
  /// and rotation, others only rotation, so that no bone changes its length; all other nodes stay as they are.
  /// @param local  one per node of the hierarchy: read for nodes without a bone, and for positions; written for bones
  void pose(const World& world, const Hierarchy& hierarchy, std::span<Motion> local) const;

 private:
  std::vector<RagdollBone> bones_;
  std::vector<BodyId> bodies_;
  std::vector<JointId> joints_;
};

}  // namespace tweenfall
