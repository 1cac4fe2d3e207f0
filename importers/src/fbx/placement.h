#pragma once

// The transform of an FBX node relative to its parent: translation, rotation and scale about their pivots.

#include "fbx/motion/channels.h"

namespace tweenfall::fbx {

struct Placement {
  Channel<Vec3> position;
  Channel<Quat> rotation;
  Channel<Vec3> scale;
};

/// At rest, or as a stack moves it.
///
/// The file's transform is T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1, where pivots and offsets are translations:
/// a rotation Q = Rpre R Rpost^-1 and a scale S about the point T + Roff + Rp + Q (Soff + Sp - S Sp - Rp). Source:
/// Autodesk, FBX SDK documentation, "Computing transformation matrices".
[[nodiscard]] Placement placement(const Objects& objects, std::size_t object, const Stack* stack);

}  // namespace tweenfall::fbx
