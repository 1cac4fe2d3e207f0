#include <algorithm>

#include "pairs/searches/searches.h"

namespace tweenfall::pairs {

namespace {

/// The axis along which the middles of the boxes spread the most.
int widest_axis(std::span<const Item> items) {
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  for (const Item& item : items) {
    // For boxes that reach everywhere the middle says little, and its square would not be a number.
    const Vec3 middle = (0.5 * (item.box.low + item.box.high)).cwiseMax(-1e60).cwiseMin(1e60);
    sum += middle;
    squares += middle.cwiseProduct(middle);
  }
  const Vec3 spread = squares - sum.cwiseProduct(sum) / static_cast<double>(std::max<std::size_t>(1, items.size()));
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (spread[i] > spread[axis]) axis = i;
  return axis;
}

}  // namespace

/// Boxes in the order in which they begin along one axis; each is tested against those that begin before it ends.
/// Source: Baraff, Dynamic Simulation of Non-Penetrating Rigid Bodies, 1992 (sort and sweep).
void sweep(Search& search) {
  const int axis = widest_axis(search.items);
  std::vector<std::uint32_t> order(search.items.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return search.items[a].box.low[axis] < search.items[b].box.low[axis];
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double end = search.items[order[i]].box.high[axis];
    for (std::size_t k = i + 1; k < order.size() && search.items[order[k]].box.low[axis] <= end; ++k)
      search.test(order[i], order[k]);
  }
}

}  // namespace tweenfall::pairs
