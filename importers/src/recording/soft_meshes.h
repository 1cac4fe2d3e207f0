#pragma once

// Recorded soft bodies as meshes that morph: what pictures and files show of them.

#include <tweenfall/physics/stage/recording.h>

#include <optional>

namespace tweenfall::recordings {

struct Dressed {
  Recording recording;
  StageDescription stage;
};

/// A recording with soft bodies as one in which each is a node of its name with a mesh: of its surface, or a tube along
/// its edges. The mesh is that of the first frame, with a morph target for each later one, or for as many as there is
/// room for; the node's weights lead from one to the next. What tears shrinks to a point. Nothing where there are none.
[[nodiscard]] std::optional<Dressed> with_soft_meshes(const Recording& recording, const StageDescription& stage);

}  // namespace tweenfall::recordings
