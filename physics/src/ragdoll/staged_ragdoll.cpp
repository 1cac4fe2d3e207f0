#include <tweenfall/physics/ragdoll/staged_ragdoll.h>

#include <tweenfall/anim/animation.h>

#include <stdexcept>

namespace tweenfall {

namespace ragdoll {
namespace {

std::uint64_t free_group(const StageDescription& stage) {
  std::uint64_t used = 0;
  for (const NodeDescription& node : stage.nodes)
    if (node.body) used |= node.body->groups;
  for (int bit = 63; bit > 0; --bit)
    if ((used >> bit & 1) == 0) return std::uint64_t{1} << bit;
  throw std::invalid_argument("all 64 groups are taken: there is none left for a ragdoll");
}

/// Converts a shape of world size to a scaled node, since a stage scales it again.
Shape unscaled(const Shape& shape, double scale) {
  auto capsule = std::get<Capsule>(shape.solid);
  capsule.radius /= scale;
  capsule.half_height /= scale;
  return {capsule, {shape.offset.position / scale, shape.offset.rotation}};
}

}  // namespace
}  // namespace ragdoll

std::vector<RagdollBone> add_ragdoll(StageDescription& stage, const RagdollSettings& settings, const RagdollBody& body,
                                     const std::string& group, const std::string& figure) {
  std::vector<Node> nodes;
  std::vector<Motion> rest;
  nodes.reserve(stage.nodes.size());
  rest.reserve(stage.nodes.size());
  for (const NodeDescription& node : stage.nodes) {
    nodes.push_back({.name = node.name, .parent = node.parent, .rest = node.rest});
    rest.push_back({.pose = node.rest});
  }
  const Hierarchy hierarchy(std::move(nodes));
  std::vector<WorldMotion> world(hierarchy.size());
  hierarchy.world_motions(rest, world);
  std::vector<SkinnedMesh> meshes;
  for (const MeshInstance& instance : stage.mesh_instances)
    if (instance.skin != no_node && instance.mesh < stage.meshes.size() && instance.skin < stage.skins.size() &&
        !stage.meshes[instance.mesh].influences.empty() && instance.node < stage.nodes.size() &&
        matches(figure, stage.nodes[instance.node].name))
      meshes.push_back({&stage.meshes[instance.mesh], &stage.skins[instance.skin]});
  std::vector<RagdollBone> bones = fit_ragdoll(hierarchy, meshes, world, settings);

  const std::uint64_t own = body.groups != 0 ? body.groups : ragdoll::free_group(stage);
  for (const RagdollBone& bone : bones) {
    NodeDescription& node = stage.nodes[bone.node];
    if (!node.body) {
      BodyDescription& described = node.body.emplace();
      described.shape = ragdoll::unscaled(bone.shape, world[bone.node].motion.pose.scale.mean());
      described.mass = bone.mass;
      described.friction = body.friction;
      described.restitution = body.restitution;
      described.linear_damping = body.linear_damping;
      described.angular_damping = body.angular_damping;
      described.groups = own;
      described.collides_with = ~own;
      node.group = group;
    }
    if (bone.parent == no_bone) continue;
    JointDescription joint;
    joint.name = node.name;
    joint.a = bones[bone.parent].node;
    joint.b = bone.node;
    joint.frame_a = bone.frame_on_parent;
    joint.frame_b = bone.frame;
    joint.kind = bone.joint;
    stage.joints.push_back(std::move(joint));
  }
  return bones;
}

}  // namespace tweenfall
