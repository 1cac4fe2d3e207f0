#pragma once

// FBX, Collada and OBJ through assimp, with its known faults mended or stated.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string>

namespace tweenfall {

/// Units, axes and clock are the file's; keys come as assimp resamples them, so tangents and holds of FBX are lost.
/// @throws ModelError
[[nodiscard]] Model read_with_assimp(const std::string& bytes, const std::filesystem::path& file,
                                     ModelProblems& problems);

}  // namespace tweenfall
