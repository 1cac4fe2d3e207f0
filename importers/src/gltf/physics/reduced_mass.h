#pragma once

#include <tweenfall/importers/model.h>

#include <optional>
#include <span>
#include <vector>

namespace tweenfall::gltf::physics {

/// What a spring between the two ends of a joint moves: glTF tells springs by their stiffness, a joint by frequency.
struct ReducedMass {
  double linear = 0;   ///< kg
  double angular = 0;  ///< about the frame's x axis through its origin, kg m^2
};

/// Bodies by node, and what they weigh.
class Masses {
 public:
  Masses(std::size_t nodes, std::span<const ModelBody> bodies);

  /// Of the ends that can move; empty where none can.
  [[nodiscard]] std::optional<ReducedMass> reduced(const JointDescription& joint) const;

 private:
  std::vector<const ModelBody*> body_of_;  ///< by node; null where there is none
};

}  // namespace tweenfall::gltf::physics
