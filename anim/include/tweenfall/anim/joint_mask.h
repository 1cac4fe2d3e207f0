#pragma once

/// Which joints an operation affects, and how much: a weight from 0 to 1 for each node of a hierarchy.

#include <tweenfall/anim/hierarchy.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// A weight for some joints.
struct MaskPart {
  std::string joints;  ///< a name, or a pattern ("arm/*") in which `*` stands for any run of characters
  double weight = 1;   ///< 0 to 1
  bool below = false;  ///< also for everything below them in the tree
};

/// One weight for each node of the hierarchy it was made for, in order. A mask of size 0, such as a default one,
/// affects every node of any hierarchy fully.
class JointMask {
 public:
  JointMask() = default;

  /// The parts apply in order, a later one overriding an earlier one; `elsewhere` is the weight of all other nodes.
  /// @throws std::invalid_argument listing all problems: a name or pattern that no node has, a weight outside 0 to 1.
  JointMask(const Hierarchy& nodes, std::span<const MaskPart> parts, double elsewhere = 0);

  /// The weights themselves. @throws std::invalid_argument naming each that is outside 0 to 1.
  explicit JointMask(std::vector<double> weights);

  [[nodiscard]] double operator[](std::size_t node) const noexcept { return weights_.empty() ? 1 : weights_[node]; }
  [[nodiscard]] std::size_t size() const noexcept { return weights_.size(); }
  [[nodiscard]] std::span<const double> weights() const noexcept { return weights_; }

  bool operator==(const JointMask&) const = default;

 private:
  std::vector<double> weights_;
};

/// Both masks together: the product of the weights.
/// @throws std::invalid_argument where both sizes are above 0 and differ.
[[nodiscard]] JointMask both(const JointMask& a, const JointMask& b);

/// Either mask: the larger weight. @throws as `both`.
[[nodiscard]] JointMask either(const JointMask& a, const JointMask& b);

/// The complement of the mask: 1 - weight.
/// @throws std::invalid_argument for a mask of size 0, whose number of nodes is not known.
[[nodiscard]] JointMask opposite(const JointMask& mask);

}  // namespace tweenfall
