#pragma once

// An array of a binary FBX file, plain or packed by zlib.

#include "fbx/records/source.h"

namespace tweenfall::fbx {

/// How an array is stored, as stated by the file.
struct PackedArray {
  std::size_t at = 0;         ///< the byte where it begins, for errors
  std::size_t count = 0;      ///< elements
  std::size_t size = 1;       ///< bytes of an element
  bool packed = false;        ///< by zlib
  std::string_view stored{};  ///< bytes in the file
};

/// The array's count * size bytes. Memory grows with the actual output, never with the size stated by the file; sizes
/// impossible for so few bytes are refused beforehand. @throws ModelError with the place
[[nodiscard]] std::string unpacked(const PackedArray& array, const Source& source);

}  // namespace tweenfall::fbx
