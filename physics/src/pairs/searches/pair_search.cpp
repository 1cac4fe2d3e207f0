#include <tweenfall/physics/pair_search.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pairs/searches/searches.h"

namespace tweenfall {

namespace pairs {
namespace {

/// More would not fit into memory everywhere.
constexpr std::size_t most_found = 20'000'000;

/// As the world does it: each box is tested against a tree of those before it.
void by_tree(Search& search) {
  BoundsTree tree;
  for (std::uint32_t i = 0; i < search.items.size(); ++i) tree.set(i, search.items[i].box);
  tree.settle();
  for (std::uint32_t i = 0; i < search.items.size(); ++i)
    tree.visit(search.items[i].box, [&](std::uint32_t other) {
      if (other < i) search.test(i, other);
    });
}

}  // namespace
}  // namespace pairs

PairsFound find_pairs(PairSearch by, std::span<const Bounds> boxes) {
  if (!pairs::exists(by)) throw std::invalid_argument("there is no such broad phase");
  std::vector<pairs::Item> items;
  items.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Bounds& box = boxes[i];
    if (!(box.low.array() <= box.high.array()).all() || !(box.low.array().abs() <= 1e100).all() ||
        !(box.high.array().abs() <= 1e100).all())
      throw std::invalid_argument("box " + std::to_string(i) + " is not finite, or its low end is above its high one");
    items.push_back({box, static_cast<std::uint32_t>(i), true});
  }
  pairs::Search search;
  search.items = items;
  search.most = pairs::most_found;
  if (pairs::FindsPairs* const find = pairs::search_by(by))
    find(search);
  else
    pairs::by_tree(search);
  if (search.crowded()) throw std::invalid_argument("more than twenty million pairs of boxes meet");
  search.sort();
  return {std::move(search.found), search.tests, std::move(search.cells)};
}

}  // namespace tweenfall
