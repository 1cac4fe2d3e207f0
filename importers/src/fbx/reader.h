#pragma once

// FBX 7.0 and later, text and binary, from the file itself: nodes, clips with their keys and layers, meshes, skins and
// blend shapes. Units, axes and times are those of the file. Source: Autodesk, FBX SDK documentation; beyond that, the
// findings of the projects ufbx and Blender.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string_view>

namespace tweenfall::fbx {

/// @throws ModelError
[[nodiscard]] Model read(std::string_view bytes, const std::filesystem::path& file, models::ModelProblems& problems);

}  // namespace tweenfall::fbx
