#pragma once

#include <tweenfall/physics/joint.h>

namespace tweenfall::joints {

/// @throws std::invalid_argument naming what is wrong
void validate(const JointKind& kind);

/// The settings with rotations of unit length. @throws std::invalid_argument naming what is wrong
[[nodiscard]] JointSettings checked(JointSettings settings);

}  // namespace tweenfall::joints
