#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/ragdoll/ragdoll.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "shapes/fitted_capsule.h"
#include "shapes/turn_onto.h"

namespace tweenfall {

namespace ragdoll {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

/// The shortest rotation that takes the x axis to a direction.
Quat along(const Vec3& direction) {
  return normalized(shapes::turn_onto(Vec3(1, 0, 0), direction));
}

/// The vertices that a joint of the skin carries, in the axes of its node and at world size.
struct Part {
  std::vector<Vec3> points;
  std::size_t node = no_node;
  std::size_t parent = no_bone;  ///< the nearest ancestor among the skin's joints
  bool kept = true;
};

class Fitting {
 public:
  Fitting(const Hierarchy& hierarchy, std::span<const SkinnedMesh> meshes, std::span<const WorldMotion> world,
          const RagdollSettings& settings)
      : hierarchy_(hierarchy), meshes_(meshes), world_(world), settings_(settings) {}

  std::vector<RagdollBone> bones() {
    check();
    find_parts();
    give_points();
    merge_small();
    std::vector<RagdollBone> bones;
    std::vector<std::size_t> bone_of(parts_.size(), no_bone);
    double total = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!parts_[i].kept) continue;
      bone_of[i] = bones.size();
      const std::size_t parent = parts_[i].parent == no_bone ? no_bone : bone_of[parts_[i].parent];
      bones.push_back(bone(parts_[i], parent, bones));
      total += volume(bones.back().shape.solid);
    }
    require(!bones.empty(), "no joint of the skin carries enough for a bone");
    for (RagdollBone& bone : bones) bone.mass = settings_.mass * volume(bone.shape.solid) / total;
    limit(bones);
    return bones;
  }

 private:
  [[nodiscard]] const Motion& motion(std::size_t node) const { return world_[node].motion; }
  [[nodiscard]] double size_of(std::size_t node) const { return motion(node).pose.scale.mean(); }

  void check() const {
    require(settings_.mass > 0 && std::isfinite(settings_.mass),
            "mass of a ragdoll must be positive and finite, but is " + number_text(settings_.mass) + " kg");
    require(settings_.smallest >= 0 && settings_.smallest <= 1,
            "the smallest part of a ragdoll must lie in 0 to 1, but is " + number_text(settings_.smallest));
    for (const double angle : {settings_.swing, settings_.twist})
      require(angle >= 0 && angle <= std::numbers::pi,
              "swing and twist of a ragdoll must lie in 0 to pi (180 degrees), but one is " + number_text(angle));
    require(world_.size() == hierarchy_.size(), "a ragdoll needs the world motion of each of the " +
                                                    std::to_string(hierarchy_.size()) + " nodes, but there are " +
                                                    std::to_string(world_.size()));
    require(!meshes_.empty(), "a ragdoll needs a skinned mesh");
    for (const SkinnedMesh& skinned : meshes_) {
      require(skinned.mesh && skinned.skin, "a ragdoll needs a mesh and its skin");
      check(*skinned.mesh, *skinned.skin);
    }
  }

  void check(const Mesh& mesh, const Skin& skin) const {
    require(!mesh.influences.empty(), "the mesh " + mesh.name + " has no skin: no joint pulls on its vertices");
    require(mesh.influences.size() == mesh.positions.size() && skin.inverse_binds.size() == skin.joints.size(),
            "the skin does not fit the mesh " + mesh.name);
    for (const std::size_t node : skin.joints) {
      require(node < hierarchy_.size(), "the skin of the mesh " + mesh.name + " has a joint that is no node");
      const Vec3& scale = motion(node).pose.scale;
      const double size = scale.mean();
      require(size > 0 && (scale - Vec3::Constant(size)).cwiseAbs().maxCoeff() <= 1e-3 * size,
              "the node " + hierarchy_[node].name + " is scaled differently along its axes: no capsule follows that");
    }
  }

  /// The skins' joints, parents first.
  void find_parts() {
    std::vector<char> is_joint(hierarchy_.size(), 0);
    for (const SkinnedMesh& skinned : meshes_)
      for (const std::size_t node : skinned.skin->joints) is_joint[node] = 1;
    part_at_.assign(hierarchy_.size(), no_bone);
    for (std::size_t node = 0; node < hierarchy_.size(); ++node) {
      const std::size_t parent = hierarchy_[node].parent == no_node ? no_bone : part_at_[hierarchy_[node].parent];
      part_at_[node] = is_joint[node] != 0 ? parts_.size() : parent;
      if (is_joint[node] != 0) parts_.push_back({{}, node, parent, true});
    }
  }

