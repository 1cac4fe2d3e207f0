#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::blocks {

/// Sorts contacts into colors: those of one color share no movable body, so they can be solved in any order or at once.
/// The colors depend only on the order of the contacts.
/// Source: Catto, SIMD Matters, 2024.
class Coloring {
 public:
  /// Colors of contacts of two movable bodies come first, then those with one: immovable bodies have the last word.
  static constexpr std::uint32_t half = 64;
  /// From here on there are as many colors as needed, for contacts of either sort whose bodies have used up the others.
  static constexpr std::uint32_t late = 2 * half;

  void reset(std::size_t bodies);
  /// @return the color of the next contact
  [[nodiscard]] std::uint32_t color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves);
  /// All colors are below this; at least `late`.
  [[nodiscard]] std::uint32_t end() const { return end_; }

 private:
  [[nodiscard]] std::uint32_t late_color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves);

  struct Taken {
    std::uint64_t pairs = 0, singles = 0;  ///< bits of the colors in which the body has contacts
  };
  std::vector<Taken> taken_;
  std::vector<std::vector<std::uint64_t>> taken_late_;  ///< by body, as far as it needed any
  std::vector<std::uint32_t> with_late_;                ///< the bodies that needed any
  std::uint32_t end_ = late;
};

}  // namespace tweenfall::blocks
