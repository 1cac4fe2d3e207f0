#pragma once

// The parts of a recording that are not nodes, for pictures and files: soft bodies, wheels and particles, as nodes with
// meshes.

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>

namespace tweenfall::recordings {

struct Dressed {
  Recording recording;
  StageDescription stage;

  /// Adds a node of this name, or a similar one if it is taken, with a mesh.
  void add(NodeRecord node, std::string name, Mesh mesh);
  /// The same, with one of the stage's meshes.
  void add_shown(NodeRecord node, std::string name, std::size_t mesh);
};

/// Each soft body becomes a node of its name with a mesh: of its surface, or a tube along its edges. The mesh is that
/// of the first frame, with a morph target for each later one, or for as many as there is room for; the node's weights
/// go from one to the next. Torn parts shrink to a point.
void add_soft_meshes(Dressed& out);

/// Each wheel becomes a node named after its vehicle and itself that rolls below the chassis.
void add_wheel_meshes(Dressed& out);

/// Particles become nodes, each of which shows one particle after another, with size 0 in between: of each kind as many
/// as a file may have at a time; if there are more, only every k-th particle.
void add_particle_meshes(Dressed& out);

/// A recording with all of them; empty where there are none. @param particles whether these become meshes, too
[[nodiscard]] std::optional<Dressed> with_own_meshes(const Recording& recording, const StageDescription& stage,
                                                     bool particles = false);

}  // namespace tweenfall::recordings
