#include "pairs/searches/cells.h"

#include <algorithm>

namespace tweenfall::pairs {

namespace {

void halve_cell(Search& search, std::span<const int> axes, const Bounds& cell, std::span<const std::uint32_t> inside,
                int depth) {
  const std::size_t count = std::size_t{1} << axes.size();
  if (inside.size() > few_in_cell && depth < most_cuts_of_cell) {
    std::vector<Bounds> cells(count, cell);
    std::vector<std::vector<std::uint32_t>> parts(count);
    for (std::size_t part = 0; part < count; ++part)
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const int axis = axes[k];
        const double middle = cell.low[axis] + 0.5 * (cell.high[axis] - cell.low[axis]);
        ((part >> k & 1) != 0 ? cells[part].low : cells[part].high)[axis] = middle;
      }
    for (const std::uint32_t place : inside)
      for (std::size_t part = 0; part < count; ++part)
        if (overlap(cells[part], search.items[place].box)) parts[part].push_back(place);
    if (worth_cutting(parts, inside.size())) {
      for (std::size_t part = 0; part < count; ++part)
        if (!parts[part].empty()) halve_cell(search, axes, cells[part], parts[part], depth + 1);
      return;
    }
  }
  search.cells.push_back(cell);
  search.test_all(inside);
}

}  // namespace

bool worth_cutting(std::span<const std::vector<std::uint32_t>> parts, std::size_t count) {
  std::size_t sum = 0, most = 0;
  for (const std::vector<std::uint32_t>& part : parts) {
    sum += part.size();
    most = std::max(most, part.size());
  }
  return most < count && sum <= 2 * count;
}

void halve_along(Search& search, std::span<const int> axes) {
  if (search.items.empty()) return;
  std::vector<std::uint32_t> inside(search.items.size());
  for (std::uint32_t i = 0; i < inside.size(); ++i) inside[i] = i;
  halve_cell(search, axes, search.all(), inside, 0);
}

}  // namespace tweenfall::pairs
