// Source of the grid: Teschner, Heidelberger, Mueller, Pomeranets, Gross, Optimized Spatial Hashing for Collision
// Detection of Deformable Objects, 2003; here cells are sorted, so that pairs come in one order everywhere.

#include "actors/soft/meetings/apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tweenfall::soft {

namespace {

constexpr int passes = 4, most_heeded = 64;

/// Two nodes that came too near.
struct NodePair {
  std::uint32_t a = 0, b = 0;
  double apart = 0;  ///< distance at which they must end, m
  double friction = 0;
  double rubbed = 0;  ///< push across so far, kg m
  double pressed = 0;
};

/// A cell's index along an axis, which wraps around.
std::uint64_t wrapped(double cells) {
  constexpr double around = 0x1p21;
  const double whole = std::floor(cells);
  return static_cast<std::uint64_t>(whole - around * std::floor(whole / around));
}

using Cell = std::array<double, 3>;

std::uint64_t key_of(const Cell& cell) {
  return wrapped(cell[0]) << 42 | wrapped(cell[1]) << 21 | wrapped(cell[2]);
}

/// A cell, and a node in it.
using Entry = std::pair<std::uint64_t, std::uint32_t>;

class NodeGrid {
 public:
  /// @param entries  memory to work in
  NodeGrid(const std::vector<Vec3>& places, double size, std::vector<Entry>& entries)
      : places_(places), size_(size), entries_(entries) {
    entries_.clear();
    for (std::uint32_t i = 0; i < places.size(); ++i) entries_.push_back({key_of(cell_of(i)), i});
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls `meet(a, b)` for nodes of the same cell or of two adjacent ones, once per pair. It returns whether a heeds
  /// more.
  template <class Meet>
  void each_pair(const Meet& meet) const {
    for (std::uint32_t node = 0; node < places_.size(); ++node) meet_around(node, meet);
  }

 private:
  [[nodiscard]] Cell cell_of(std::uint32_t node) const {
    return {std::floor(places_[node].x() / size_), std::floor(places_[node].y() / size_),
            std::floor(places_[node].z() / size_)};
  }

  template <class Meet>
  void meet_around(std::uint32_t node, const Meet& meet) const {
    const Cell own = cell_of(node);
    // Of two adjacent cells, the nodes of one visit the other.
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
  std::vector<Entry>& entries_;
};

/// Kept from one sub-step to the next, so that none takes memory.
struct ApartMemory {
  std::vector<std::uint32_t> first;   ///< node of each soft body
  std::vector<std::uint32_t> member;  ///< the soft body of each node
  std::vector<Vec3> places, before;
  std::vector<double> weight;  ///< inverse masses; 0 of held nodes
  std::vector<NodePair> pairs;
  std::vector<Entry> entries;
  std::vector<int> heeded;   ///< by node: how many it has met
  std::vector<char> pushed;  ///< by soft body

  void clear() {
    first.clear();
    member.clear();
    places.clear();
    before.clear();
    weight.clear();
    pairs.clear();
  }
  [[nodiscard]] static ApartMemory& own() {
    thread_local ApartMemory memory;
    memory.clear();
    return memory;
  }
};

/// Nodes of one soft body, or of several, that keep apart.
class KeptApart {
 public:
  KeptApart(std::span<const Thick> thick, Partners& partners, double h, bool backward)
      : memory_(ApartMemory::own()),
        thick_(thick),
        partners_(partners),
        h_(h),
        backward_(backward),
        first_(memory_.first),
        member_(memory_.member),
        places_(memory_.places),
        before_(memory_.before),
        weight_(memory_.weight),
        pairs_(memory_.pairs) {
    for (std::uint32_t member = 0; member < thick.size(); ++member) {
      const SoftSettings& made = *thick[member].body->made;
      widest_ = std::max(widest_, made.thickness);
      first_.push_back(static_cast<std::uint32_t>(weight_.size()));
      for (std::uint32_t node = 0; node < made.masses.size(); ++node) {
        weight_.push_back(1 / made.masses[node]);
        member_.push_back(member);
        places_.push_back(thick[member].body->positions[node]);
        before_.push_back((*thick[member].before)[node]);
      }
      for (const Held& held : thick[member].held) weight_[first_.back() + held.node] = 0;
    }
  }

  /// Pairs within one soft body, or between different ones.
  void find(double push_out_speed, bool within) {
    std::vector<int>& heeded = memory_.heeded;
    heeded.assign(weight_.size(), 0);
    NodeGrid(places_, widest_, memory_.entries).each_pair([&](std::uint32_t a, std::uint32_t b) {
      if (!(weight_[a] + weight_[b] > 0) || (member_[a] == member_[b]) != within) return true;
      const SoftSettings &one = made_of(a), &other = made_of(b);
      if (!within && !meet_each_other(one, other)) return true;
      const double thickness = within ? one.thickness : 0.5 * (one.thickness + other.thickness);
      const double distance = (places_[a] - places_[b]).norm();
      if (!(distance < thickness)) return true;
      const double rest = within ? (at_rest(a) - at_rest(b)).norm() : thickness;
      // Overlapping nodes are pushed out at a speed that throws nothing.
      const double was = (before_[a] - before_[b]).norm();
      const double apart = std::min({thickness, rest, was + h_ * push_out_speed});
      if (distance < apart)
        pairs_.push_back({a, b, apart, within ? one.friction : std::sqrt(one.friction * other.friction)});
      return ++heeded[a] < most_heeded;
    });
    if (within) return;
    // The cells are as wide as the thickest of all: the order must not come from them.
    for (NodePair& pair : pairs_)
      if (pair.b < pair.a) std::swap(pair.a, pair.b);
    std::ranges::sort(pairs_, {}, [](const NodePair& pair) { return std::pair(pair.a, pair.b); });
  }

  /// @return by soft body, whether it was pushed
  const std::vector<char>& push() {
    for (int pass = 0; pass < passes; ++pass)
      for (std::size_t i = 0; i < pairs_.size(); ++i)
        meet(pairs_[backward_ == (pass % 2 == 0) ? pairs_.size() - 1 - i : i]);
    for (std::uint32_t node = 0; node < places_.size(); ++node)
      thick_[member_[node]].body->positions[node - first_[member_[node]]] = places_[node];
    std::vector<char>& pushed = memory_.pushed;
    pushed.assign(thick_.size(), 0);
    for (const NodePair& pair : pairs_)
      if (pair.pressed > 0) pushed[member_[pair.a]] = pushed[member_[pair.b]] = 1;
    return pushed;
  }

 private:
  [[nodiscard]] const SoftSettings& made_of(std::uint32_t node) const { return *thick_[member_[node]].body->made; }
  [[nodiscard]] const Vec3& at_rest(std::uint32_t node) const {
    return made_of(node).positions[node - first_[member_[node]]];
  }

  void meet(NodePair& pair) {
    const std::vector<Vec3>& x = places_;
    const Vec3 between = x[pair.a] - x[pair.b];
    const double distance = between.norm(), weights = weight_[pair.a] + weight_[pair.b];
    const Vec3 normal = distance > 0 ? Vec3(between / distance) : Vec3(0, 1, 0);
    const double change = std::max((pair.apart - distance) / weights, -pair.pressed);
    if (change == 0) return;
    pair.pressed += change;
    give(pair, change * normal);
    Vec3 slid = (x[pair.a] - before_[pair.a]) - (x[pair.b] - before_[pair.b]);
    slid -= normal.dot(slid) * normal;
    const double way = slid.norm(), room = pair.friction * pair.pressed - pair.rubbed;
    if (!(way > 0) || !(room > 0)) return;
    const double rub = std::min(way / weights, room);
    pair.rubbed += rub;
    give(pair, -rub / way * slid);
  }

  /// A push on the first node, kg m, and the opposite one on the second.
  void give(const NodePair& pair, const Vec3& push) {
    give_one(pair.a, push);
    give_one(pair.b, -push);
  }
  void give_one(std::uint32_t node, const Vec3& push) {
    const Thick& its = thick_[member_[node]];
    const std::uint32_t own = node - first_[member_[node]];
    if (weight_[node] > 0) {
      places_[node] += weight_[node] * push;
      its.body->velocities[own] += weight_[node] / h_ * push;
      return;
    }
    for (Held& held : its.held) {
      if (held.node != own) continue;
      held.pushed += push;
      if (held.partner != Held::nobody) partners_[held.partner].give(push, held.arm, h_);
    }
  }

  ApartMemory& memory_;
  std::span<const Thick> thick_;
  Partners& partners_;
  double h_;
  bool backward_;
  double widest_ = 0;
  std::vector<std::uint32_t>&first_, &member_;
  std::vector<Vec3>&places_, &before_;
  std::vector<double>& weight_;
  std::vector<NodePair>& pairs_;
};

}  // namespace

bool meet_each_other(const SoftSettings& one, const SoftSettings& other) {
  return one.thickness > 0 && other.thickness > 0 && one.collide && other.collide &&
         (one.groups & other.collides_with) != 0 && (other.groups & one.collides_with) != 0;
}

void keep_apart(const Thick& thick, Partners& partners, double h, bool backward, double push_out_speed) {
  KeptApart kept({&thick, 1}, partners, h, backward);
  kept.find(push_out_speed, true);
  static_cast<void>(kept.push());
}

const std::vector<char>& keep_apart_from_each_other(std::span<const Thick> thick, Partners& partners, double h,
                                                    bool backward, double push_out_speed) {
  KeptApart kept(thick, partners, h, backward);
  kept.find(push_out_speed, false);
  return kept.push();
}

}  // namespace tweenfall::soft
