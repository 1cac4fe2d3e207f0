#pragma once

/// The bytes in which worlds and stages are saved: a header of signature, version, size and checksum, then the
/// contents.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "saving/word_hash.h"

namespace tweenfall::test {

constexpr std::size_t header = 36;

inline void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value, std::size_t size = 8) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
}

/// Corrects size and checksum, so that changed contents are read.
inline void seal(std::vector<std::byte>& bytes) {
  saving::WordHash hash;
  for (std::size_t i = header; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], std::min<std::size_t>(8, bytes.size() - i));
    hash.add(word);
  }
  put(bytes, 20, bytes.size() - header);
  put(bytes, 28, hash.value());
}

}  // namespace tweenfall::test
