#include "gltf/physics/reduced_mass.h"

namespace tweenfall::gltf::physics {

Masses::Masses(std::size_t nodes, std::span<const ModelBody> bodies) : body_of_(nodes, nullptr) {
  for (const ModelBody& body : bodies) body_of_[body.node] = &body;
}

std::optional<ReducedMass> Masses::reduced(const JointDescription& joint) const {
  double linear = 0, angular = 0;  // sums of 1/mass
  const auto add = [&](std::size_t node, const Pose& frame) {
    const ModelBody* found = node == no_node ? nullptr : body_of_[node];
    if (!found || found->keyed || found->body.fixed || is_scenery(found->body.shape.solid)) return;
    const BodyDescription& body = found->body;
    const MassProperties of_all =
        body.mass_properties ? *body.mass_properties
                             : mass_properties(body.shape, body.mass.value_or(body.density * volume(body.shape.solid)));
    const Vec3 axis = frame.rotation * Vec3(1, 0, 0);
    linear += 1 / of_all.mass;
    angular += 1 / axis.dot(inertia_about(of_all, frame.position) * axis);
  };
  add(joint.a, joint.frame_a);
  add(joint.b, joint.frame_b);
  if (!(linear > 0)) return std::nullopt;
  return ReducedMass{1 / linear, 1 / angular};
}

}  // namespace tweenfall::gltf::physics
