// Source of the grid: Teschner, Heidelberger, Mueller, Pomeranets, Gross, Optimized Spatial Hashing for Collision
// Detection of Deformable Objects, 2003; here cells are sorted, so that pairs come in one order everywhere.

#include "soft/apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tweenfall::soft {

namespace {

constexpr int passes = 4, most_heeded = 64;

/// Two nodes that came too near.
struct NodePair {
  std::uint32_t a = 0, b = 0;
  double apart = 0;   ///< as far as they must end, m
  double rubbed = 0;  ///< push across so far, kg m
  double pressed = 0;
};

/// A cell's place along an axis, counted around and around.
std::uint64_t wrapped(double cells) {
  constexpr double around = 0x1p21;
  const double whole = std::floor(cells);
  return static_cast<std::uint64_t>(whole - around * std::floor(whole / around));
}

using Cell = std::array<double, 3>;

std::uint64_t key_of(const Cell& cell) {
  return wrapped(cell[0]) << 42 | wrapped(cell[1]) << 21 | wrapped(cell[2]);
}

class NodeGrid {
 public:
  NodeGrid(const std::vector<Vec3>& places, double size) : places_(places), size_(size) {
    for (std::uint32_t i = 0; i < places.size(); ++i) entries_.push_back({key_of(cell_of(i)), i});
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls `meet(a, b)` for nodes of one cell or of two that touch, for each pair once. It says whether a heeds more.
  template <class Meet>
  void each_pair(const Meet& meet) const {
    for (std::uint32_t node = 0; node < places_.size(); ++node) meet_around(node, meet);
  }

 private:
  using Entry = std::pair<std::uint64_t, std::uint32_t>;

  [[nodiscard]] Cell cell_of(std::uint32_t node) const {
    return {std::floor(places_[node].x() / size_), std::floor(places_[node].y() / size_),
            std::floor(places_[node].z() / size_)};
  }

  template <class Meet>
  void meet_around(std::uint32_t node, const Meet& meet) const {
    const Cell own = cell_of(node);
    // Of two cells that touch, the nodes of one look into the other.
    for (int place = 13; place < 27; ++place) {
      const int x = place / 9 - 1, y = place / 3 % 3 - 1, z = place % 3 - 1;
      const std::uint64_t key = key_of({own[0] + x, own[1] + y, own[2] + z});
      const Entry first{key, place == 13 ? node + 1 : 0};
      for (auto it = std::lower_bound(entries_.begin(), entries_.end(), first);
           it != entries_.end() && it->first == key; ++it)
        if (!meet(node, it->second)) return;
    }
  }

  const std::vector<Vec3>& places_;
  double size_;
  std::vector<Entry> entries_;
};

class KeptApart {
 public:
  KeptApart(SubStep& step, const std::vector<Vec3>& before)
      : step_(step), made_(*step.body.made), before_(before), weight_(made_.masses.size()) {
    for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] = 1 / made_.masses[i];
    for (const Held& held : step.held) weight_[held.node] = 0;
  }

  void find(double push_out_speed) {
    std::vector<int> heeded(weight_.size(), 0);
    const std::vector<Vec3>& x = step_.body.positions;
    NodeGrid(x, made_.thickness).each_pair([&](std::uint32_t a, std::uint32_t b) {
      if (!(weight_[a] + weight_[b] > 0)) return true;
      const double distance = (x[a] - x[b]).norm();
      if (!(distance < made_.thickness)) return true;
      const double rest = (made_.positions[a] - made_.positions[b]).norm();
      // What lies in each other is let out at a speed that throws nothing.
      const double was = (before_[a] - before_[b]).norm();
      const double apart = std::min({made_.thickness, rest, was + step_.h * push_out_speed});
      if (distance < apart) pairs_.push_back({a, b, apart});
      return ++heeded[a] < most_heeded;
    });
  }

  void push() {
    for (int pass = 0; pass < passes; ++pass)
      for (std::size_t i = 0; i < pairs_.size(); ++i)
        meet(pairs_[step_.backward == (pass % 2 == 0) ? pairs_.size() - 1 - i : i]);
  }

 private:
  void meet(NodePair& pair) {
    const std::vector<Vec3>& x = step_.body.positions;
    const Vec3 between = x[pair.a] - x[pair.b];
    const double distance = between.norm(), weights = weight_[pair.a] + weight_[pair.b];
    const Vec3 normal = distance > 0 ? Vec3(between / distance) : Vec3(0, 1, 0);
    const double change = std::max((pair.apart - distance) / weights, -pair.pressed);
    if (change == 0) return;
    pair.pressed += change;
    give(pair, change * normal);
    Vec3 slid = (x[pair.a] - before_[pair.a]) - (x[pair.b] - before_[pair.b]);
    slid -= normal.dot(slid) * normal;
    const double way = slid.norm(), room = made_.friction * pair.pressed - pair.rubbed;
    if (!(way > 0) || !(room > 0)) return;
    const double rub = std::min(way / weights, room);
    pair.rubbed += rub;
    give(pair, -rub / way * slid);
  }

  /// A push on the first, kg m, and against the second.
  void give(const NodePair& pair, const Vec3& push) {
    give_one(pair.a, push);
    give_one(pair.b, -push);
  }
  void give_one(std::uint32_t node, const Vec3& push) {
    if (weight_[node] > 0) {
      step_.body.positions[node] += weight_[node] * push;
      step_.body.velocities[node] += weight_[node] / step_.h * push;
      return;
    }
    for (Held& held : step_.held) {
      if (held.node != node) continue;
      held.pushed += push;
      if (held.partner != Held::nobody) step_.partners[held.partner].give(push, held.arm, step_.h);
    }
  }

  SubStep& step_;
  const SoftSettings& made_;
  const std::vector<Vec3>& before_;
  std::vector<double> weight_;  ///< inverse masses; 0 of what is held
  std::vector<NodePair> pairs_;
};

}  // namespace

void keep_apart(SubStep& step, const std::vector<Vec3>& before, double push_out_speed) {
  KeptApart kept(step, before);
  kept.find(push_out_speed);
  kept.push();
}

}  // namespace tweenfall::soft
