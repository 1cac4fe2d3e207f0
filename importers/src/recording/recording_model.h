#pragma once

// A recording as a model, for glTF.

#include <tweenfall/importers/model.h>
#include <tweenfall/physics/stage/recording.h>

namespace tweenfall::recordings {

/// Every recorded node at the root, with linear position, rotation and scale tracks of its world motion, one key per
/// frame (a single key for nodes at rest); meshes for the shapes of bodies, colored by owner at the start; meshes and
/// skins of the stage as they are. Shear, which glTF's nodes cannot hold, is dropped.
[[nodiscard]] Model recording_model(const Recording& recording, const StageDescription& stage);

}  // namespace tweenfall::recordings
