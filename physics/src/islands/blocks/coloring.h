#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::blocks {

/// Sorts contacts into colors: those of one share no movable body, so that they can be solved in any order or at once.
/// The colors depend on the order of the contacts alone.
/// Source: Catto, SIMD Matters, 2024.
class Coloring {
 public:
  /// Colors of contacts between two movable bodies come first, then those with one: what stands firm has the last word.
  static constexpr std::uint32_t half = 64;
  /// Contacts that found no color: to be solved one by one.
  static constexpr std::uint32_t none = 2 * half;

  void reset(std::size_t bodies) { taken_.assign(bodies, {}); }
  /// @return the color of the next contact
  [[nodiscard]] std::uint32_t color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves);

 private:
  struct Taken {
    std::uint64_t pairs = 0, singles = 0;  ///< bits of the colors that the body has contacts in
  };
  std::vector<Taken> taken_;
};

}  // namespace tweenfall::blocks
