#include "pairs/broad_phase.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "pairs/searches/searches.h"
#include "shapes/placed.h"

namespace tweenfall::pairs {

using state::Body;

namespace {

/// How much boxes are enlarged, in parts of their smallest side.
constexpr double spare = 0.05;
/// A box that exceeds what is needed by more than this factor is left from an earlier motion.
constexpr double outgrown = 2;
/// Greatest number of steps for which a box has room.
constexpr std::uint8_t longest_foresight = 16;
/// With so few neighbors a box reaches farther ahead; with so many it draws back.
constexpr std::size_t few_neighbors = 6, many_neighbors = 16;
/// More pairs of boxes per body than this are a crowd.
constexpr std::size_t kept_in_crowd = 64, found_in_crowd = 16;
/// Searches may find a pair in several cells.
constexpr std::size_t found_once_more = 16;
/// Number of bodies that are worth a task of their own.
constexpr std::size_t worth_a_part = 128, worth_a_look = 32;
/// The same for pairs.
constexpr std::size_t worth_merging = 1024;
/// Boxes end here: the difference of any two is still a finite number.
constexpr double end_of_space = 1e100;

/// Enlarged, and reaching where the body goes next.
Bounds with_room(const Bounds& swept, const Vec3& travel, int foresight) {
  const Vec3 around = Vec3::Constant(spare * (swept.high - swept.low).minCoeff());
  const Vec3 ahead = travel * foresight;
  return {swept.low + ahead.cwiseMin(0.0) - around, swept.high + ahead.cwiseMax(0.0) + around};
}

/// Bounds that are not numbers reach everywhere.
Bounds in_space(const Bounds& bounds) {
  Bounds result;
  for (int i = 0; i < 3; ++i) {
    result.low[i] = std::min(end_of_space, std::max(-end_of_space, bounds.low[i]));
    result.high[i] = std::max(-end_of_space, std::min(end_of_space, bounds.high[i]));
  }
  return result;
}

double sides(const Bounds& bounds) {
  return (bounds.high - bounds.low).sum();
}

}  // namespace

void BroadPhase::remove(std::uint32_t index) {
  if (index >= entries_.size()) return;
  Entry& entry = entries_[index];
  if (entry.kind == Kind::plane) std::erase(planes_, index);
  if (entry.kind == Kind::movable || entry.kind == Kind::immovable) {
    tree_of(entry.kind).remove(index);
    renew(index);
  }
  entry.kind = Kind::none;
}

void BroadPhase::look_again(std::uint32_t index) {
  // Nothing is kept of planes, and of bodies that no step has seen.
  if (index < entries_.size() && (entries_[index].kind == Kind::movable || entries_[index].kind == Kind::immovable))
    renew(index);
}

void BroadPhase::renew(std::uint32_t index) {
  if (entries_[index].renewed) return;
  entries_[index].renewed = true;
  renewed_.push_back(index);
}

BroadPhase::Look BroadPhase::look_at(const Body& body, std::uint32_t index, const forces::Load& load, double margin,
                                     double dt) {
  Entry& entry = entries_[index];
  Look look;
  // A body that may meet nothing needs no box.
  if (body.sensor() || body.groups() == 0 || body.collides_with() == 0) return look;
  look.kind = std::isinf(body.radius()) ? Kind::plane : body.immovable() ? Kind::immovable : Kind::movable;
  entry.stirs = body.stirs();
  entry.displaces = body.displaces();
  pair_counts_[index] = neighbor_counts_[index] = 0;
  if (look.kind == Kind::plane) return look;
  entry.swept = in_space(swept_bounds(body, load, 0.5 * margin, dt));
  look.still = look.kind == Kind::immovable && !body.has_target;
  look.travel = pairs::travel(body, load, dt);
  const BoundsTree& tree = tree_of(look.kind);
  if (entry.kind != look.kind || !tree.has(index) || !contains(tree.of(index), entry.swept)) return look;
  const Bounds wanted = with_room(entry.swept, look.travel, longest_foresight);
  look.leaves = !(sides(tree.of(index)) <= outgrown * sides(wanted));
  return look;
}

void BroadPhase::follow(const Look& look, std::uint32_t index) {
  if (entries_[index].kind != look.kind) {
    remove(index);
    if (look.kind == Kind::plane) planes_.insert(std::lower_bound(planes_.begin(), planes_.end(), index), index);
  }
  Entry& entry = entries_[index];
  entry.kind = look.kind;
  if (look.kind == Kind::none || look.kind == Kind::plane || !look.leaves) return;
  // The number of steps varies, so that bodies that fall alike do not leave their boxes all at once.
  const int ahead = entry.foresight - static_cast<int>(index % (entry.foresight / 2 + 1u));
  tree_of(look.kind).set(index, look.still ? entry.swept : in_space(with_room(entry.swept, look.travel, ahead)));
  renew(index);
}

/// Adds to `fresh` the pairs of a renewed body. @return false when they become more than `most`
bool BroadPhase::look_around(std::uint32_t index, const PairFilter& filter, std::size_t most,
                             std::vector<Pair>& fresh) {
  Entry& entry = entries_[index];
  const std::size_t before = fresh.size();
  std::size_t neighbors = 0;
  const auto see = [&](std::uint32_t other) {
    ++neighbors;
    // Of two renewed bodies, the one with the smaller index finds the pair.
    if (other == index || (entries_[other].renewed && other < index) || fresh.size() >= most) return;
    if (!filter.lets(index, other)) return;
    fresh.emplace_back(std::min(index, other), std::max(index, other));
  };
  const Bounds& box = tree_of(entry.kind).of(index);
  movable_.visit(box, see);
  if (entry.kind == Kind::movable) immovable_.visit(box, see);
  if (neighbors < few_neighbors)
    entry.foresight = std::min<std::uint8_t>(longest_foresight, static_cast<std::uint8_t>(2 * entry.foresight));
  else if (neighbors > many_neighbors)
    entry.foresight = std::max<std::uint8_t>(1, entry.foresight / 2);
  return before + neighbors < most;
}

/// Brings `kept_` up to date, or finds that there are too many pairs to keep.
void BroadPhase::keep_pairs(const PairFilter& filter, const threads::Workers& work) {
  const std::size_t most = 4096 + kept_in_crowd * movable_.size();
  fresh_parts_.resize(std::max(fresh_parts_.size(), work.range_count(renewed_.size(), worth_a_look)));
  for (std::vector<Pair>& part : fresh_parts_) part.clear();
  std::atomic<bool> too_many = false;
  work.numbered_ranges(renewed_.size(), worth_a_look, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !too_many; ++i) {
      const Kind kind = entries_[renewed_[i]].kind;
      if (kind != Kind::movable && kind != Kind::immovable) continue;
      if (!look_around(renewed_[i], filter, most, fresh_parts_[part])) too_many = true;
    }
  });
  std::size_t count = 0;
  for (const std::vector<Pair>& part : fresh_parts_) count += part.size();
  crowded_ = too_many || count >= most;
  if (!crowded_ && !renewed_.empty()) {
    merge_fresh(count, work);
    crowded_ = kept_.size() > most;
  }
  for (const std::uint32_t index : renewed_) entries_[index].renewed = false;
  renewed_.clear();
}

