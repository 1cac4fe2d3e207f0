#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/joint_mask.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <stdexcept>

#include "pose/joint_names.h"

namespace tweenfall {

namespace pose {
namespace {

bool is_share(double weight) noexcept {
  return weight >= 0 && weight <= 1;
}

// Different sizes are refused; a mask of size 0 affects everything.
template <class Combine>
JointMask combined(const JointMask& a, const JointMask& b, const Combine& combine) {
  if (a.size() != 0 && b.size() != 0 && a.size() != b.size())
    throw std::invalid_argument("masks of " + std::to_string(a.size()) + " and of " + std::to_string(b.size()) +
                                " nodes do not fit each other");
  std::vector<double> weights(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = combine(a[i], b[i]);
  return JointMask(std::move(weights));
}

}  // namespace
}  // namespace pose

JointMask::JointMask(const Hierarchy& nodes, std::span<const MaskPart> parts, double elsewhere)
    : weights_(nodes.size(), elsewhere) {
  std::string problems;
  if (!pose::is_share(elsewhere))
    problems += "\n  the weight elsewhere must be 0 to 1; it is " + number_text(elsewhere);
  std::vector<char> named(nodes.size());
  for (const MaskPart& part : parts) {
    if (!pose::is_share(part.weight))
      problems += "\n  the weight of \"" + part.joints + "\" must be 0 to 1; it is " + number_text(part.weight);
    bool any = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t parent = nodes[i].parent;
      const bool matching = matches(part.joints, nodes[i].name);
      any |= matching;
      named[i] = matching || (part.below && parent != no_node && named[parent]);
      if (named[i]) weights_[i] = part.weight;
    }
    if (!any) problems += "\n  " + pose::no_joint_named(nodes, part.joints);
  }
  if (!problems.empty()) throw std::invalid_argument("a mask does not fit its nodes:" + problems);
}

JointMask::JointMask(std::vector<double> weights) : weights_(std::move(weights)) {
  std::string problems;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (!pose::is_share(weights_[i]))
      problems += "\n  the weight of node " + std::to_string(i) + " must be 0 to 1; it is " + number_text(weights_[i]);
  if (!problems.empty()) throw std::invalid_argument("a mask has invalid weights:" + problems);
}

JointMask both(const JointMask& a, const JointMask& b) {
  return pose::combined(a, b, [](double x, double y) { return x * y; });
}

JointMask either(const JointMask& a, const JointMask& b) {
  return pose::combined(a, b, [](double x, double y) { return std::max(x, y); });
}

JointMask opposite(const JointMask& mask) {
  if (mask.size() == 0) throw std::invalid_argument("a mask of size 0 affects all nodes and has no opposite");
  std::vector<double> weights(mask.size());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 - mask[i];
  return JointMask(std::move(weights));
}

}  // namespace tweenfall
