#pragma once

// The nodes of an FBX scene, and where a stack moves them.

#include "fbx/placement.h"

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <map>

namespace tweenfall::fbx {

/// How a node inherits its parent's scale. Source: Autodesk, FBX SDK, FbxTransform::EInheritType.
enum class Inherit {
  factors,  ///< RrSs: the parent's factors times its own, along its own axes
  normal,   ///< RSrs: the whole placement of the parent
  none,     ///< Rrs: all but the parent's own scale
};

/// A "Model" of the file, and the nodes made from it.
struct FileNode {
  std::size_t object = 0;
  std::size_t parent = no_node;  ///< index among the file's nodes
  Inherit inherit = Inherit::normal;
  std::size_t node = no_node;  ///< our node of that name
  /// Our node with its position and rotation but not its scale, for children that do not inherit it; else the same.
  std::size_t frame = no_node;
};

class Nodes {
 public:
  /// @throws ModelError
  Nodes(const Objects& objects, models::ModelProblems& problems);

  /// Parents first; axes and units are those of the file.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<FileNode>& files() const { return files_; }
  /// Our node for a "Model"; no_node for none.
  [[nodiscard]] std::size_t of(std::size_t object) const;

  /// World motion of a "Model" at rest.
  [[nodiscard]] WorldMotion at_rest(std::size_t object) const;

  /// Tracks of all nodes that the stack moves.
  [[nodiscard]] std::vector<Track> tracks(const Stack& stack) const;

 private:
  /// The placement of each file node, for its own node and for its frame.
  struct Placed {
    Placement placement;
    Channel<Vec3> passed_on;  ///< scale for children that inherit factors
  };

  void find_models(models::ModelProblems& problems);
  void make_nodes();
  [[nodiscard]] std::vector<Placed> placed(const Stack* stack) const;

  const Objects& objects_;
  std::vector<FileNode> files_;
  std::vector<Node> nodes_;
  std::map<std::size_t, std::size_t> by_object_;
};

}  // namespace tweenfall::fbx
