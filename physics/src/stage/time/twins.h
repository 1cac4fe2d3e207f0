#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall::staging {

/// Takes out of a list, for each of others in turn, the first that is left and the same, if there is one. Where the two
/// are in the same order, in a time that grows with their number.
/// @param same  of one of the list and one of the others
template <class T, class Other, class Same>
void take_out_twins(std::vector<T>& list, std::span<const Other> others, const Same& same) {
  std::vector<char> gone(list.size(), 0);
  std::size_t first = 0;
  for (const Other& other : others) {
    while (first < list.size() && gone[first]) ++first;
    for (std::size_t i = first; i < list.size(); ++i)
      if (!gone[i] && same(list[i], other)) {
        gone[i] = 1;
        break;
      }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (gone[i]) continue;
    if (kept != i) list[kept] = std::move(list[i]);
    ++kept;
  }
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(kept), list.end());
}

}  // namespace tweenfall::staging
