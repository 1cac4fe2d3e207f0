#pragma once

// Biovision motion capture (BVH): a skeleton with Euler angles for each frame.
// Source: M. Meredith and S. Maddock, Motion Capture File Formats Explained, 2001, section 3.2.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string_view>

namespace tweenfall::bvh {

/// The skeleton and its one clip, "Motion". A position channel replaces its part of the joint's offset.
/// @throws ModelError
[[nodiscard]] Model read_bvh(std::string_view text, const std::filesystem::path& file, models::ModelProblems& problems);

}  // namespace tweenfall::bvh
