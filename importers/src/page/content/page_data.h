#pragma once

// What travels inside the page: the recording, the shapes and meshes, the key lanes.

#include <tweenfall/physics/stage/recording.h>

#include <string>

namespace tweenfall::page {

/// One JSON object; arrays of numbers as base64. Places are single precision: a page shows, it does not archive.
[[nodiscard]] std::string page_data(const Recording& recording, const StageDescription& stage);

}  // namespace tweenfall::page
