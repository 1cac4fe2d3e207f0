#pragma once

// Collada and OBJ through assimp, with its known faults repaired or reported, in this process.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string>

namespace tweenfall::assimp {

/// Units, axes and clock are those of the file.
/// @throws ModelError; but a malformed file may also end the process, see helper.h.
[[nodiscard]] Model read(const std::string& bytes, const std::filesystem::path& file, models::ModelProblems& problems);

}  // namespace tweenfall::assimp
