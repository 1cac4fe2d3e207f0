#pragma once

#include <tweenfall/physics/strategies.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pairs/bounds_tree.h"

namespace tweenfall::pairs {

/// A box among which pairs are looked for.
struct Item {
  Bounds box{Vec3::Zero(), Vec3::Zero()};
  std::uint32_t index = 0;
  bool movable = true;  ///< two that are not are no pair
};

/// What a search has found so far.
struct Search {
  std::span<const Item> items;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  ///< by index, smaller first; perhaps more than once
  std::size_t tests = 0;                                       ///< of two boxes against each other
  std::vector<Bounds> cells;                                   ///< into which space was cut; none where it was not
  std::size_t most = 0;                                        ///< found, of which more are a crowd

  /// Looks whether the boxes of two items meet.
  void test(std::size_t a, std::size_t b);
  /// The same for all of these with each other.
  void test_all(std::span<const std::uint32_t> places);
  [[nodiscard]] Bounds all() const;  ///< around all boxes
  /// So many have been found that no more are.
  [[nodiscard]] bool crowded() const { return found.size() > most; }
  /// By index, each once.
  void sort();
};

/// Finds all pairs of boxes that meet.
using FindsPairs = void(Search& search);

// One file each
FindsPairs all_pairs, sweep, grid, quadtree, octree, kd_tree, bvh;

/// Null for that which is kept from step to step, and for one that is none.
[[nodiscard]] FindsPairs* search_by(PairSearch search);
[[nodiscard]] bool exists(PairSearch search);

}  // namespace tweenfall::pairs
