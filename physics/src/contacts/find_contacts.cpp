#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "collision/collide_pairs.h"
#include "collision/passage.h"
#include "collision/surfaces/surface.h"
#include "contacts/adopt.h"
#include "contacts/combine.h"
#include "contacts/followers.h"
#include "contacts/found_manifold.h"
#include "contacts/seams.h"
#include "state/prefetch.h"
#include "state/world_data.h"

namespace tweenfall {

namespace contacts {
namespace {

/// A body that moves by itself and may meet so many that do is in a crowd; two bodies of a crowd that both touch so
/// many others in it get no contact with each other. A large body that carries many small ones is in none: each of
/// those meets few.
constexpr std::uint32_t crowding = 64, most_contacts = 16;
/// Number of pairs, or bodies, that are worth a task of their own.
constexpr std::size_t worth_a_part = 64;

/// How near two bodies are that have met, m: a blow that springs back must be found exactly, and of balls all are,
/// cheaply.
double nearness_of_impact(const state::Body& a, const state::Body& b) {
  constexpr double of_near_enough = 0.05, of_size = 1e-3;
  const double restitution = combined_restitution(a.makeup->restitution, a.makeup->restitution_combine,
                                                  b.makeup->restitution, b.makeup->restitution_combine);
  if (restitution > dull || a.round() || b.round()) return collision::hair;
  return std::max(collision::hair, std::min(of_near_enough * near_enough, of_size * std::min(a.radius(), b.radius())));
}

/// Whether two bodies lay in each other when they met, deeper than their motion brings them in a step of `dt`, and have
/// not been taken apart since.
bool lies_within(const ContactConstraint& constraint, const state::ContactMemory* memory, const state::Body& a,
                 const state::Body& b, double dt) {
  constexpr double hardly = 0.05;  // of what is near enough
  const double near = std::min(near_enough, near_enough_of_small * std::min(a.radius(), b.radius()));
  if (constraint.began ? constraint.impact_time != 0 : !memory->is(state::ContactMemory::within)) return false;
  for (int i = 0; i < constraint.count; ++i) {
    const PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    const double depth = -point.start_gap;
    if (!constraint.began) {
      if (depth > hardly * near) return true;
      continue;
    }
    if (!(depth > near)) continue;
    const Vec3 closing = (a.twist.linear + a.twist.angular.cross(point.start_arm_a)) -
                         (b.twist.linear + b.twist.angular.cross(point.start_arm_b));
    if (depth > closing.norm() * dt) return true;
  }
  return false;
}

/// The parts of a compound; empty for any other body, which is a single part.
std::span<const Shape> parts_of(const state::Body& body) {
  const auto* compound = std::get_if<Compound>(&body.shape().solid);
  return compound ? compound->parts() : std::span<const Shape>();
}

/// Passes on the impulses of the step before: to points of the same features, then to unmatched points nearby.
/// @param stand_b  where the second body was at the start of that step
void inherit(ContactConstraint& constraint, const state::ContactMemories& memories, const state::ContactMemory& old,
             const state::Stand& stand_b, double nearby) {
  static_cast<state::KeptImpulses&>(constraint) = memories.kept(old);
  std::array<bool, 4> given{}, taken{};
  std::size_t left = static_cast<std::size_t>(constraint.count);
  const auto hand_on = [&](std::size_t from, std::size_t to) {
    constraint.points[to].kept_normal = memories.point(old, from).kept_normal;
    constraint.points[to].kept_friction = memories.point(old, from).kept_friction;
    given[from] = taken[to] = true;
    --left;
  };
  const std::size_t count = left, old_count = old.count;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < old_count; ++k)
      if (!given[k] && !taken[i] && memories.feature(old, k) == constraint.points[i].feature) hand_on(k, i);
  if (left == 0) return;
  const std::array<Vec3, 4> arms = arms_of(memories, old, stand_b);
  for (std::size_t i = 0; i < count; ++i) {
    if (taken[i]) continue;
    std::size_t best = old_count;
    double least = nearby;
    for (std::size_t k = 0; k < old_count; ++k) {
      const double away = (arms[k] - constraint.points[i].start_arm_b).norm();
      if (given[k] || away >= least) continue;
      least = away;
      best = k;
    }
    if (best < old_count) hand_on(best, i);
  }
}

}  // namespace
}  // namespace contacts

