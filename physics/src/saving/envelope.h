#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::saving {

/// What precedes saved contents: "tweenfall KIND", a version, the length of the contents, and their checksum.
struct Envelope {
  const char* kind;       ///< a word of five letters
  std::uint32_t version;  ///< raised whenever the fields change, so that older bytes are refused and not misread
};

[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes);
[[nodiscard]] std::vector<std::byte> sealed(const Envelope& envelope, std::span<const std::byte> contents);
/// The contents of saved bytes. @throws std::invalid_argument if what precedes them is not right
[[nodiscard]] std::span<const std::byte> opened(const Envelope& envelope, std::span<const std::byte> saved);

}  // namespace tweenfall::saving