/// Replaces what was kept of renewed bodies by the pairs found for them. All pairs whose first body is in one range are
/// merged in one part.
void BroadPhase::merge_fresh(std::size_t count, const threads::Workers& work) {
  const std::size_t parts = std::max<std::size_t>(1, work.range_count(kept_.size() + count, worth_merging));
  merged_parts_.resize(std::max(merged_parts_.size(), parts));
  work.parts(parts, [&](std::size_t part) {
    const auto first = static_cast<std::uint32_t>(entries_.size() * part / parts);
    const auto behind = static_cast<std::uint32_t>(entries_.size() * (part + 1) / parts);
    std::vector<Pair>& merged = merged_parts_[part].all;
    std::vector<Pair>& fresh = merged_parts_[part].fresh;
    merged.clear();
    fresh.clear();
    for (const std::vector<Pair>& found : fresh_parts_)
      for (const Pair& pair : found)
        if (pair.first >= first && pair.first < behind) fresh.push_back(pair);
    std::sort(fresh.begin(), fresh.end());
    auto next = fresh.cbegin();
    auto kept = std::lower_bound(kept_.cbegin(), kept_.cend(), Pair(first, 0));
    for (; kept != kept_.cend() && kept->first < behind; ++kept) {
      if (entries_[kept->first].renewed || entries_[kept->second].renewed) continue;
      for (; next != fresh.cend() && *next < *kept; ++next) merged.push_back(*next);
      merged.push_back(*kept);
    }
    merged.insert(merged.end(), next, fresh.cend());
  });
  if (parts == 1) return kept_.swap(merged_parts_.front().all);
  kept_.clear();
  for (const MergedPart& part : std::span(merged_parts_).first(parts))
    kept_.insert(kept_.end(), part.all.begin(), part.all.end());
}

