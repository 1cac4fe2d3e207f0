#pragma once

#include "pairs/searches/searches.h"

namespace tweenfall::pairs {

/// So few in a cell are tested against each other rather than cut again.
constexpr std::size_t few_in_cell = 8;
/// Greatest depth of cuts.
constexpr int most_cuts_of_cell = 24;

/// Whether it is worth while to have these parts of a cell instead of `count` items in one: some part must be
/// smaller than the whole, and not too many items may lie in more than one part.
[[nodiscard]] bool worth_cutting(std::span<const std::vector<std::uint32_t>> parts, std::size_t count);

/// Cells cut in the middle along each of some axes, again and again where there are many items.
void halve_along(Search& search, std::span<const int> axes);

}  // namespace tweenfall::pairs
