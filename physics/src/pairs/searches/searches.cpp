#include "pairs/searches/searches.h"

#include <algorithm>
#include <limits>

namespace tweenfall::pairs {

void Search::test(std::size_t a, std::size_t b) {
  const Item &first = items[a], &second = items[b];
  if (!first.movable && !second.movable) return;
  ++tests;
  if (crowded()) return;
  if (overlap(first.box, second.box))
    found.emplace_back(std::min(first.index, second.index), std::max(first.index, second.index));
}

void Search::test_all(std::span<const std::uint32_t> places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + 1; k < places.size(); ++k) test(places[i], places[k]);
}

Bounds Search::all() const {
  constexpr double end = std::numeric_limits<double>::infinity();
  Bounds around{Vec3::Constant(end), Vec3::Constant(-end)};
  for (const Item& item : items) {
    around.low = around.low.cwiseMin(item.box.low);
    around.high = around.high.cwiseMax(item.box.high);
  }
  return around;
}

void Search::sort() {
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

FindsPairs* search_by(PairSearch search) {
  switch (search) {
    case PairSearch::tree:
      return nullptr;
    case PairSearch::all_pairs:
      return all_pairs;
    case PairSearch::sweep:
      return sweep;
    case PairSearch::grid:
      return grid;
    case PairSearch::quadtree:
      return quadtree;
    case PairSearch::octree:
      return octree;
    case PairSearch::kd_tree:
      return kd_tree;
    case PairSearch::bvh:
      return bvh;
  }
  return nullptr;
}

bool exists(PairSearch search) {
  return search == PairSearch::tree || search_by(search) != nullptr;
}

}  // namespace tweenfall::pairs
