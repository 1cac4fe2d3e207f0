#pragma once

// What pictures and files show of a recording beside its nodes: soft bodies and wheels, as nodes with meshes.

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>

namespace tweenfall::recordings {

struct Dressed {
  Recording recording;
  StageDescription stage;

  /// A node more, of this name or one near it, with a mesh.
  void add(NodeRecord node, std::string name, Mesh mesh);
};

/// Each soft body becomes a node of its name with a mesh: of its surface, or a tube along its edges. The mesh is that
/// of the first frame, with a morph target for each later one, or for as many as there is room for; the node's weights
/// lead from one to the next. What tears shrinks to a point.
void add_soft_meshes(Dressed& out);

/// Each wheel becomes a node of its vehicle's and its own name that rolls below the chassis.
void add_wheel_meshes(Dressed& out);

/// A recording with all of them; nothing where there are none.
[[nodiscard]] std::optional<Dressed> with_own_meshes(const Recording& recording, const StageDescription& stage);

}  // namespace tweenfall::recordings
