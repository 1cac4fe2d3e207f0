#pragma once

// Lists that are nearly in order: what came early is, and a few things that came late are not.

#include <algorithm>
#include <ranges>

namespace tweenfall::staging {

/// Brings a range in order of a key; equal ones stay as they were. It takes few moves where only the end is out of
/// order.
template <std::ranges::random_access_range Range, class Key>
void bring_in_order(Range&& range, Key key) {
  const auto late = std::ranges::is_sorted_until(range, {}, key);
  if (late == std::ranges::end(range)) return;
  std::ranges::stable_sort(late, std::ranges::end(range), {}, key);
  std::ranges::inplace_merge(range, late, {}, key);
}

}  // namespace tweenfall::staging
