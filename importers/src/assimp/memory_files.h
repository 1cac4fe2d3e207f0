#pragma once

// The files that assimp may see: the model, already in memory, and plain files beside it.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace Assimp {
class IOSystem;
}

namespace tweenfall::assimp {

/// @param bytes the content of `file`; must outlive the result
/// @param missing  receives the names of files requested but not found, in order; must outlive the result
[[nodiscard]] std::unique_ptr<Assimp::IOSystem> memory_files(const std::string& bytes,
                                                             const std::filesystem::path& file,
                                                             std::vector<std::string>& missing);

}  // namespace tweenfall::assimp