bool BroadPhase::may_meet(std::uint32_t a, std::uint32_t b) const {
  const Entry &first = entries_[a], &second = entries_[b];
  return (first.stirs || second.stirs) && overlap(first.swept, second.swept);
}

bool BroadPhase::both_move(std::uint32_t a, std::uint32_t b) const {
  return entries_[a].kind == Kind::movable && entries_[b].kind == Kind::movable;
}

/// For two that may meet and both have many neighbors: whether either still has too few such pairs.
bool BroadPhase::counts(std::uint32_t a, std::uint32_t b) {
  if (neighbor_counts_[a] < most_pairs || neighbor_counts_[b] < most_pairs || !both_move(a, b)) return true;
  std::uint32_t &first = pair_counts_[a], &second = pair_counts_[b];
  if (first >= most_pairs && second >= most_pairs) return false;
  ++first;
  ++second;
  return true;
}

/// Removes the excess pairs from `pairs_`.
void BroadPhase::count_out() {
  bool many = false;
  for (const auto& [a, b] : pairs_) {
    if (!both_move(a, b)) continue;
    many = ++neighbor_counts_[a] >= most_pairs || many;
    many = ++neighbor_counts_[b] >= most_pairs || many;
  }
  if (many) std::erase_if(pairs_, [this](const Pair& pair) { return !counts(pair.first, pair.second); });
}

void BroadPhase::choose_among_kept(const threads::Workers& work) {
  chosen_parts_.resize(std::max(chosen_parts_.size(), work.range_count(kept_.size(), worth_merging)));
  for (std::vector<Pair>& part : chosen_parts_) part.clear();
  work.numbered_ranges(kept_.size(), worth_merging, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (may_meet(kept_[i].first, kept_[i].second)) chosen_parts_[part].push_back(kept_[i]);
  });
  for (const std::vector<Pair>& part : chosen_parts_) pairs_.insert(pairs_.end(), part.begin(), part.end());
  count_out();
}

bool BroadPhase::choose_by(PairSearch search, const PairFilter& filter) {
  for (const std::uint32_t index : renewed_) entries_[index].renewed = false;
  renewed_.clear();
  std::vector<Item> items;
  for (std::uint32_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].kind == Kind::movable || entries_[i].kind == Kind::immovable)
      items.push_back({entries_[i].swept, i, entries_[i].kind == Kind::movable});
  Search found;
  found.items = items;
  found.most = found_once_more * (4096 + kept_in_crowd * movable_.size());
  search_by(search)(found);
  if (found.crowded()) return false;
  found.sort();
  for (const Pair& pair : found.found)
    if (filter.lets(pair.first, pair.second) && may_meet(pair.first, pair.second)) pairs_.push_back(pair);
  count_out();
  return true;
}

/// How many moving bodies it may meet, counted no further than it matters.
std::uint32_t BroadPhase::count_neighbors(std::uint32_t index, const PairFilter& filter) const {
  std::uint32_t count = 0;
  movable_.visit_while(
      entries_[index].swept, [&] { return count < most_pairs; },
      [&](std::uint32_t other) {
        if (other != index && filter.lets(index, other) && may_meet(index, other)) ++count;
      });
  return count;
}

