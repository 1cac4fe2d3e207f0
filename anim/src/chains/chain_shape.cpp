#include "chains/chain_shape.h"

namespace tweenfall::chains {

ChainShape::ChainShape(const JointChain& chain, std::span<const Motion> pose) noexcept
    : chain_(&chain), count_(chain.joints().size()) {
  const Hierarchy& nodes = chain.nodes();
  Arrow scale{Vec3(1, 1, 1), Vec3(0, 0, 0)};
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t node = joint(i).node, next = i + 1 < count_ ? joint(i + 1).node : chain.end();
    reflection_[i] = tweenfall::pose::reflection_of(scale.v);
    scale = componentwise(scale, scale_of(pose[node]));
    bone_[i] = componentwise(scale, position_of(seen_from(nodes, node, next, pose)));
    length_[i] = chains::length(bone_[i]);
    reach_ = reach_ + length_[i];
    fixed_[i].v = tweenfall::pose::reflected_by(reflection_[i], joint(i).rest);
    if (i + 1 < count_ && nodes[next].parent != node) {
      const Motion carrier = seen_from(nodes, node, nodes[next].parent, pose);
      between_[i + 1] = reflected_by(tweenfall::pose::reflection_of(scale.v), rotation_of(carrier));
      scale = componentwise(scale, scale_of(carrier));
    }
    turn_[i] = within_limits(joint(i), inverse(fixed_[i]) * reflected_by(reflection_[i], rotation_of(pose[node])));
  }
  at_[0] = position_of(pose[joint(0).node]);
  place();
}

void ChainShape::place_one(std::size_t i) noexcept {
  own_[i] = outer_[i] * turn_[i];
  at_[i + 1] = at_[i] + own_[i] * bone_[i];
  if (i + 1 == count_) return;
  outer_[i + 1] = own_[i] * between_[i + 1] * fixed_[i + 1];
  own_[i + 1] = outer_[i + 1] * turn_[i + 1];
}

void ChainShape::place(std::size_t from) noexcept {
  for (std::size_t i = from; i < count_; ++i) {
    outer_[i] = (i == 0 ? between_[0] : own_[i - 1] * between_[i]) * fixed_[i];
    own_[i] = outer_[i] * turn_[i];
    at_[i + 1] = at_[i] + own_[i] * bone_[i];
  }
}

void ChainShape::aim(std::size_t i, const Arrow& from, const Arrow& to) noexcept {
  turn_[i] = turned_towards(joint(i), turn_[i], inside(i, from), inside(i, to));
  place(i);
}

}  // namespace tweenfall::chains
