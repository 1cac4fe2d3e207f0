#include "planar/contacts/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "contacts/combine.h"

namespace tweenfall::planar::inner {

namespace {

/// How much boxes are enlarged, besides the room for what lies ahead, in parts of a body's reach.
constexpr double spare = 0.05;
/// Steps like this one for which a box has room.
constexpr double foresight = 4;

bool overlap(const Bounds& one, const Bounds& other) {
  return (one.low.array() <= other.high.array()).all() && (other.low.array() <= one.high.array()).all();
}

bool may_meet(const Body& body_a, const Makeup& a, const Body& body_b, const Makeup& b) {
  if ((a.groups & b.collides_with) == 0 || (b.groups & a.collides_with) == 0) return false;
  if (a.sensor || b.sensor) return !(a.sensor && b.sensor) && !(a.fixed && b.fixed);
  return body_a.movable || body_b.movable;
}

Bounds box_around(const Body& body, const Plate& plate) {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  bool first = true;
  for (const Corner& corner : plate.corners) {
    const Vec2 at = body.turn * corner.at;
    low = first ? at : low.cwiseMin(at);
    high = first ? at : high.cwiseMax(at);
    first = false;
  }
  const Vec2 room = Vec2::Constant(plate.skin + body.boxed_room);
  low += body.center - room;
  high += body.center + room;
  return {Vec3(low.x(), low.y(), 0), Vec3(high.x(), high.y(), 0)};
}

}  // namespace

void NearPairs::remove(std::uint32_t body) {
  tree_.remove(body);
  std::erase(endless_, body);
  if (body < part_boxes_.size()) part_boxes_[body].clear();
}

void NearPairs::box(const Body& body, const Makeup& makeup, std::uint32_t index) {
  if (!makeup.endless()) {
    Bounds all = box_around(body, makeup.plates[0]);
    if (body.compound) {
      part_boxes_.resize(std::max<std::size_t>(part_boxes_.size(), index + std::size_t{1}));
      std::vector<Bounds>& boxes = part_boxes_[index];
      boxes.clear();
      for (const Plate& plate : makeup.plates) {
        boxes.push_back(box_around(body, plate));
        all.low = all.low.cwiseMin(boxes.back().low);
        all.high = all.high.cwiseMax(boxes.back().high);
      }
    }
    tree_.set(index, all);
    return;
  }
  const auto place = std::lower_bound(endless_.begin(), endless_.end(), index);
  if (place == endless_.end() || *place != index) endless_.insert(place, index);
}

void NearPairs::restore(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups) {
  tree_ = {};
  endless_.clear();
  part_boxes_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].alive || !bodies[i].boxed) continue;
    Body then = bodies[i];
    then.center = bodies[i].boxed_center;
    then.turn = Turn::of(bodies[i].boxed_angle);
    box(then, makeups[i], i);
  }
  tree_.settle();
}

/// How many moving bodies are near it, counted no further than it matters.
/// @param all  counts all, or only those that have so many neighbors themselves
std::uint32_t NearPairs::neighbors(std::uint32_t index, const std::vector<Body>& bodies,
                                   const std::vector<Makeup>& makeups, bool all) {
  std::uint32_t count = 0;
  tree_.visit_while(
      tree_.of(index), [&] { return count < crowding; },
      [&](std::uint32_t other) {
        if (other == index || !bodies[other].movable) return;
        if (!may_meet(bodies[index], makeups[index], bodies[other], makeups[other])) return;
        if (!all) {
          if (neighbors_[other] == unknown) neighbors_[other] = neighbors(other, bodies, makeups, true);
          if (neighbors_[other] < crowding) return;
        }
        ++count;
      });
  return count;
}

bool NearPairs::is_full(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups) {
  if (counts_[index] < most || !bodies[index].movable) return false;
  if (crowds_[index] == unknown) crowds_[index] = neighbors(index, bodies, makeups, false);
  return crowds_[index] >= crowding;
}

void NearPairs::look_around(std::uint32_t index, const std::vector<Body>& bodies, const std::vector<Makeup>& makeups,
                            const std::vector<Pair>& apart) {
  const Makeup& makeup = makeups[index];
  seen_.clear();
  const auto see = [&](std::uint32_t other) {
    // If both are searched around, the first finds the other.
    if (other == index || (is_renewed_[other] && other < index)) return;
    if (may_meet(bodies[index], makeup, bodies[other], makeups[other])) seen_.push_back(other);
  };
  if (makeup.endless()) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].alive && !makeups[i].endless()) see(i);
  } else if (is_full(index, bodies, makeups)) {
    tree_.visit_open(tree_.of(index), see);
  } else {
    tree_.visit(tree_.of(index), see);
  }
  if (!makeup.endless())
    for (const std::uint32_t other : endless_) see(other);
  std::sort(seen_.begin(), seen_.end());
  for (const std::uint32_t other : seen_) {
    const Pair pair = std::minmax(index, other);
    if (!apart.empty() && std::binary_search(apart.begin(), apart.end(), pair)) continue;
    if (bodies[index].movable && bodies[other].movable) {
      if (is_full(index, bodies, makeups) && is_full(other, bodies, makeups)) continue;
      for (const std::uint32_t one : {index, other}) {
        ++counts_[one];
        if (closed_[one] || !is_full(one, bodies, makeups)) continue;
        closed_[one] = 1;
        tree_.close(one);
      }
    }
    meet_parts(pair, makeups);
  }
}

