#pragma once

// The outer shell of a glTF file: its JSON and the bytes of its buffers.

#include "gltf/read/fields.h"
#include "model/model_problems.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::gltf {

struct Container {
  json::Tree document;
  bool has_lines = true;             ///< whether the document is a file of its own, which has lines and columns
  std::vector<std::string> buffers;  ///< exactly "byteLength" bytes each; empty where there was a problem
  std::size_t file_size = 0;         ///< bytes of the file and everything it names
};

/// Takes apart the bytes of a .glb or .gltf, which must outlive the result. Faults go to `problems`.
/// @param file  where it came from; buffers in files of their own must lie in its folder or below
[[nodiscard]] Container open_container(std::string_view bytes, const std::filesystem::path& file,
                                       models::ModelProblems& problems);

/// The position in the text of the value at a place such as "/nodes/0/mesh", or of the innermost existing one around
/// it; empty for invalid places and for binary files.
[[nodiscard]] std::optional<json::TextPlace> place_in(const Container& container, std::string_view place);

}  // namespace tweenfall::gltf
