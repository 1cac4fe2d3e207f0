#pragma once

#include <tweenfall/physics/strategies.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pairs/bounds_tree.h"

namespace tweenfall::pairs {

/// A box whose pairs are searched for.
struct Item {
  Bounds box{Vec3::Zero(), Vec3::Zero()};
  std::uint32_t index = 0;
  bool movable = true;  ///< two that are not movable are no pair
};

/// What a search has found so far.
struct Search {
  std::span<const Item> items;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  ///< by index, smaller first; perhaps more than once
  std::size_t tests = 0;                                       ///< of two boxes against each other
  std::vector<Bounds> cells;                                   ///< into which space was cut; empty if it was not
  std::size_t most = 0;                                        ///< more pairs than this are a crowd

  /// Tests whether the boxes of two items meet.
  void test(std::size_t a, std::size_t b);
  /// Tests all of these against each other.
  void test_all(std::span<const std::uint32_t> places);
  [[nodiscard]] Bounds all() const;  ///< around all boxes
  /// So many have been found that the search ends.
  [[nodiscard]] bool crowded() const { return found.size() > most; }
  /// By index, each once.
  void sort();
};

/// Finds all pairs of boxes that meet.
using FindsPairs = void(Search& search);

// One file each
FindsPairs all_pairs, sweep, grid, quadtree, octree, kd_tree, bvh;

/// Null for `tree`, which is kept from step to step, and for a search that does not exist.
[[nodiscard]] FindsPairs* search_by(PairSearch search);
[[nodiscard]] bool exists(PairSearch search);

}  // namespace tweenfall::pairs
