#pragma once

// Files that are there whole or not at all.

#include <filesystem>
#include <string_view>

namespace tweenfall::gltf {

/// Writes beside `file` first and renames, so that a reader never sees half of it. @throws std::runtime_error
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace tweenfall::gltf
