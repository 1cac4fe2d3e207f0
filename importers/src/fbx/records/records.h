#pragma once

// Parses an FBX file into records, from its text or its binary form.
// Source: A. Cruz and others, "FBX binary file format specification", code.blender.org, 2013; for the 64-bit headers of
// version 7500 and the text, the files themselves.

#include "fbx/records/record.h"
#include "fbx/records/source.h"

namespace tweenfall::fbx {

struct File {
  std::int64_t version = 0;  ///< 7400 for 7.4
  Record root;
};

/// Whether the bytes are those of a binary file.
[[nodiscard]] bool is_binary(std::string_view bytes) noexcept;

/// @throws ModelError with the place where the bytes are not FBX.
[[nodiscard]] File read_records(const Source& source);

[[nodiscard]] File read_binary_records(const Source& source);
[[nodiscard]] File read_text_records(const Source& source);

}  // namespace tweenfall::fbx
