#pragma once

#include <cstdint>

namespace tweenfall::saving {

/// FNV-1a over 64-bit words with a final mix.
/// Source: Fowler, Noll, Vo, The FNV Non-Cryptographic Hash Algorithm, IETF draft; splitmix64's finalizer.
class WordHash {
 public:
  void add(std::uint64_t word) {
    value_ ^= word;
    value_ *= 0x100000001b3u;
    value_ ^= value_ >> 29;
  }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t z = value_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace tweenfall::saving