/// The same pairs without keeping any. Bodies that have enough pairs only get those with bodies that have too few.
void BroadPhase::choose_in_crowd(std::span<const std::uint32_t> changed, const PairFilter& filter) {
  for (const std::uint32_t index : changed)
    if (entries_[index].kind == Kind::movable) neighbor_counts_[index] = count_neighbors(index, filter);
  movable_.open_all();
  for (const std::uint32_t index : changed) {
    if (entries_[index].kind != Kind::movable) continue;
    const Bounds& swept = entries_[index].swept;
    immovable_.visit(swept, [&](std::uint32_t other) {
      if (filter.lets(index, other) && may_meet(index, other))
        pairs_.emplace_back(std::min(index, other), std::max(index, other));
    });
    near_.clear();
    const auto see = [&](std::uint32_t other) {
      if (other > index && filter.lets(index, other)) near_.push_back(other);
    };
    if (pair_counts_[index] >= most_pairs)
      movable_.visit_open(swept, see);
    else
      movable_.visit(swept, see);
    std::sort(near_.begin(), near_.end());
    for (const std::uint32_t other : near_) {
      if (!may_meet(index, other) || !counts(index, other)) continue;
      pairs_.emplace_back(index, other);
      if (pair_counts_[other] == most_pairs) movable_.close(other);
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
}

void BroadPhase::add_planes(const std::vector<Body>& bodies, std::span<const std::uint32_t> changed,
                            const PairFilter& filter, double margin) {
  fresh_.clear();
  for (const std::uint32_t index : planes_) {
    const Entry& entry = entries_[index];
    const Shape& shape = bodies[index].shape();
    const auto& plane = std::get<Plane>(shape.solid);
    const shapes::Placed placed = shapes::place(shape, bodies[index].motion.pose);
    const Vec3 normal = placed.axes * plane.normal;
    const double surface = normal.dot(placed.center) + plane.offset;
    for (const std::uint32_t other : changed) {
      const Entry& body = entries_[other];
      if (body.kind != Kind::movable || !(entry.stirs || body.stirs) || !filter.lets(index, other)) continue;
      if (!entry.displaces) {
        const Vec3 lowest = (normal.array() > 0).select(body.swept.low, body.swept.high);
        const double rounding = 1e-9 * (std::abs(surface) + lowest.norm());
        if (normal.dot(lowest) - surface > 0.5 * margin + rounding) continue;
      }
      fresh_.emplace_back(std::min(index, other), std::max(index, other));
    }
  }
  std::sort(fresh_.begin(), fresh_.end());
  merged_.clear();
  merged_.reserve(pairs_.size() + fresh_.size());
  std::merge(pairs_.begin(), pairs_.end(), fresh_.begin(), fresh_.end(), std::back_inserter(merged_));
  std::swap(pairs_, merged_);
}

const std::vector<Pair>& BroadPhase::find(const std::vector<Body>& bodies, std::span<const std::uint32_t> changed,
                                          const std::vector<forces::Load>& loads, const PairFilter& filter,
                                          double margin, double dt, const threads::Workers& work, PairSearch search) {
  entries_.resize(std::max(entries_.size(), bodies.size()));
  pair_counts_.resize(entries_.size());
  neighbor_counts_.resize(entries_.size());
  looks_.resize(changed.size());
  work.ranges(changed.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      constexpr std::size_t ahead = 6;
      if (i + ahead < end) {
        movable_.fetch(changed[i + ahead]);
        state::fetch(&bodies[changed[i + ahead]]);
      }
      looks_[i] = look_at(bodies[changed[i]], changed[i], loads[changed[i]], margin, dt);
    }
  });
  for (std::size_t i = 0; i < changed.size(); ++i) follow(looks_[i], changed[i]);
  movable_.settle();
  immovable_.settle();
  const bool searches = search != PairSearch::tree;
  if (!crowded_ && !searches) keep_pairs(filter, work);
  pairs_.clear();
  if (searches) {
    if (!choose_by(search, filter)) choose_in_crowd(changed, filter);
  } else if (crowded_) {
    choose_in_crowd(changed, filter);
    // The crowd has thinned out: the next step keeps pairs again, starting with none.
    if (pairs_.size() <= found_in_crowd * movable_.size()) {
      crowded_ = false;
      kept_.clear();
      for (const std::uint32_t index : changed)
        if (entries_[index].kind == Kind::movable) renew(index);
    }
  } else {
    choose_among_kept(work);
  }
  if (!planes_.empty()) add_planes(bodies, changed, filter, margin);
  return pairs_;
}

}  // namespace tweenfall::pairs
