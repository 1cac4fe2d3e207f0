#pragma once

/// Which of many boxes meet: the broad phase alone, by any of the searches that a world has.

#include <tweenfall/physics/strategies.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall {

struct PairsFound {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< of boxes, by index, smaller first; sorted
  std::size_t tests = 0;  ///< of one box against another, or a box around several; `tree` counts only those that meet
  std::vector<Bounds>
      cells;  ///< into which space was cut, or boxes around boxes; empty for `all_pairs`, `sweep`, `tree`
};

/// The pairs of boxes that have a point in common, the same for every search.
/// @throws std::invalid_argument for a box that is not finite (within 1e100) or upside down, for an unknown search,
/// and when more than twenty million pairs meet
[[nodiscard]] PairsFound find_pairs(PairSearch by, std::span<const Bounds> boxes);

}  // namespace tweenfall
