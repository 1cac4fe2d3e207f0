#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "collision/collide_pairs.h"
#include "collision/passage.h"
#include "shapes/turned.h"
#include "state/world_data.h"
#include "step/combine.h"
#include "step/found_manifold.h"

namespace tweenfall {

namespace step {
namespace {

/// Gaps up to this are contacts from the start of the step, m; wider ones only when the bodies meet within it.
constexpr double near_enough = 2e-3;
/// Two bodies that both have so many contacts already get none with each other.
constexpr std::uint32_t most_contacts = 32;
/// Pairs, or bodies, that are worth a part of their own.
constexpr std::size_t worth_a_part = 64;

/// How a body's surface rolls where something touches it, m.
double rolling_radius(const state::Body& body, const collision::Prediction& at, const Vec3& position, const Vec3& out) {
  if (body.roundness > 0) return body.roundness;
  if (!body.turned) return 0;
  const shapes::Placed placed = shapes::place(body.shape, at.node(body));
  const Mat3 into = placed.axes.transpose();
  return shapes::rolling_radius(body.shape.solid, into * (position - placed.center), into * out);
}

/// The points of a manifold as constraints, told about the bodies' places at the start of the step.
void adopt(ContactConstraint& constraint, const state::Body& a, const collision::Prediction& at_a, const state::Body& b,
           const collision::Prediction& at_b) {
  const Quat back_a = a.motion.pose.rotation * at_a.rotation.conjugate();
  const Quat back_b = b.motion.pose.rotation * at_b.rotation.conjugate();
  const Manifold& manifold = constraint.manifold;
  constraint.count = manifold.count;
  for (int i = 0; i < manifold.count; ++i) {
    const ContactPoint& from = manifold.points[static_cast<std::size_t>(i)];
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point = {};
    point.feature = from.feature;
    point.start_arm_a = from.position - at_a.center;
    point.start_arm_b = from.position - at_b.center;
    point.start_gap = -from.penetration;
    point.skin_a = rolling_radius(a, at_a, from.position, manifold.normal);
    point.skin_b = rolling_radius(b, at_b, from.position, -manifold.normal);
    if (constraint.impact_time == 0) continue;
    point.start_arm_a = state::carried(back_a, point.start_arm_a, point.skin_a * manifold.normal);
    point.start_arm_b = state::carried(back_b, point.start_arm_b, -point.skin_b * manifold.normal);
    point.start_gap += manifold.normal.dot((b.center + point.start_arm_b) - (a.center + point.start_arm_a));
  }
}

/// Hands the impulses of the step before on: to points of the same features, then to what is left nearby.
void inherit(ContactConstraint& constraint, const state::ContactMemory& old, double nearby) {
  static_cast<state::KeptImpulses&>(constraint) = old.kept;
  std::array<bool, 4> given{}, taken{};
  const auto hand_on = [&](std::size_t from, std::size_t to) {
    constraint.points[to].kept_normal = old.points[from].kept_normal;
    constraint.points[to].kept_friction = old.points[from].kept_friction;
    given[from] = taken[to] = true;
  };
  const auto count = static_cast<std::size_t>(constraint.count);
  const auto old_count = static_cast<std::size_t>(old.count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < old_count; ++k)
      if (!given[k] && !taken[i] && old.points[k].feature == constraint.points[i].feature) hand_on(k, i);
  for (std::size_t i = 0; i < count; ++i) {
    if (taken[i]) continue;
    std::size_t best = old_count;
    double least = nearby;
    for (std::size_t k = 0; k < old_count; ++k) {
      const double away = (old.points[k].arm_b - constraint.points[i].start_arm_b).norm();
      if (given[k] || away >= least) continue;
      least = away;
      best = k;
    }
    if (best < old_count) hand_on(best, i);
  }
}

}  // namespace
}  // namespace step

bool World::Implementation::find_manifold(step::ContactConstraint& constraint, const state::Body& a,
                                          const state::Body& b, const collision::Passage& way_a,
                                          const collision::Passage& way_b, double dt,
                                          std::vector<step::KnownApart>& told_apart) const {
  const double swing = way_a.swing + way_b.swing;
  const double reach = step::near_enough + (swing * dt > step::near_enough ? swing * dt : 0);
  const Manifold manifold = collision::collide(a.shape, way_a.placed, b.shape, way_b.placed, step::near_enough, reach);
  if (manifold.count > 0) {
    constraint.manifold = manifold;
    step::adopt(constraint, a, {a.center, a.motion.pose.rotation}, b, {b.center, b.motion.pose.rotation});
  } else {
    const collision::Apart apart = collision::apart_along(way_a, way_b, manifold.normal);
    if (apart.frame != collision::Apart::Frame::none) told_apart.push_back({{constraint.a, constraint.b}, apart});
    const double gap = collision::gap_along(way_a, way_b, manifold.normal);
    if (collision::stay_apart(way_a, way_b, manifold.normal, gap, step::near_enough, dt)) return false;
    const std::optional<double> meeting = collision::impact_time(way_a.course, way_b.course, dt);
    if (!meeting) return false;
    constraint.impact_time = *meeting;
    const collision::Prediction at_a = way_a.course.at(*meeting);
    const collision::Prediction at_b = way_b.course.at(*meeting);
    // What a spin brings down in what is left of the step, too.
    const double rest = step::near_enough + swing * (dt - *meeting);
    constraint.manifold = tweenfall::collide(a.shape, at_a.node(a), b.shape, at_b.node(b), rest);
    step::adopt(constraint, a, at_a, b, at_b);
  }
  return constraint.count > 0 && constraint.manifold.normal.allFinite();
}

bool World::Implementation::recall(std::span<const pairs::Pair> pairs) {
  ++look;
  looked_at.resize(bodies.size(), 0);
  looked_for.clear();
  pair_memories.clear();
  contact_counts.assign(bodies.size(), 0);
  const std::span<const std::uint32_t> remembered_before = memories.sorted();
  std::size_t next = 0;
  /// Of memories before the pair, which are near nothing that stirs, all is kept.
  const auto memory_of = [&](const pairs::Pair& pair) {
    for (; next < remembered_before.size(); ++next) {
      const state::ContactMemory& memory = memories[remembered_before[next]];
      const pairs::Pair its(memory.a, memory.b);
      if (its > pair) break;
      if (its == pair) return remembered_before[next++];
      if (!bodies[memory.a].stirs() && !bodies[memory.b].stirs()) retained.push_back(remembered_before[next]);
    }
    return state::ContactMemories::nowhere;
  };
  bool crowded = false;
  for (const pairs::Pair& pair : pairs) {
    pair_memories.push_back(memory_of(pair));
    for (const std::uint32_t index : {pair.first, pair.second}) {
      if (looked_at[index] == look) continue;
      looked_at[index] = look;
      looked_for.push_back(index);
    }
    crowded = crowded ||
              (contact_counts[pair.first] >= step::most_contacts && contact_counts[pair.second] >= step::most_contacts);
    ++contact_counts[pair.first];
    ++contact_counts[pair.second];
  }
  memory_of({std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max()});
  return crowded;
}

void World::Implementation::find_part(std::span<const pairs::Pair> pairs, std::span<const std::uint32_t> memories_of,
                                      bool crowded, double dt, step::FoundPart& part) {
  part.contacts.clear();
  part.aparts.clear();
  auto next_apart =
      pairs.empty()
          ? aparts.cend()
          : std::lower_bound(aparts.cbegin(), aparts.cend(), pairs.front(),
                             [](const step::KnownApart& known, const pairs::Pair& pair) { return known.pair < pair; });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto [index_a, index_b] = pairs[i];
    const state::Body& a = bodies[index_a];
    const state::Body& b = bodies[index_b];
    if (crowded && contact_counts[index_a] >= step::most_contacts && contact_counts[index_b] >= step::most_contacts &&
        !a.immovable() && !b.immovable())
      continue;
    const collision::Passage& way_a = passages[index_a];
    const collision::Passage& way_b = passages[index_b];
    while (next_apart != aparts.cend() && next_apart->pair < pairs[i]) ++next_apart;
    if (next_apart != aparts.cend() && next_apart->pair == pairs[i]) {
      const Vec3 direction = next_apart->apart.in_world(way_a, way_b);
      if (collision::stay_apart(way_a, way_b, direction, collision::gap_along(way_a, way_b, direction),
                                step::near_enough, dt)) {
        part.aparts.push_back(*next_apart);
        continue;
      }
    }
    const bool known = memories_of[i] != state::ContactMemories::nowhere;
    const state::ContactMemory* memory = known ? &std::as_const(memories)[memories_of[i]] : nullptr;
    step::ContactConstraint& constraint = part.contacts.emplace_back();
    constraint.a = index_a;
    constraint.b = index_b;
    constraint.memory = memories_of[i];
    constraint.kept = memory && step::take_up(*memory, a, b, way_a.swing + way_b.swing, dt, constraint);
    if (!constraint.kept && !find_manifold(constraint, a, b, way_a, way_b, dt, part.aparts)) {
      part.contacts.pop_back();
      continue;
    }
    constraint.friction = step::combined_friction(a.friction, a.friction_combine, b.friction, b.friction_combine);
    constraint.restitution =
        step::combined_restitution(a.restitution, a.restitution_combine, b.restitution, b.restitution_combine);
    constraint.rolling_friction = std::max(a.rolling_friction, b.rolling_friction);
    constraint.spinning_friction = std::max(a.spinning_friction, b.spinning_friction);
    constraint.began = !(memory && memory->touching);
    if (memory) step::inherit(constraint, *memory, 0.05 * std::min(a.radius, b.radius));
    if (!crowded) continue;
    ++contact_counts[index_a];
    ++contact_counts[index_b];
  }
}

