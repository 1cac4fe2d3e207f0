#pragma once

// Lists made of few runs, each of which is in order: what plays tell of a step, what touched in it, what was asked for.

#include <algorithm>
#include <ranges>

namespace tweenfall::staging {

/// Brings a range in order of a key; equal ones stay as they were. It moves little where few runs follow each other.
template <std::ranges::random_access_range Range, class Key>
void bring_in_order(Range&& range, Key key) {
  constexpr int most_runs = 8;
  const auto begin = std::ranges::begin(range), end = std::ranges::end(range);
  auto ordered = std::ranges::is_sorted_until(begin, end, {}, key);
  for (int run = 1; run < most_runs && ordered != end; ++run) {
    const auto next = std::ranges::is_sorted_until(ordered, end, {}, key);
    std::ranges::inplace_merge(begin, ordered, next, {}, key);
    ordered = next;
  }
  if (ordered != end) std::ranges::stable_sort(begin, end, {}, key);
}

}  // namespace tweenfall::staging
