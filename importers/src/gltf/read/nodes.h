#pragma once

// The node tree of a glTF document.

#include "gltf/read/fields.h"

#include <tweenfall/anim/hierarchy.h>

#include <optional>
#include <vector>

namespace tweenfall::gltf {

/// A node of the file; indices are those of the file.
struct FileNode {
  Node node;  ///< named uniquely; its parent is an index of the file
  std::optional<std::size_t> mesh, skin;
  std::vector<double> weights;  ///< morph weights of its own, or empty
  bool in_scene = true;         ///< belongs to the scene that the file shows
};

/// All nodes, in the file's order; cycles and second parents are problems.
[[nodiscard]] std::vector<FileNode> read_nodes(const Fields& root);

/// The indices of all nodes in an order with parents first; the file's own order if it is such.
/// Precondition: no cycles.
[[nodiscard]] std::vector<std::size_t> parents_first(const std::vector<FileNode>& nodes);

}  // namespace tweenfall::gltf