void World::Implementation::find_constraints(double dt) {
  active.clear();
  retained.clear();
  memories.tidy();
  const threads::Workers work = workers();
  const std::vector<pairs::Pair>& pairs =
      broad_phase.find(bodies, watched, loads, {bodies, ignored}, step::near_enough, dt, work);
  const bool crowded = recall(pairs);
  passages.resize(bodies.size());
  work.ranges(looked_for.size(), step::worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      passages[looked_for[i]] = collision::passage_of(bodies[looked_for[i]], loads[looked_for[i]], dt);
  });
  const std::span<const pairs::Pair> all = pairs;
  const std::span<const std::uint32_t> known = pair_memories;
  const auto find = [&](std::size_t part, std::size_t begin, std::size_t end) {
    find_part(all.subspan(begin, end - begin), known.subspan(begin, end - begin), crowded, dt, found[part]);
  };
  // In a crowd what a pair may have depends on the pairs before it.
  const std::size_t parts = crowded ? 1 : std::max<std::size_t>(1, work.range_count(pairs.size(), step::worth_a_part));
  found.resize(std::max(parts, found.size()));
  for (std::size_t i = parts; i < found.size(); ++i) found[i].contacts.clear();
  if (crowded) {
    contact_counts.assign(bodies.size(), 0);
    find(0, 0, pairs.size());
  } else if (pairs.empty()) {
    find(0, 0, 0);
  } else {
    work.numbered_ranges(pairs.size(), step::worth_a_part, find);
  }
  aparts.clear();
  for (std::size_t i = 0; i < parts; ++i) {
    aparts.insert(aparts.end(), found[i].aparts.begin(), found[i].aparts.end());
    for (step::ContactConstraint& contact : found[i].contacts) active.push_back(&contact);
  }
}

}  // namespace tweenfall