void NearPairs::meet_parts(const Pair& pair, const std::vector<Makeup>& makeups) {
  const auto [a, b] = pair;
  const auto parts_a = static_cast<std::uint32_t>(makeups[a].plates.size());
  const auto parts_b = static_cast<std::uint32_t>(makeups[b].plates.size());
  if (parts_a == 1 && parts_b == 1) {
    fresh_.push_back({a, b, 0, 0});
    return;
  }
  const auto box_of = [&](std::uint32_t body, std::uint32_t parts, std::uint32_t part) -> const Bounds& {
    return parts > 1 ? part_boxes_[body][part] : tree_.of(body);
  };
  const bool no_end = makeups[a].endless() || makeups[b].endless();
  for (std::uint32_t i = 0; i < parts_a; ++i)
    for (std::uint32_t k = 0; k < parts_b; ++k)
      if (no_end || overlap(box_of(a, parts_a, i), box_of(b, parts_b, k))) fresh_.push_back({a, b, i, k});
}

void NearPairs::merge(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups,
                      std::vector<Meeting>& meetings) {
  std::sort(fresh_.begin(), fresh_.end());
  merged_.clear();
  merged_.reserve(meetings.size() + fresh_.size());
  std::size_t next = 0;
  const auto add_fresh = [&] {
    Meeting meeting;
    const Encounter& its = fresh_[next++];
    std::tie(meeting.a, meeting.b, meeting.part_a, meeting.part_b) = std::tie(its.a, its.b, its.part_a, its.part_b);
    const Makeup &a = makeups[meeting.a], &b = makeups[meeting.b];
    meeting.friction = contacts::combined_friction(a.friction, a.friction_combine, b.friction, b.friction_combine);
    meeting.restitution =
        contacts::combined_restitution(a.restitution, a.restitution_combine, b.restitution, b.restitution_combine);
    meeting.rolling_friction = std::max(a.rolling_friction, b.rolling_friction);
    meeting.sensing = a.sensor || b.sensor;
    merged_.push_back(meeting);
  };
  for (const Meeting& meeting : meetings) {
    if (!bodies[meeting.a].alive || !bodies[meeting.b].alive) continue;
    const Encounter its = encounter_of(meeting);
    while (next < fresh_.size() && fresh_[next] < its) add_fresh();
    const bool again = next < fresh_.size() && fresh_[next] == its;
    if (again) ++next;
    if (again || !(is_renewed_[meeting.a] || is_renewed_[meeting.b])) merged_.push_back(meeting);
  }
  while (next < fresh_.size()) add_fresh();
  meetings.swap(merged_);
}

void NearPairs::update(std::vector<Body>& bodies, const std::vector<Makeup>& makeups, const std::vector<Pair>& apart,
                       std::vector<Meeting>& meetings) {
  renewed_.clear();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (!body.alive) continue;
    const Makeup& makeup = makeups[i];
    if (body.boxed) {
      if (!body.under_way || makeup.endless()) continue;
      const double turned = std::min(2.0, std::abs(body.angle - body.boxed_angle)) * body.reach;
      const double needed = (body.center - body.boxed_center).norm() + turned + body.travel + close * body.reach;
      if (needed <= body.boxed_room) continue;
    }
    body.boxed = true;
    body.boxed_center = body.center;
    body.boxed_angle = body.angle;
    body.boxed_room = foresight * body.travel + (close + spare) * body.reach;
    box(body, makeup, i);
    renewed_.push_back(i);
  }
  if (renewed_.empty()) return;
  tree_.settle();
  is_renewed_.assign(bodies.size(), 0);
  for (const std::uint32_t i : renewed_) is_renewed_[i] = 1;
  counts_.assign(bodies.size(), 0);
  neighbors_.assign(bodies.size(), unknown);
  crowds_.assign(bodies.size(), unknown);
  closed_.assign(bodies.size(), 0);
  Pair counted(0, 0);
  for (const Meeting& meeting : meetings) {
    if (is_renewed_[meeting.a] || is_renewed_[meeting.b]) continue;
    // Parts of one pair count once.
    const Pair pair(meeting.a, meeting.b);
    if (std::exchange(counted, pair) == pair) continue;
    if (!bodies[meeting.a].movable || !bodies[meeting.b].movable) continue;
    ++counts_[meeting.a];
    ++counts_[meeting.b];
  }
  tree_.open_all();
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].alive && is_full(i, bodies, makeups)) {
      closed_[i] = 1;
      tree_.close(i);
    }
  fresh_.clear();
  for (const std::uint32_t i : renewed_) look_around(i, bodies, makeups, apart);
  merge(bodies, makeups, meetings);
}

}  // namespace tweenfall::planar::inner
