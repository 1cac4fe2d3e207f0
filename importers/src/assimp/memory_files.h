#pragma once

// The files that assimp may see: the model, already in memory, and plain files beside it.

#include <filesystem>
#include <memory>
#include <string>

namespace Assimp {
class IOSystem;
}

namespace tweenfall::assimp {

/// @param bytes  the content of `file`; must outlive what is returned
[[nodiscard]] std::unique_ptr<Assimp::IOSystem> memory_files(const std::string& bytes,
                                                             const std::filesystem::path& file);

}  // namespace tweenfall::assimp
