#pragma once

// Messages about names of joints that a hierarchy does not have.

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/nearest_name.h>

#include <string>
#include <vector>

namespace tweenfall::pose {

/// no joint is named "hnd.L"; did you mean "hand.L"?
[[nodiscard]] inline std::string no_joint_named(const Hierarchy& nodes, const std::string& name) {
  const bool pattern = name.find('*') != std::string::npos;
  if (pattern) return "no joint matches \"" + name + "\"";
  std::vector<std::string> names;
  names.reserve(nodes.size());
  for (const Node& node : nodes.nodes()) names.push_back(node.name);
  const std::string nearest = nearest_name(name, names);
  return "no joint is named \"" + name + "\"" + (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?");
}

}  // namespace tweenfall::pose
