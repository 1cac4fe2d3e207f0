#pragma once

// A hash of numbers and texts.

#include <bit>
#include <cstdint>
#include <string_view>

namespace tweenfall::graphs {

/// FNV-1a, 64 bits. Source: Fowler, Noll, Vo, "The FNV non-cryptographic hash algorithm", 1991.
class Digest {
 public:
  void byte(std::uint8_t byte) noexcept { value_ = (value_ ^ byte) * 0x100000001b3; }
  void number(std::uint64_t number) noexcept {
    for (int shift = 0; shift < 64; shift += 8) byte(static_cast<std::uint8_t>(number >> shift));
  }
  void number(double real) noexcept { number(std::bit_cast<std::uint64_t>(real)); }
  void text(std::string_view text) noexcept {
    number(std::uint64_t{text.size()});
    for (const char letter : text) byte(static_cast<std::uint8_t>(letter));
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace tweenfall::graphs
