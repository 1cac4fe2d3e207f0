#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "pairs/searches/searches.h"

namespace tweenfall::pairs {

namespace {

/// Width of a cell in multiples of a middling box.
constexpr double roominess = 2;
/// Boxes that would lie in more cells than this are tested against all instead.
constexpr double most_cells = 512;
/// Greatest number of a cell.
constexpr double last_cell = 1e15;

struct InCell {
  std::array<std::int64_t, 3> cell;
  std::uint32_t place;
  bool operator<(const InCell& other) const { return cell != other.cell ? cell < other.cell : place < other.place; }
};

double middle_side(std::span<const Item> items) {
  std::vector<double> sides;
  sides.reserve(items.size());
  for (const Item& item : items) sides.push_back((item.box.high - item.box.low).maxCoeff());
  std::nth_element(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2), sides.end());
  return sides[sides.size() / 2];
}

}  // namespace

/// Space cut into equal cubes: only boxes that share a cell are tested against each other.
void grid(Search& search) {
  if (search.items.empty()) return;
  const double side = middle_side(search.items);
  const double size = side > 0 && side < 1e30 ? roominess * side : 1;
  std::vector<InCell> in_cells;
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < search.items.size(); ++i) {
    const Vec3 from = (search.items[i].box.low / size).array().floor();
    const Vec3 to = (search.items[i].box.high / size).array().floor();
    const Vec3 count = to - from + Vec3::Ones();
    if (!(count.x() * count.y() * count.z() <= most_cells) || from.cwiseAbs().maxCoeff() > last_cell) {
      large.push_back(i);
      continue;
    }
    const auto cell = [](double number) { return static_cast<std::int64_t>(number); };
    for (std::int64_t x = cell(from.x()); x <= cell(to.x()); ++x)
      for (std::int64_t y = cell(from.y()); y <= cell(to.y()); ++y)
        for (std::int64_t z = cell(from.z()); z <= cell(to.z()); ++z) in_cells.push_back({{x, y, z}, i});
  }
  std::sort(in_cells.begin(), in_cells.end());
  std::vector<std::uint32_t> together;
  for (std::size_t i = 0; i < in_cells.size();) {
    const auto& cell = in_cells[i].cell;
    together.clear();
    const Vec3 low =
        size * Vec3(static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2]));
    search.cells.push_back({low, low + Vec3::Constant(size)});
    std::size_t end = i;
    for (; end < in_cells.size() && in_cells[end].cell == cell; ++end) together.push_back(in_cells[end].place);
    search.test_all(together);
    i = end;
  }
  for (std::size_t i = 0; i < large.size(); ++i)
    for (std::uint32_t other = 0; other < search.items.size(); ++other)
      // Of two large ones, the first tests them against each other.
      if (!std::binary_search(large.begin(), large.begin() + static_cast<std::ptrdiff_t>(i) + 1, other))
        search.test(large[i], other);
}

}  // namespace tweenfall::pairs
