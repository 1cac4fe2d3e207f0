#include "document/read/parents_first.h"

#include <utility>

namespace tweenfall::document {

void parents_first(Building& building) {
  std::vector<NodeDescription>& nodes = building.stage.nodes;
  std::vector<std::size_t> place(nodes.size(), no_node), order, waiting;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    // From this node up to the first one already placed, then down again.
    for (std::size_t at = i; at != no_node && place[at] == no_node; at = nodes[at].parent) waiting.push_back(at);
    for (; !waiting.empty(); waiting.pop_back()) {
      place[waiting.back()] = order.size();
      order.push_back(waiting.back());
    }
  }
  const auto renumber = [&](std::size_t& node) {
    if (node != no_node) node = place[node];
  };

  std::vector<NodeDescription> sorted;
  sorted.reserve(nodes.size());
  for (const std::size_t old : order) {
    sorted.push_back(std::move(nodes[old]));
    renumber(sorted.back().parent);
  }
  nodes = std::move(sorted);
  for (auto& [name, node] : building.nodes) renumber(node);
  for (JointDescription& joint : building.stage.joints) {
    renumber(joint.a);
    renumber(joint.b);
  }
  for (MeshInstance& instance : building.stage.mesh_instances) renumber(instance.node);
  for (Skin& skin : building.stage.skins)
    for (std::size_t& joint : skin.joints) renumber(joint);
}

}  // namespace tweenfall::document