bool World::Implementation::find_manifold(contacts::ContactConstraint& constraint, const state::Body& a,
                                          const state::Body& b, const collision::Passage& way_a,
                                          const collision::Passage& way_b, double dt,
                                          contacts::FoundPart* told_apart) const {
  const double swing = way_a.swing + way_b.swing;
  const double near = contacts::near_enough_of(way_a, way_b);
  const double reach = near + (swing * dt > near ? swing * dt : 0);
  const Manifold manifold =
      collision::collide(*way_a.course.shape, way_a.placed, *way_b.course.shape, way_b.placed, near, reach);
  if (manifold.count > 0) {
    constraint.manifold = manifold;
    contacts::adopt(constraint, way_a, {a.center, a.motion.pose.rotation}, way_b, {b.center, b.motion.pose.rotation});
  } else {
    const collision::Apart apart = collision::apart_along(way_a, way_b, manifold.normal);
    if (told_apart && apart.frame != collision::Apart::Frame::none)
      told_apart->aparts.push_back({{constraint.a, constraint.b}, apart});
    const double gap = collision::gap_along(way_a, way_b, manifold.normal);
    const bool apart_now = collision::stay_apart(way_a, way_b, manifold.normal, gap, near, dt);
    const std::optional<double> meeting =
        apart_now ? std::nullopt
                  : collision::impact_time(way_a.course, way_b.course, dt, contacts::nearness_of_impact(a, b),
                                           gap > collision::hair ? manifold.normal : Vec3(0, 0, 0));
    if (!meeting) {
      if (told_apart && contacts::may_follow(way_a, way_b, dt) && contacts::follow(way_a, way_b, gap, dt))
        told_apart->followers.push_back(
            {contacts::link_of(constraint.a, way_a, constraint.b, way_b, manifold.normal, gap), constraint.memory});
      return false;
    }
    constraint.impact_time = *meeting;
    const collision::Prediction at_a = way_a.course.at(*meeting);
    const collision::Prediction at_b = way_b.course.at(*meeting);
    // Includes what a spin brings down in the rest of the step, and what follows if a corner comes first.
    const double closing = std::max(0.0, manifold.normal.dot(way_a.course.linear - way_b.course.linear));
    const double rest = near + (swing + closing) * (dt - *meeting);
    constraint.manifold =
        tweenfall::collide(*way_a.course.shape, at_a.node(a), *way_b.course.shape, at_b.node(b), rest);
    contacts::adopt(constraint, way_a, at_a, way_b, at_b);
  }
  return constraint.count > 0 && constraint.manifold.normal.allFinite();
}

bool World::Implementation::recall(std::span<const pairs::Pair> pairs) {
  find_memories(pairs);
  ++look;
  looked_at.resize(bodies.size(), 0);
  looked_for.clear();
  neighbor_counts.assign(bodies.size(), 0);
  for (const pairs::Pair& pair : pairs) {
    for (const std::uint32_t index : {pair.first, pair.second}) {
      if (looked_at[index] == look) continue;
      looked_at[index] = look;
      looked_for.push_back(index);
    }
    if (bodies[pair.first].immovable() || bodies[pair.second].immovable()) continue;
    ++neighbor_counts[pair.first];
    ++neighbor_counts[pair.second];
  }
  if (std::none_of(looked_for.begin(), looked_for.end(),
                   [this](std::uint32_t index) { return neighbor_counts[index] >= contacts::crowding; }))
    return false;
  contact_counts.assign(bodies.size(), 0);
  for (const pairs::Pair& pair : pairs) {
    if (!in_crowd(pair)) continue;
    ++contact_counts[pair.first];
    ++contact_counts[pair.second];
  }
  return std::any_of(pairs.begin(), pairs.end(), [this](const pairs::Pair& pair) {
    return contact_counts[pair.first] > contacts::most_contacts &&
           contact_counts[pair.second] > contacts::most_contacts;
  });
}

