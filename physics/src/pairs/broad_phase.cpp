#include "pairs/broad_phase.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace {

/// Two bodies that both have so many neighbors already are no pair: thousands at one place part all the same.
constexpr std::uint32_t most_pairs = 128;

bool overlap(const Bounds& a, const Bounds& b) {
  for (int i = 0; i < 3; ++i)
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  return true;
}

/// Only a body that moves by itself can be moved by a contact, and only a stir can change one.
template <class Entry>
bool matters(const Entry& a, const Entry& b) {
  return (a.movable || b.movable) && (a.dynamic || b.dynamic);
}

}  // namespace

const std::vector<Pair>& BroadPhase::find(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                                          double margin, double dt) {
  entries_.clear();
  planes_.clear();
  pairs_.clear();
  Vec3 sum = Vec3::Zero();
  Vec3 squares = Vec3::Zero();
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    if (!body.alive) continue;
    const bool immovable = body.immovable();
    Entry entry{bounds(body.shape, body.motion.pose), i, body.stirs(), !immovable, 0};
    if (std::holds_alternative<Plane>(body.shape.solid)) {
      planes_.push_back(entry);
      continue;
    }
    Vec3 travel = Vec3::Zero();
    double swing = 0;
    if (body.has_target && immovable) {
      const Bounds end = bounds(body.shape, body.target.pose);
      entry.bounds.low = entry.bounds.low.cwiseMin(end.low);
      entry.bounds.high = entry.bounds.high.cwiseMax(end.high);
      // Between its ends an arc bulges out over both.
      const double cosine = std::abs(body.target.pose.rotation.dot(body.motion.pose.rotation));
      swing = body.radius * (1 - std::min(1.0, cosine));
    } else if (!immovable && !body.asleep) {
      const Twist& twist = body.drive.owner() == Owner::driven ? loads[i].pulled : body.twist;
      travel = twist.linear * dt;
      if (!body.spherical || body.mass.center != Vec3::Zero() || std::holds_alternative<Hull>(body.shape.solid))
        swing = std::min(twist.angular.norm() * dt, 2.0) * body.radius;
      swing += loads[i].acceleration.norm() * dt * dt;
    }
    const Vec3 room = Vec3::Constant(0.5 * margin + swing);
    entry.bounds.low += travel.cwiseMin(0.0) - room;
    entry.bounds.high += travel.cwiseMax(0.0) + room;
    const Vec3 middle = 0.5 * (entry.bounds.low + entry.bounds.high);
    sum += middle;
    squares += middle.cwiseProduct(middle);
    entries_.push_back(entry);
  }
  const double count = std::max<double>(1, static_cast<double>(entries_.size()));
  const Vec3 spread = squares / count - (sum / count).cwiseProduct(sum / count);
  int axis = 0;
  if (spread[1] > spread[axis]) axis = 1;
  if (spread[2] > spread[axis]) axis = 2;
  std::sort(entries_.begin(), entries_.end(), [axis](const Entry& a, const Entry& b) {
    return a.bounds.low[axis] != b.bounds.low[axis] ? a.bounds.low[axis] < b.bounds.low[axis] : a.index < b.index;
  });
  const auto add = [this](const Entry& a, const Entry& b) {
    pairs_.emplace_back(std::min(a.index, b.index), std::max(a.index, b.index));
  };
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& a = entries_[i];
    for (std::size_t j = i + 1; j < entries_.size() && entries_[j].bounds.low[axis] <= a.bounds.high[axis]; ++j) {
      Entry& b = entries_[j];
      if (a.pairs >= most_pairs && b.pairs >= most_pairs && a.movable && b.movable) continue;
      if (!matters(a, b) || !overlap(a.bounds, b.bounds)) continue;
      ++a.pairs;
      ++b.pairs;
      add(a, b);
    }
  }
  for (const Entry& plane : planes_)
    for (const Entry& entry : entries_)
      if (matters(plane, entry)) add(plane, entry);
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

}  // namespace tweenfall
