#pragma once

// The keys of one FBX animation curve as a curve of ours: constant, linear and cubic spans stay what they are.

#include "fbx/objects.h"

#include <tweenfall/curves/curve.h>

#include <optional>

namespace tweenfall::fbx {

/// The curve with its values times `scale`; empty if it has no keys.
/// @throws ModelError with the place of lists that do not fit together or hold no finite numbers.
[[nodiscard]] std::optional<Curve<double>> key_curve(const Object& curve, const Objects& objects, double scale,
                                                     models::ModelProblems& problems);

}  // namespace tweenfall::fbx
