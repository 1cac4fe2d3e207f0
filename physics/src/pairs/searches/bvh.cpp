#include <algorithm>

#include "pairs/searches/searches.h"

namespace tweenfall::pairs {

namespace {

struct Branch {
  Bounds box{Vec3::Zero(), Vec3::Zero()};
  std::uint32_t begin = 0, end = 0;   ///< of the places in it
  std::uint32_t left = 0, right = 0;  ///< of a leaf: 0, which is the root
};

class Hierarchy {
 public:
  explicit Hierarchy(Search& search) : search_(search), places_(search.items.size()) {
    for (std::uint32_t i = 0; i < places_.size(); ++i) places_[i] = i;
    branches_.reserve(2 * places_.size());
    if (!places_.empty()) build(0, static_cast<std::uint32_t>(places_.size()));
    for (const Branch& branch : branches_) search_.cells.push_back(branch.box);
  }
  /// Finds the pairs below one branch.
  void within(std::uint32_t number) {
    const Branch& branch = branches_[number];
    if (branch.left == 0) return;
    within(branch.left);
    within(branch.right);
    between(branch.left, branch.right);
  }
  [[nodiscard]] bool empty() const { return branches_.empty(); }

 private:
  std::uint32_t build(std::uint32_t begin, std::uint32_t end) {
    const auto number = static_cast<std::uint32_t>(branches_.size());
    branches_.emplace_back();
    Bounds box = search_.items[places_[begin]].box;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.low = box.low.cwiseMin(search_.items[places_[i]].box.low);
      box.high = box.high.cwiseMax(search_.items[places_[i]].box.high);
    }
    std::uint32_t left = 0, right = 0;
    if (end - begin > 1) {
      const Vec3 sides = box.high - box.low;
      int axis = 0;
      for (int i = 1; i < 3; ++i)
        if (sides[i] > sides[axis]) axis = i;
      const std::uint32_t half = begin + (end - begin) / 2;
      std::nth_element(places_.begin() + begin, places_.begin() + half, places_.begin() + end,
                       [&](std::uint32_t a, std::uint32_t b) {
                         const Bounds &one = search_.items[a].box, &other = search_.items[b].box;
                         return one.low[axis] + one.high[axis] < other.low[axis] + other.high[axis];
                       });
      left = build(begin, half);
      right = build(half, end);
    }
    branches_[number] = {box, begin, end, left, right};
    return number;
  }

  void between(std::uint32_t a, std::uint32_t b) {
    const Branch &one = branches_[a], &other = branches_[b];
    if (one.left == 0 && other.left == 0) {
      search_.test(places_[one.begin], places_[other.begin]);
      return;
    }
    ++search_.tests;
    if (!overlap(one.box, other.box)) return;
    // The branch with more items is opened.
    if (other.left == 0 || (one.left != 0 && one.end - one.begin >= other.end - other.begin)) {
      between(one.left, b);
      between(one.right, b);
    } else {
      between(a, other.left);
      between(a, other.right);
    }
  }

  Search& search_;
  std::vector<std::uint32_t> places_;
  std::vector<Branch> branches_;
};

}  // namespace

/// A tree of boxes around boxes: two branches that do not meet are skipped with everything in them.
/// Source: Ericson, Real-Time Collision Detection, 2005, chapter 6.
void bvh(Search& search) {
  Hierarchy hierarchy(search);
  if (!hierarchy.empty()) hierarchy.within(0);
}

}  // namespace tweenfall::pairs
