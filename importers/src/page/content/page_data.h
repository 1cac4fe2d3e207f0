#pragma once

// The data inside the page: the recording, the shapes and meshes, the key lanes.

#include <tweenfall/physics/stage/recording.h>

#include <string>

namespace tweenfall::page {

/// One JSON object; arrays of numbers as base64, in single precision, which is enough for viewing.
[[nodiscard]] std::string page_data(const Recording& recording, const StageDescription& stage);

}  // namespace tweenfall::page