bool World::Implementation::in_crowd(const pairs::Pair& pair) const {
  return neighbor_counts[pair.first] >= contacts::crowding && neighbor_counts[pair.second] >= contacts::crowding &&
         !bodies[pair.first].immovable() && !bodies[pair.second].immovable();
}

/// Fills in `pair_memories`. Memories without a pair are retained if nothing near them stirs.
void World::Implementation::find_memories(std::span<const pairs::Pair> pairs) {
  const std::span<const std::uint32_t> sorted = memories.sorted();
  const auto pair_at = [&](std::size_t number) {
    const state::ContactMemory& memory = memories[sorted[number]];
    return pairs::Pair(memory.a, memory.b);
  };
  const auto first_of = [&](const pairs::Pair& pair) {
    std::size_t low = 0, high = sorted.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (pair_at(middle) < pair)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  };
  pair_memories.resize(pairs.size());
  const threads::Workers work = workers();
  const std::size_t parts = std::max<std::size_t>(1, work.range_count(pairs.size(), contacts::worth_a_part));
  retained_parts.resize(std::max(retained_parts.size(), parts));
  for (std::vector<std::uint32_t>& part : retained_parts) part.clear();
  const auto find = [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::size_t next = begin == 0 ? 0 : first_of(pairs[begin]);
    const std::size_t stop = end == pairs.size() ? sorted.size() : first_of(pairs[end]);
    const auto retain = [&] {
      const auto [a, b] = pair_at(next);
      if (!bodies[a].stirs() && !bodies[b].stirs()) retained_parts[part].push_back(sorted[next]);
      ++next;
    };
    for (std::size_t i = begin; i < end; ++i) {
      while (next < stop && pair_at(next) < pairs[i]) retain();
      contacts::PairMemories own{static_cast<std::uint32_t>(next), 0};
      for (; next < stop && pair_at(next) == pairs[i]; ++next) ++own.count;
      pair_memories[i] = own;
    }
    while (next < stop) retain();
  };
  if (pairs.empty())
    find(0, 0, 0);
  else
    work.numbered_ranges(pairs.size(), contacts::worth_a_part, find);
  for (const std::vector<std::uint32_t>& part : retained_parts)
    retained.insert(retained.end(), part.begin(), part.end());
}

void World::Implementation::find_contact(const contacts::PairInContact& pair, const collision::Passage& way_a,
                                         const collision::Passage& way_b, double dt, bool alone,
                                         contacts::FoundPart& part) const {
  const state::Body& a = *way_a.body;
  const state::Body& b = *way_b.body;
  const state::ContactMemory* memory =
      pair.memory != state::ContactMemories::nowhere ? &memories[pair.memory] : nullptr;
  contacts::ContactConstraint& constraint = part.contacts.add();
  static_cast<contacts::PairInContact&>(constraint) = pair;
  constraint.kept = memory && contacts::take_up(memories, *memory, a, b, way_a.swing + way_b.swing, dt, constraint);
  if (!constraint.kept && !find_manifold(constraint, a, b, way_a, way_b, dt, alone ? &part : nullptr)) {
    part.contacts.drop_last();
    return;
  }
  finish_contact(constraint, memory, dt);
}

