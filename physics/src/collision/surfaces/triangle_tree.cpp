#include "collision/surfaces/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace tweenfall::surfaces {

TriangleTree::TriangleTree(std::span<const Bounds> items) : order_(items.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  const auto middle = [&](std::uint32_t item, int axis) { return items[item].low[axis] + items[item].high[axis]; };
  struct Ahead {
    std::size_t node, begin, end;
  };
  std::vector<Ahead> ahead = {{0, 0, items.size()}};
  nodes_.reserve(items.size() / 2 + 1);
  nodes_.emplace_back();
  while (!ahead.empty()) {
    const auto [index, begin, end] = ahead.back();
    ahead.pop_back();
    Bounds all = items[order_[begin]];
    Bounds middles{all.low + all.high, all.low + all.high};
    for (std::size_t i = begin + 1; i < end; ++i) {
      const Bounds& its = items[order_[i]];
      all = united(all, its);
      middles = united(middles, {its.low + its.high, its.low + its.high});
    }
    nodes_[index].bounds = all;
    if (end - begin <= leaf_size) {
      nodes_[index].first = static_cast<std::uint32_t>(begin);
      nodes_[index].items = static_cast<std::uint32_t>(end - begin);
      continue;
    }
    int axis = 0;
    const Vec3 spread = middles.high - middles.low;
    if (spread[1] > spread[axis]) axis = 1;
    if (spread[2] > spread[axis]) axis = 2;
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return middle(a, axis) != middle(b, axis) ? middle(a, axis) < middle(b, axis) : a < b;
    });
    const std::size_t left = nodes_.size();
    nodes_[index].first = static_cast<std::uint32_t>(left);
    nodes_.emplace_back();
    nodes_.emplace_back();
    ahead.push_back({left + 1, half, end});
    ahead.push_back({left, begin, half});
  }
  nodes_.shrink_to_fit();
}

bool meets_on_way(const Bounds& moving, const Vec3& way, const Bounds& box) {
  double enter = 0, leave = 1;
  for (int i = 0; i < 3; ++i) {
    const double to_enter = box.low[i] - moving.high[i], to_leave = box.high[i] - moving.low[i];
    if (way[i] == 0) {
      if (to_enter > 0 || to_leave < 0) return false;
      continue;
    }
    const double first = to_enter / way[i], second = to_leave / way[i];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave;
}

}  // namespace tweenfall::surfaces
