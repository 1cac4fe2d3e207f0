#pragma once

// Arrays of numbers inside a text: little-endian bytes as base64.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace tweenfall::recordings {

/// RFC 4648 base64 with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

[[nodiscard]] std::string base64(std::span<const float> numbers);
[[nodiscard]] std::string base64(std::span<const double> numbers);
[[nodiscard]] std::string base64(std::span<const std::uint32_t> numbers);

}  // namespace tweenfall::recordings