void World::Implementation::finish_contact(contacts::ContactConstraint& constraint, const state::ContactMemory* memory,
                                           double dt) const {
  const state::Body& a = bodies[constraint.a];
  const state::Body& b = bodies[constraint.b];
  constraint.friction = contacts::combined_friction(a.makeup->friction, a.makeup->friction_combine, b.makeup->friction,
                                                    b.makeup->friction_combine);
  constraint.restitution = contacts::combined_restitution(a.makeup->restitution, a.makeup->restitution_combine,
                                                          b.makeup->restitution, b.makeup->restitution_combine);
  constraint.rolling_friction = std::max(a.makeup->rolling_friction, b.makeup->rolling_friction);
  constraint.spinning_friction = std::max(a.makeup->spinning_friction, b.makeup->spinning_friction);
  constraint.began = !(memory && memory->is(state::ContactMemory::touching));
  constraint.within = contacts::lies_within(constraint, memory, a, b, dt);
  if (memory)
    contacts::inherit(constraint, memories, *memory, stands[constraint.b], 0.05 * std::min(a.radius(), b.radius()));
}

void World::Implementation::find_contacts_of_parts(const contacts::PairInContact& pair, contacts::PairMemories known,
                                                   double dt, contacts::FoundPart& part) const {
  const collision::Passage& way_a = passages[pair.a];
  const collision::Passage& way_b = passages[pair.b];
  const std::span<const Shape> parts_a = contacts::parts_of(*way_a.body), parts_b = contacts::parts_of(*way_b.body);
  const auto way_of = [](const collision::Passage& way, std::span<const Shape> parts, std::size_t index) {
    return parts.empty() ? way : collision::passage_of_part(way, parts[index]);
  };
  const auto box_of = [](const collision::Passage& way) { return bounds(*way.course.shape, way.body->motion.pose); };
  // No part moves farther in the step than this.
  const Vec3 closing = way_a.course.linear - way_b.course.linear;
  const Vec3 pull = way_a.course.acceleration - way_b.course.acceleration;
  const double room = contacts::near_enough + (closing.norm() + pull.norm() * dt + way_a.swing + way_b.swing) * dt;
  struct PartWay {
    collision::Passage way;
    Bounds box;
  };
  thread_local std::vector<PartWay> ways_b;
  ways_b.clear();
  const std::size_t count_a = std::max<std::size_t>(1, parts_a.size()),
                    count_b = std::max<std::size_t>(1, parts_b.size());
  ways_b.reserve(count_b);
  for (std::size_t k = 0; k < count_b; ++k) {
    const collision::Passage way = way_of(way_b, parts_b, k);
    ways_b.push_back({way, box_of(way)});
  }
  const std::size_t before = part.contacts.size();
  std::uint32_t next = known.first;
  const std::uint32_t end = known.first + known.count;
  const std::span<const std::uint32_t> sorted = memories.sorted();
  for (std::uint32_t i = 0; i < count_a; ++i) {
    const collision::Passage its_a = way_of(way_a, parts_a, i);
    const Bounds box_a = box_of(its_a);
    for (std::uint32_t k = 0; k < count_b; ++k) {
      const Bounds& box_b = ways_b[k].box;
      if (((box_a.low - box_b.high).array() > room).any() || ((box_b.low - box_a.high).array() > room).any()) continue;
      contacts::PairInContact one = pair;
      one.part_a = i;
      one.part_b = k;
      while (next < end && memories.parts(memories[sorted[next]]) < std::pair(i, k)) ++next;
      if (next < end && memories.parts(memories[sorted[next]]) == std::pair(i, k)) one.memory = sorted[next];
      find_contact(one, its_a, ways_b[k].way, dt, false, part);
    }
  }
  // What freely falls into the parts that it lies on would meet edges that it passes over.
  std::vector<contacts::ContactHead> passed = contacts::drop_contacts_of_seams(part.contacts, before, way_a, way_b, 0);
  if (passed.empty() && !contacts::LyingBody::matters(part.contacts.all().subspan(before))) {
    contacts::drop_contacts_of_seams(part.contacts, before, way_a, way_b, dt);
    return;
  }
  const contacts::LyingBody lying(part.contacts.all().subspan(before), way_a, way_b);
  const bool b_moves = !way_b.body->immovable();
  const auto find_again = [&](contacts::ContactConstraint& contact, const contacts::ContactHead& old, bool behind) {
    contact = {};
    static_cast<contacts::PairInContact&>(contact) = old;
    const collision::Passage its_a = way_of(lying.way_a(), parts_a, old.part_a),
                             its_b = way_of(lying.way_b(), parts_b, old.part_b);
    if (behind)
      contacts::find_behind_seam(contact, its_a, its_b, old.impact_time, dt);
    else if (!find_manifold(contact, *its_a.body, *its_b.body, its_a, its_b, dt, nullptr))
      contact.count = 0;
    if (contact.count > 0 && contact.impact_time > 0 &&
        contacts::in_known_plane(contact, part.contacts.all().subspan(before), b_moves ? way_a : way_b, b_moves,
                                 contacts::near_enough_of(way_a, way_b)))
      contact.count = 0;
    if (contact.count > 0)
      finish_contact(contact, old.memory != state::ContactMemories::nowhere ? &memories[old.memory] : nullptr, dt);
  };
  for (contacts::ContactConstraint& contact : part.contacts.all().subspan(before))
    if (contact.impact_time > 0) find_again(contact, contacts::ContactHead(contact), false);
  for (int i = 0; i < 2; ++i) {
    for (const contacts::ContactHead& old : passed) find_again(part.contacts.add(), old, true);
    contacts::drop_empty(part.contacts, before);
    const auto its_own = part.contacts.all().subspan(before);
    std::sort(its_own.begin(), its_own.end(), [](const auto& a, const auto& b) {
      return std::pair(a.part_a, a.part_b) < std::pair(b.part_a, b.part_b);
    });
    passed = contacts::drop_contacts_of_seams(part.contacts, before, way_a, way_b, dt);
  }
}

