#include <algorithm>
#include <array>

#include "pairs/searches/cells.h"

namespace tweenfall::pairs {

namespace {

void cut_in_two(Search& search, const Bounds& cell, std::span<const std::uint32_t> inside, int depth) {
  if (inside.size() > few_in_cell && depth < most_cuts_of_cell) {
    const Vec3 sides = cell.high - cell.low;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (sides[i] > sides[axis]) axis = i;
    std::vector<double> middles;
    middles.reserve(inside.size());
    for (const std::uint32_t place : inside) {
      const Bounds& box = search.items[place].box;
      middles.push_back(box.low[axis] + 0.5 * (box.high[axis] - box.low[axis]));
    }
    const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
    std::nth_element(middles.begin(), half, middles.end());
    std::array<Bounds, 2> cells{cell, cell};
    cells[0].high[axis] = cells[1].low[axis] = std::clamp(*half, cell.low[axis], cell.high[axis]);
    std::array<std::vector<std::uint32_t>, 2> parts;
    for (const std::uint32_t place : inside)
      for (std::size_t part = 0; part < 2; ++part)
        if (overlap(cells[part], search.items[place].box)) parts[part].push_back(place);
    if (worth_cutting(parts, inside.size())) {
      for (std::size_t part = 0; part < 2; ++part) cut_in_two(search, cells[part], parts[part], depth + 1);
      return;
    }
  }
  search.cells.push_back(cell);
  search.test_all(inside);
}

}  // namespace

/// Space cut in two with half of the boxes on either side, and each part again, across its longest side. Only
/// boxes that share a cell are tested against each other. Source: Bentley, Multidimensional binary search trees used
/// for associative searching, Communications of the ACM 18, 1975.
void kd_tree(Search& search) {
  if (search.items.empty()) return;
  std::vector<std::uint32_t> inside(search.items.size());
  for (std::uint32_t i = 0; i < inside.size(); ++i) inside[i] = i;
  cut_in_two(search, search.all(), inside, 0);
}

}  // namespace tweenfall::pairs
