#pragma once

// What pictures and files show of a recording beside its nodes: soft bodies, wheels and particles, as nodes
// with meshes.

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>

namespace tweenfall::recordings {

struct Dressed {
  Recording recording;
  StageDescription stage;

  /// A node more, of this name or one near it, with a mesh.
  void add(NodeRecord node, std::string name, Mesh mesh);
  /// The same, with one of the stage's meshes.
  void add_shown(NodeRecord node, std::string name, std::size_t mesh);
};

/// Each soft body becomes a node of its name with a mesh: of its surface, or a tube along its edges. The mesh is that
/// of the first frame, with a morph target for each later one, or for as many as there is room for; the node's weights
/// lead from one to the next. What tears shrinks to a point.
void add_soft_meshes(Dressed& out);

/// Each wheel becomes a node of its vehicle's and its own name that rolls below the chassis.
void add_wheel_meshes(Dressed& out);

/// Particles become nodes that are one after another of them, and of no size in between: of each kind as many as a file
/// takes at a time, counted through where there are more.
void add_particle_meshes(Dressed& out);

/// A recording with all of them; nothing where there are none. @param particles  whether these are meshes, too
[[nodiscard]] std::optional<Dressed> with_own_meshes(const Recording& recording, const StageDescription& stage,
                                                     bool particles = false);

}  // namespace tweenfall::recordings
