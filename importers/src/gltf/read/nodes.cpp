#include "gltf/read/nodes.h"

#include "model/model_matrix.h"
#include "model/model_names.h"

#include <tweenfall/curves/number_text.h>

#include <cmath>

namespace tweenfall::gltf {

namespace {

Vec3 vector_of(const Fields& node, const char* name, const Vec3& otherwise) {
  const std::vector<double> v = node.numbers(name, 3);
  return v.empty() ? otherwise : Vec3(v[0], v[1], v[2]);
}

Quat rotation_of(const Fields& node) {
  const std::vector<double> v = node.numbers("rotation", 4);
  if (v.empty()) return Quat::Identity();
  const Quat q(v[3], v[0], v[1], v[2]);
  const double length = q.norm();
  if (!(length > 1e-6 && length < 1e100)) {
    node.problems().add(node.place_of("rotation"), "must be a unit quaternion; its length is " + number_text(length));
    return Quat::Identity();
  }
  if (std::abs(length - 1) > 1e-2)
    node.problems().repair(node.place_of("rotation"),
                           "had length " + number_text(length) + " and was scaled to a unit quaternion");
  return Quat(v[3] / length, v[0] / length, v[1] / length, v[2] / length);
}

Pose rest_of(const Fields& node) {
  if (!node.has("matrix"))
    return {vector_of(node, "translation", {0, 0, 0}), rotation_of(node), vector_of(node, "scale", {1, 1, 1})};
  const std::vector<double> m = node.numbers("matrix", 16);
  if (m.empty()) return {};
  Mat3 linear;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) linear(row, column) = m[static_cast<std::size_t>(4 * column + row)];
  if (std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1) > 1e-6)
    node.problems().repair(node.place_of("matrix"), "had a last row other than 0 0 0 1, which was not read");
  const models::TakenApart parts = models::take_apart(linear, Vec3(m[12], m[13], m[14]));
  if (!parts.pose.scale.allFinite()) {
    node.problems().add(node.place_of("matrix"), "holds numbers too large for a placement");
    return {};
  }
  if (parts.shear > 1e-4)
    node.problems().repair(node.place_of("matrix"), "holds shear, which was dropped; it moved points by up to " +
                                                        number_text(parts.shear) + " of their distance");
  return parts.pose;
}

void link_children(const Fields& root, std::vector<FileNode>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Fields node = root.at("nodes", i);
    for (const std::size_t child : node.indices("children", nodes.size())) {
      std::size_t& parent = nodes[child].node.parent;
      if (parent == no_node)
        parent = i;
      else
        root.problems().add(node.place_of("children"), "node " + std::to_string(child) +
                                                           " already is a child of node " + std::to_string(parent) +
                                                           "; a node has one parent");
    }
  }
}

/// Follows each chain of parents once. Cycles are reported and cut, so that what follows can rely on a tree.
void cut_cycles(std::vector<FileNode>& nodes, models::ModelProblems& problems) {
  std::vector<std::size_t> visit(nodes.size(), 0);
  for (std::size_t start = 0; start < nodes.size(); ++start) {
    const std::size_t mark = start + 1;
    std::size_t at = start;
    while (visit[at] == 0) {
      visit[at] = mark;
      const std::size_t parent = nodes[at].node.parent;
      if (parent == no_node) break;
      if (visit[parent] == mark) {
        problems.add("/nodes/" + std::to_string(parent) + "/children",
                     parent == at ? "node " + std::to_string(at) + " is its own child"
                                  : "node " + std::to_string(at) + " is its own ancestor");
        nodes[at].node.parent = no_node;
        break;
      }
      at = parent;
    }
  }
}

void mark_scene(const Fields& root, std::vector<FileNode>& nodes) {
  const std::size_t scenes = root.list("scenes").size();
  const auto shown = root.index("scene", scenes);
  if (scenes == 0) return;
  for (FileNode& node : nodes) node.in_scene = false;
  for (std::size_t i = 0; i < scenes; ++i) {
    const Fields scene = root.at("scenes", i);
    const std::vector<std::size_t> roots = scene.indices("nodes", nodes.size());
    if (i == shown.value_or(0))
      for (const std::size_t node : roots) nodes[node].in_scene = true;
  }
  for (const std::size_t i : parents_first(nodes)) {
    const std::size_t parent = nodes[i].node.parent;
    if (parent != no_node && nodes[parent].in_scene) nodes[i].in_scene = true;
  }
}

}  // namespace

std::vector<FileNode> read_nodes(const Fields& root) {
  const std::size_t count = root.list("nodes").size(), meshes = root.list("meshes").size();
  std::vector<FileNode> nodes(count);
  models::UniqueNames names;
  for (std::size_t i = 0; i < count; ++i) {
    const Fields node = root.at("nodes", i);
    std::string name = node.text("name");
    if (name.empty()) name = "node_" + std::to_string(i);
    nodes[i].node.name = names.unique(name);
    nodes[i].node.rest = rest_of(node);
    nodes[i].mesh = node.index("mesh", meshes);
    nodes[i].skin = node.index("skin", root.list("skins").size());
    nodes[i].weights = node.numbers("weights", 0);
  }
  link_children(root, nodes);
  cut_cycles(nodes, root.problems());
  mark_scene(root, nodes);
  return nodes;
}

std::vector<std::size_t> parents_first(const std::vector<FileNode>& nodes) {
  std::vector<std::size_t> order, chain;
  std::vector<char> placed(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t at = i; at != no_node && !placed[at]; at = nodes[at].node.parent) {
      placed[at] = 1;
      chain.push_back(at);
    }
    order.insert(order.end(), chain.rbegin(), chain.rend());
    chain.clear();
  }
  return order;
}

}  // namespace tweenfall::gltf