void World::Implementation::find_pair_again(const pairs::Pair& pair, double h, contacts::FoundPart& part) const {
  contacts::PairInContact one;
  one.a = pair.first;
  one.b = pair.second;
  const collision::Passage &way_a = passages[one.a], &way_b = passages[one.b];
  if (way_a.simple && way_b.simple)
    find_contact(one, way_a, way_b, h, false, part);
  else if (surfaces::surface_of(way_a.body->shape().solid) || surfaces::surface_of(way_b.body->shape().solid))
    find_contacts_with_surface(one, {}, h, part);
  else
    find_contacts_of_parts(one, {}, h, part);
}

/// Prefetches what the pairs after the i-th will read.
void World::Implementation::fetch_ahead(std::span<const pairs::Pair> pairs,
                                        std::span<const contacts::PairMemories> memories_of, std::size_t i) const {
  constexpr std::size_t far = 8, near = 4;
  const auto memory_of = [&](std::size_t number) -> const state::ContactMemory* {
    return memories_of[number].count > 0 ? &memories[memories.sorted()[memories_of[number].first]] : nullptr;
  };
  if (i + far < pairs.size()) {
    state::fetch(&passages[pairs[i + far].second]);
    if (const state::ContactMemory* memory = memory_of(i + far)) state::fetch(memory);
  }
  if (i + near >= pairs.size()) return;
  if (const state::ContactMemory* memory = memory_of(i + near))
    if (const state::MoreOfContact* more = memories.more(*memory)) state::fetch(more);
}