  void give_points() {
    Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
    for (const auto& [mesh, skin] : meshes_)
      for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
        const std::span<const Influence> all = mesh->influences[i];
        const auto most = std::ranges::max_element(all, {}, &Influence::weight);
        if (most == all.end()) continue;
        require(most->joint < skin->joints.size(), "a vertex of the mesh " + mesh->name + " hangs on no joint");
        const Skin::InverseBind& bind = skin->inverse_binds[most->joint];
        const std::size_t node = skin->joints[most->joint];
        const Vec3 point = size_of(node) * (bind.linear * mesh->positions[i] + bind.translation);
        if (!point.allFinite()) continue;
        parts_[part_at_[node]].points.push_back(point);
        const Vec3 at = motion(node).pose.position + motion(node).pose.rotation * point;
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
      }
    require((high - low).minCoeff() >= 0, "no joint pulls on the mesh " + meshes_.front().mesh->name);
    height_ = (high - low).norm();
  }

  [[nodiscard]] static double extent(const std::vector<Vec3>& points) {
    if (points.empty()) return 0;
    Vec3 low = points.front(), high = low;
    for (const Vec3& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    return (high - low).norm();
  }

  /// From the leaves: a part that carries little passes it on to its parent.
  void merge_small() {
    for (std::size_t i = parts_.size(); i-- > 0;) {
      Part& part = parts_[i];
      const bool small = part.points.size() < 4 || extent(part.points) < settings_.smallest * height_;
      if (!small) continue;
      const auto childless = [&] {
        return std::ranges::none_of(parts_, [&](const Part& other) { return other.kept && other.parent == i; });
      };
      // A root that carries nothing is no bone either; its children then start trees of their own.
      if (part.parent == no_bone && !part.points.empty() && !childless()) continue;
      part.kept = false;
      for (Part& other : parts_)
        if (other.parent == i) other.parent = part.parent;
      if (part.parent == no_bone) continue;
      Part& above = parts_[part.parent];
      const Pose& from = motion(part.node).pose;
      const Pose& to = motion(above.node).pose;
      for (const Vec3& point : part.points)
        above.points.push_back(to.rotation.conjugate() * (from.position + from.rotation * point - to.position));
    }
  }

  /// Toward the middle of the children that are bones.
  [[nodiscard]] std::optional<Vec3> way_of(const Part& part) const {
    const auto index = static_cast<std::size_t>(&part - parts_.data());
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const Part& other : parts_) {
      if (!other.kept || other.parent != index) continue;
      sum += motion(other.node).pose.position - motion(part.node).pose.position;
      ++count;
    }
    const Vec3 way = motion(part.node).pose.rotation.conjugate() * sum;
    if (count == 0 || !(way.norm() > 1e-3 * height_ * count)) return std::nullopt;
    return way.normalized();
  }

  [[nodiscard]] RagdollBone bone(const Part& part, std::size_t parent, const std::vector<RagdollBone>& bones) const {
    const std::optional<Vec3> way = way_of(part);
    std::optional<shapes::FittedCapsule> fitted = shapes::fitted_capsule(part.points, way);
    require(fitted.has_value(),
            "what the node " + hierarchy_[part.node].name + " carries has no extent that a capsule could have");
    RagdollBone bone;
    bone.node = part.node;
    bone.parent = parent;
    bone.shape.solid = fitted->capsule;
    bone.shape.offset.position = fitted->center;
    bone.shape.offset.rotation = normalized(shapes::turn_onto(Vec3(0, 1, 0), fitted->axis));
    // Along the bone, or else from the joint to what it carries.
    Vec3 twist = way.value_or(fitted->center);
    const double length = twist.norm();
    twist = length > 1e-3 * height_ ? Vec3(twist / length) : fitted->axis;
    bone.frame.rotation = along(twist);
    if (parent == no_bone) return bone;
    const Pose& own = motion(part.node).pose;
    const Pose& above = motion(bones[parent].node).pose;
    const Quat back = above.rotation.conjugate();
    bone.frame_on_parent.position = back * (own.position - above.position);
    bone.frame_on_parent.rotation = normalized(back * own.rotation * bone.frame.rotation);
    bone.joint.swing_y = bone.joint.swing_z = settings_.swing;
    bone.joint.twist = {-settings_.twist, settings_.twist};
    return bone;
  }

  void limit(std::vector<RagdollBone>& bones) const {
    for (const auto& entry : settings_.limits) {
      const auto named = [&](const RagdollBone& bone) { return hierarchy_[bone.node].name == entry.first; };
      const auto bone = std::ranges::find_if(bones, named);
      require(bone != bones.end(), "there are limits for " + entry.first + ", which is no bone of this ragdoll");
      bone->joint = entry.second;
    }
  }

  const Hierarchy& hierarchy_;
  std::span<const SkinnedMesh> meshes_;
  std::span<const WorldMotion> world_;
  const RagdollSettings& settings_;
  std::vector<Part> parts_;
  std::vector<std::size_t> part_at_;  ///< by node: its own part, or the nearest ancestor's
  double height_ = 0;                 ///< of the whole figure: its diagonal, m
};

}  // namespace
}  // namespace ragdoll

std::vector<RagdollBone> fit_ragdoll(const Hierarchy& hierarchy, std::span<const SkinnedMesh> meshes,
                                     std::span<const WorldMotion> world, const RagdollSettings& settings) {
  return ragdoll::Fitting(hierarchy, meshes, world, settings).bones();
}

}  // namespace tweenfall
