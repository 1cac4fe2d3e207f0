#pragma once

// assimp in a process of its own. Its assertions are compiled in, and a malformed file can end the process, or exhaust
// its stack or its memory; so a small program, tweenfall-import-helper, runs it and returns the model read.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <string>

namespace tweenfall::assimp {

/// The model read by the helper. Where processes cannot be started at all (no POSIX), assimp runs in this one, and a
/// repair says so.
/// @throws ModelError when assimp refuses the file, crashes on it, takes more time or memory than its size warrants, or
///         the helper is not found.
[[nodiscard]] Model read_in_helper(const std::string& bytes, const std::filesystem::path& file,
                                   models::ModelProblems& problems);

/// The main function of the helper: imports `file` within bounds of memory and processor time, and writes the model, or
/// the error, to standard output. @returns the exit code
int help(int count, char** words);

}  // namespace tweenfall::assimp
