#include "pairs/bounds_tree.h"

#include <algorithm>

namespace tweenfall::pairs {

namespace {

Bounds united(const Bounds& a, const Bounds& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

double extent(const Bounds& bounds) {
  return (bounds.high - bounds.low).sum();
}

}  // namespace

std::uint32_t BoundsTree::take_node() {
  if (unused_.empty()) {
    nodes_.emplace_back();
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  const std::uint32_t node = unused_.back();
  unused_.pop_back();
  nodes_[node] = {};
  return node;
}

void BoundsTree::set(std::uint32_t item, const Bounds& bounds) {
  if (item >= leaves_.size()) leaves_.resize(item + 1, none);
  if (leaves_[item] == none) {
    const std::uint32_t leaf = take_node();
    nodes_[leaf].bounds = bounds;
    nodes_[leaf].item = item;
    leaves_[item] = leaf;
    fresh_.push_back(item);
    ++size_;
    return;
  }
  const std::uint32_t leaf = leaves_[item];
  nodes_[leaf].bounds = bounds;
  if (!linked(leaf)) return;
  ++changes_;
  const std::uint32_t parent = nodes_[leaf].parent;
  if (parent == none) return;
  // A box that has left its neighbors would make their boxes grow without end.
  if (overlap(nodes_[parent].bounds, bounds)) {
    fit(parent);
    return;
  }
  unlink(leaf);
  if (link(leaf) > most_depth) rebuild();
}

void BoundsTree::remove(std::uint32_t item) {
  if (!has(item)) return;
  const std::uint32_t leaf = leaves_[item];
  if (linked(leaf)) unlink(leaf);
  nodes_[leaf].item = none;
  unused_.push_back(leaf);
  leaves_[item] = none;
  --size_;
}

void BoundsTree::fit(std::uint32_t node) {
  for (; node != none; node = nodes_[node].parent) {
    const Bounds bounds = united(nodes_[nodes_[node].left].bounds, nodes_[nodes_[node].right].bounds);
    if (bounds.low == nodes_[node].bounds.low && bounds.high == nodes_[node].bounds.high) return;
    nodes_[node].bounds = bounds;
  }
}

std::size_t BoundsTree::link(std::uint32_t leaf) {
  if (root_ == none) {
    root_ = leaf;
    return 0;
  }
  const Bounds bounds = nodes_[leaf].bounds;
  std::uint32_t beside = root_;
  std::size_t depth = 1;
  for (; nodes_[beside].left != none; ++depth) {
    const Node& node = nodes_[beside];
    const Bounds &left = nodes_[node.left].bounds, &right = nodes_[node.right].bounds;
    const double left_growth = extent(united(left, bounds)) - extent(left);
    const double right_growth = extent(united(right, bounds)) - extent(right);
    // If both are equally good, the number decides, so that thousands at one place do not all go one way.
    const bool go_left =
        left_growth != right_growth ? left_growth < right_growth : (nodes_[leaf].item >> (depth % 32) & 1u) == 0;
    beside = go_left ? node.left : node.right;
  }
  const std::uint32_t above = nodes_[beside].parent;
  const std::uint32_t joint = take_node();
  nodes_[joint] = {united(nodes_[beside].bounds, bounds), beside, leaf, above, none};
  nodes_[beside].parent = nodes_[leaf].parent = joint;
  if (above == none) {
    root_ = joint;
  } else {
    (nodes_[above].left == beside ? nodes_[above].left : nodes_[above].right) = joint;
    fit(above);
  }
  ++changes_;
  return depth;
}

void BoundsTree::unlink(std::uint32_t leaf) {
  const std::uint32_t parent = nodes_[leaf].parent;
  nodes_[leaf].parent = none;
  if (parent == none) {
    root_ = none;
    return;
  }
  const std::uint32_t sibling = nodes_[parent].left == leaf ? nodes_[parent].right : nodes_[parent].left;
  const std::uint32_t above = nodes_[parent].parent;
  nodes_[sibling].parent = above;
  nodes_[parent] = {};
  unused_.push_back(parent);
  if (above == none) {
    root_ = sibling;
    return;
  }
  (nodes_[above].left == parent ? nodes_[above].left : nodes_[above].right) = sibling;
  fit(above);
}

void BoundsTree::settle() {
  // Inserting very many one by one would take longer and end in a worse tree.
  bool again = fresh_.size() > 16 + size_ / 8 || changes_ > 64 + 16 * size_;
  for (std::size_t i = 0; i < fresh_.size() && !again; ++i) {
    const std::uint32_t item = fresh_[i];
    if (has(item) && !linked(leaves_[item])) again = link(leaves_[item]) > most_depth;
  }
  fresh_.clear();
  if (again) rebuild();
}

void BoundsTree::rebuild() {
  planted_.clear();
  for (const std::uint32_t leaf : leaves_) {
    if (leaf == none) continue;
    const Node& node = nodes_[leaf];
    planted_.push_back({0.5 * node.bounds.low + 0.5 * node.bounds.high, node.item});
  }
  std::swap(nodes_, before_);
  nodes_.clear();
  nodes_.reserve(2 * planted_.size());
  unused_.clear();
  changes_ = 0;
  root_ = planted_.empty() ? none : build(0, planted_.size(), none);
}

std::uint32_t BoundsTree::build(std::size_t begin, std::size_t end, std::uint32_t parent) {
  const std::uint32_t index = take_node();
  nodes_[index].parent = parent;
  if (end - begin == 1) {
    std::uint32_t& leaf = leaves_[planted_[begin].item];
    nodes_[index].bounds = before_[leaf].bounds;
    nodes_[index].item = planted_[begin].item;
    leaf = index;
    return index;
  }
  Bounds middles{planted_[begin].middle, planted_[begin].middle};
  for (std::size_t i = begin + 1; i < end; ++i) middles = united(middles, {planted_[i].middle, planted_[i].middle});
  int axis = 0;
  const Vec3 spread = middles.high - middles.low;
  if (spread[1] > spread[axis]) axis = 1;
  if (spread[2] > spread[axis]) axis = 2;
  const std::size_t half = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return planted_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [axis](const Planted& a, const Planted& b) {
    return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.item < b.item;
  });
  const std::uint32_t left = build(begin, half, index);
  const std::uint32_t right = build(half, end, index);
  nodes_[index].left = left;
  nodes_[index].right = right;
  nodes_[index].bounds = united(nodes_[left].bounds, nodes_[right].bounds);
  return index;
}

void BoundsTree::close(std::uint32_t item) {
  std::uint32_t node = leaves_[item];
  closed_[node] = 1;
  for (node = nodes_[node].parent; node != none; node = nodes_[node].parent) {
    if (closed_[nodes_[node].left] == 0 || closed_[nodes_[node].right] == 0) return;
    closed_[node] = 1;
  }
}

}  // namespace tweenfall::pairs
