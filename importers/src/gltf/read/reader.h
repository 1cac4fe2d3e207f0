#pragma once

// glTF 2.0, text and binary, from its own JSON and buffers.
// Source: Khronos Group, glTF 2.0 Specification, 2021.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string_view>

namespace tweenfall::gltf {

/// The model in the bytes of a .glb or .gltf file. @throws ModelError
[[nodiscard]] Model read(std::string_view bytes, const std::filesystem::path& file, models::ModelProblems& problems);

}  // namespace tweenfall::gltf
