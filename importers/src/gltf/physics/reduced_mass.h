#pragma once

#include <tweenfall/importers/model.h>

#include <optional>
#include <span>
#include <vector>

namespace tweenfall::gltf::physics {

/// The reduced mass moved by a spring between the two ends of a joint: glTF states stiffness, our joints frequency.
struct ReducedMass {
  double linear = 0;   ///< kg
  double angular = 0;  ///< about the frame's x axis through its origin, kg m^2
};

/// The masses of bodies, by node.
class Masses {
 public:
  Masses(std::size_t nodes, std::span<const ModelBody> bodies);

  /// The reduced mass of the ends that can move; empty where none can.
  [[nodiscard]] std::optional<ReducedMass> reduced(const JointDescription& joint) const;

 private:
  std::vector<const ModelBody*> body_of_;  ///< by node; null where there is none
};

}  // namespace tweenfall::gltf::physics
