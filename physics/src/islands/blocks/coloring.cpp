#include "islands/blocks/coloring.h"

#include <bit>

namespace tweenfall::blocks {

std::uint32_t Coloring::color(std::uint32_t a, bool a_moves, std::uint32_t b, bool b_moves) {
  if (a_moves && b_moves) {
    const std::uint64_t open = ~(taken_[a].pairs | taken_[b].pairs);
    if (open == 0) return none;
    const std::uint64_t bit = open & (~open + 1);
    taken_[a].pairs |= bit;
    taken_[b].pairs |= bit;
    return static_cast<std::uint32_t>(std::countr_zero(bit));
  }
  std::uint64_t& taken = taken_[a_moves ? a : b].singles;
  if (~taken == 0) return none;
  const std::uint64_t bit = ~taken & (taken + 1);
  taken |= bit;
  return half + static_cast<std::uint32_t>(std::countr_zero(bit));
}

}  // namespace tweenfall::blocks
