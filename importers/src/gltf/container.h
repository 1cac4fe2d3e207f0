#pragma once

// The outer shell of a glTF file: its JSON and the bytes of its buffers.

#include "../model_problems.h"
#include "fields.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::gltf {

struct Container {
  nlohmann::json document;
  std::vector<std::string> buffers;  ///< exactly "byteLength" bytes each; empty where there was a problem
  std::size_t file_size = 0;         ///< bytes of the file and everything it names
};

/// Takes apart the bytes of a .glb or .gltf. Whatever is wrong goes to `problems`.
/// @param file  where it came from; buffers in files of their own must lie in its folder or below
[[nodiscard]] Container open_container(std::string_view bytes, const std::filesystem::path& file,
                                       ModelProblems& problems);

}  // namespace tweenfall::gltf