void World::Implementation::find_part(std::span<const pairs::Pair> pairs,
                                      std::span<const contacts::PairMemories> memories_of, bool crowded, double dt,
                                      contacts::FoundPart& part) {
  part.contacts.clear();
  part.aparts.clear();
  part.followers.clear();
  part.blows.clear();
  auto next_apart = pairs.empty() ? aparts.cend()
                                  : std::lower_bound(aparts.cbegin(), aparts.cend(), pairs.front(),
                                                     [](const contacts::KnownApart& known, const pairs::Pair& pair) {
                                                       return known.pair < pair;
                                                     });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    fetch_ahead(pairs, memories_of, i);
    const auto [index_a, index_b] = pairs[i];
    const collision::Passage& way_a = passages[index_a];
    const collision::Passage& way_b = passages[index_b];
    const bool counts = crowded && in_crowd(pairs[i]);
    if (counts && contact_counts[index_a] >= contacts::most_contacts &&
        contact_counts[index_b] >= contacts::most_contacts)
      continue;
    contacts::PairInContact pair;
    pair.a = index_a;
    pair.b = index_b;
    const std::size_t before = part.contacts.size();
    if (way_a.simple && way_b.simple) {
      while (next_apart != aparts.cend() && next_apart->pair < pairs[i]) ++next_apart;
      if (next_apart != aparts.cend() && next_apart->pair == pairs[i]) {
        const Vec3 direction = next_apart->apart.in_world(way_a, way_b);
        const double gap = collision::gap_along(way_a, way_b, direction);
        if (collision::stay_apart(way_a, way_b, direction, gap, contacts::near_enough_of(way_a, way_b), dt)) {
          part.aparts.push_back(*next_apart);
          if (contacts::may_follow(way_a, way_b, dt) &&
              (!contacts::tell_all(way_a, way_b) || contacts::follow(way_a, way_b, contacts::surely * gap, dt))) {
            if (memories_of[i].count > 0) pair.memory = memories.sorted()[memories_of[i].first];
            part.followers.push_back(
                {contacts::link_of(index_a, way_a, index_b, way_b, direction, gap), pair.memory, false});
          }
          continue;
        }
      }
      if (memories_of[i].count > 0) pair.memory = memories.sorted()[memories_of[i].first];
      find_contact(pair, way_a, way_b, dt, true, part);
    } else if (surfaces::surface_of(way_a.body->shape().solid) || surfaces::surface_of(way_b.body->shape().solid)) {
      find_contacts_with_surface(pair, memories_of[i], dt, part);
    } else {
      find_contacts_of_parts(pair, memories_of[i], dt, part);
    }
    if (part.contacts.size() == before) continue;
    if (contacts::may_strike(way_a, way_b, dt))
      for (const contacts::ContactConstraint& contact : part.contacts.all().subspan(before))
        contacts::note_blow(contact, way_a, way_b, dt, part.blows);
    if (!counts) continue;
    ++contact_counts[index_a];
    ++contact_counts[index_b];
  }
}

void World::Implementation::find_constraints(double dt) {
  active.clear();
  retained.clear();
  memories.tidy();
  const threads::Workers work = workers();
  const std::vector<pairs::Pair>& pairs = broad_phase.find(bodies, watched, loads, {bodies, ignored},
                                                           contacts::near_enough, dt, work, settings.broad_phase);
  const bool crowded = recall(pairs);
  passages.resize(bodies.size());
  work.ranges(looked_for.size(), contacts::worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      passages[looked_for[i]] = collision::passage_of(bodies[looked_for[i]], loads[looked_for[i]], dt);
  });
  const std::span<const pairs::Pair> all = pairs;
  const std::span<const contacts::PairMemories> known = pair_memories;
  const auto find = [&](std::size_t part, std::size_t begin, std::size_t end) {
    find_part(all.subspan(begin, end - begin), known.subspan(begin, end - begin), crowded, dt, found[part]);
  };
  // In a crowd, the contacts of a pair depend on the pairs before it.
  const std::size_t parts =
      crowded ? 1 : std::max<std::size_t>(1, work.range_count(pairs.size(), contacts::worth_a_part));
  found.resize(std::max(parts, found.size()));
  for (std::size_t i = parts; i < found.size(); ++i) found[i].contacts.clear();
  if (crowded) {
    contact_counts.assign(bodies.size(), 0);
    find(0, 0, pairs.size());
  } else if (pairs.empty()) {
    find(0, 0, 0);
  } else {
    work.numbered_ranges(pairs.size(), contacts::worth_a_part, find);
  }
  aparts.clear();
  for (std::size_t i = 0; i < parts; ++i) {
    aparts.insert(aparts.end(), found[i].aparts.begin(), found[i].aparts.end());
    for (contacts::ContactConstraint& contact : found[i].contacts.all()) active.push_back(&contact);
  }
  find_followers(parts, dt);
}

}  // namespace tweenfall
