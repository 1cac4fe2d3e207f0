#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/contact.h>
#include <tweenfall/physics/ragdoll/ragdoll.h>

#include <stdexcept>

namespace tweenfall {

namespace ragdoll {
namespace {

/// A body has the size of its shape, which includes the node's scale.
Motion unscaled(Motion motion) {
  motion.pose.scale = Vec3::Ones();
  motion.scale_rate = Vec3::Zero();
  return motion;
}

}  // namespace
}  // namespace ragdoll

Ragdoll::Ragdoll(World& world, std::span<const RagdollBone> bones, std::span<const WorldMotion> world_motions,
                 const RagdollBody& body)
    : bones_(bones.begin(), bones.end()) {
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    if (bones_[i].node >= world_motions.size())
      throw std::invalid_argument("a ragdoll needs the world motion of each node that has a bone");
    if (bones_[i].parent != no_bone && bones_[i].parent >= i)
      throw std::invalid_argument("a ragdoll's bones must come after their parents");
  }
  World built = world;
  std::vector<Pose> at_rest(bones_.size());
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    const RagdollBone& bone = bones_[i];
    bodies_.push_back(built.add({.shape = bone.shape,
                                 .mass = bone.mass,
                                 .friction = body.friction,
                                 .restitution = body.restitution,
                                 .linear_damping = body.linear_damping,
                                 .angular_damping = body.angular_damping,
                                 .drive = body.drive,
                                 .motion = ragdoll::unscaled(world_motions[bone.node].motion)}));
    joints_.emplace_back();
    if (bone.parent == no_bone) {
      at_rest[i] = {};
      continue;
    }
    joints_.back() = built.add_joint({.a = bodies_[bone.parent],
                                      .b = bodies_[i],
                                      .frame_a = bone.frame_on_parent,
                                      .frame_b = bone.frame,
                                      .kind = bone.joint});
    // With the joint at 0, both frames coincide.
    const Pose frame = compose(at_rest[bone.parent], bone.frame_on_parent);
    const Quat rotation = normalized(frame.rotation * bone.frame.rotation.conjugate());
    at_rest[i] = {frame.position - rotation * bone.frame.position, rotation};
  }
  for (std::size_t i = 0; i < bones_.size(); ++i)
    for (std::size_t k = i + 1; k < bones_.size(); ++k)
      if (collide(bones_[i].shape, at_rest[i], bones_[k].shape, at_rest[k]).count > 0)
        built.ignore(bodies_[i], bodies_[k]);
  world = std::move(built);
}

void Ragdoll::follow(World& world, std::span<const WorldMotion> end_of_step) const {
  for (std::size_t i = 0; i < bones_.size(); ++i)
    world.set_target(bodies_[i], ragdoll::unscaled(end_of_step[bones_[i].node].motion));
}

void Ragdoll::set_drive(World& world, const Drive& drive) const {
  for (const BodyId& body : bodies_) world.set_drive(body, drive);
}

void Ragdoll::remove(World& world) const {
  for (const BodyId& body : bodies_) world.remove(body);
}

void Ragdoll::pose(const World& world, const Hierarchy& hierarchy, std::span<Motion> local) const {
  std::vector<std::size_t> bone_at(hierarchy.size(), no_bone);
  for (std::size_t i = 0; i < bones_.size(); ++i) bone_at[bones_[i].node] = i;
  std::vector<WorldMotion> placed(hierarchy.size());
  for (std::size_t node = 0; node < hierarchy.size(); ++node) {
    const std::size_t parent = hierarchy[node].parent;
    const WorldMotion above = parent == no_node ? WorldMotion{} : placed[parent];
    if (bone_at[node] != no_bone) {
      Motion body = world.motion(bodies_[bone_at[node]]);
      const Motion own = child_of(above, local[node]).motion;
      body.pose.scale = own.pose.scale;
      body.scale_rate = own.scale_rate;
      const Motion relative = relative_to(above.motion, body);
      local[node].pose.rotation = relative.pose.rotation;
      local[node].twist.angular = relative.twist.angular;
      if (bones_[bone_at[node]].parent == no_bone) {
        local[node].pose.position = relative.pose.position;
        local[node].twist.linear = relative.twist.linear;
      }
    }
    placed[node] = child_of(above, local[node]);
  }
}

}  // namespace tweenfall
