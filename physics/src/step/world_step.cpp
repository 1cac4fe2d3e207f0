#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/impact_time.h"
#include "forces/drive_law.h"
#include "state/world_data.h"
#include "step/keyed_step.h"

namespace tweenfall {

namespace {

/// Gaps up to this are contacts from the start of the step, m; wider ones only when the bodies meet within it.
constexpr double near_enough = 2e-3;
/// Two bodies that both have so many contacts already get none with each other.
constexpr std::uint32_t most_contacts = 32;

/// The points of a manifold as constraints, told about the bodies' places at the start of the step.
void adopt(ContactConstraint& constraint, const Body& a, const Prediction& at_a, const Body& b,
           const Prediction& at_b) {
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
    if (constraint.impact_time == 0) continue;
    point.start_arm_a = carried(back_a, point.start_arm_a, a.roundness * manifold.normal);
    point.start_arm_b = carried(back_b, point.start_arm_b, -b.roundness * manifold.normal);
    point.start_gap += manifold.normal.dot((b.center + point.start_arm_b) - (a.center + point.start_arm_a));
  }
}

/// Hands the impulses of the step before on: to points of the same features, then to what is left nearby.
void inherit(ContactConstraint& constraint, const ContactMemory& old, double nearby) {
  static_cast<KeptImpulses&>(constraint) = old;
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

void remember(const ContactConstraint& constraint, bool touching, ContactMemory& memory) {
  memory.a = constraint.a;
  memory.b = constraint.b;
  memory.count = constraint.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
    const PointConstraint& point = constraint.points[i];
    memory.points[i] = {point.feature, point.start_arm_b, point.kept_normal, point.kept_friction};
  }
  static_cast<KeptImpulses&>(memory) = constraint;
  memory.touching = touching;
}

template <class A, class B>
bool before(const A& left, const B& right) {
  return left.a != right.a ? left.a < right.a : left.b < right.b;
}

}  // namespace

void World::Implementation::begin_watch() {
  std::erase_if(watched,
                [this](std::uint32_t i) { return !bodies[i].alive || bodies[i].immovable() || bodies[i].noted; });
  const auto known = static_cast<std::ptrdiff_t>(watched.size());
  for (const std::uint32_t i : noted)
    if (bodies[i].alive) watched.push_back(i);
  std::sort(watched.begin() + known, watched.end());
  std::inplace_merge(watched.begin(), watched.begin() + known, watched.end());
  lingering.clear();
  for (const std::uint32_t i : watched)
    if (bodies[i].immovable() && (bodies[i].placed || bodies[i].has_target)) lingering.push_back(i);
}

void World::Implementation::end_watch() {
  for (const std::uint32_t i : noted) bodies[i].noted = false;
  noted.clear();
  for (const std::uint32_t i : lingering) note(i);
}

void World::Implementation::find_constraints(double dt) {
  active.clear();
  retained.clear();
  memories.tidy();
  const std::vector<Pair>& pairs = broad_phase.find(bodies, watched, loads, near_enough, dt);
  contact_counts.assign(bodies.size(), 0);
  const std::span<const std::uint32_t> remembered_before = memories.sorted();
  std::size_t next = 0;
  /// The memory of a pair, if there is one; of those before it, which are near nothing that stirs, all is kept.
  const auto memory_of = [&](const Pair& pair) {
    for (; next < remembered_before.size(); ++next) {
      const ContactMemory& memory = memories[remembered_before[next]];
      const Pair its(memory.a, memory.b);
      if (its > pair) break;
      if (its == pair) return remembered_before[next++];
      if (!bodies[memory.a].stirs() && !bodies[memory.b].stirs()) retained.push_back(remembered_before[next]);
    }
    return ContactMemories::nowhere;
  };
  for (const Pair& pair : pairs) {
    const std::uint32_t memory = memory_of(pair);
    const auto [index_a, index_b] = pair;
    const Body& a = bodies[index_a];
    const Body& b = bodies[index_b];
    const bool crowded = contact_counts[index_a] >= most_contacts && contact_counts[index_b] >= most_contacts;
    if (crowded && !a.immovable() && !b.immovable()) continue;
    ContactConstraint& constraint = active.emplace_back();
    constraint.a = index_a;
    constraint.b = index_b;
    const Course course_a = course_of(a, loads[index_a], dt);
    const Course course_b = course_of(b, loads[index_b], dt);
    const double swing = swing_speed(course_a) + swing_speed(course_b);
    constraint.manifold = collide(a.shape, a.motion.pose, b.shape, b.motion.pose, near_enough);
    if (constraint.manifold.count > 0) {
      if (swing * dt > near_enough)
        constraint.manifold = collide(a.shape, a.motion.pose, b.shape, b.motion.pose, near_enough + swing * dt);
      adopt(constraint, a, {a.center, a.motion.pose.rotation}, b, {b.center, b.motion.pose.rotation});
    } else if (const std::optional<double> meeting = impact_time(course_a, course_b, dt)) {
      const Prediction at_a = course_a.at(*meeting);
      const Prediction at_b = course_b.at(*meeting);
      constraint.impact_time = *meeting;
      // What a spin brings down in what is left of the step, too.
      const double reach = near_enough + swing * (dt - *meeting);
      constraint.manifold = collide(a.shape, at_a.node(a), b.shape, at_b.node(b), reach);
      adopt(constraint, a, at_a, b, at_b);
    }
    if (constraint.count == 0 || !constraint.manifold.normal.allFinite()) {
      active.pop_back();
      continue;
    }
    constraint.friction = std::sqrt(a.friction * b.friction);
    constraint.restitution = std::max(a.restitution, b.restitution);
    constraint.rolling_friction = std::max(a.rolling_friction, b.rolling_friction);
    constraint.memory = memory;
    const bool known = memory != ContactMemories::nowhere;
    constraint.began = !(known && memories[memory].touching);
    if (known) inherit(constraint, memories[memory], 0.05 * std::min(a.radius, b.radius));
    ++contact_counts[index_a];
    ++contact_counts[index_b];
  }
  memory_of({std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max()});
}

void World::Implementation::note_starts() {
  starts.resize(bodies.size());
  for (const std::uint32_t i : watched)
    starts[i] = {bodies[i].center, bodies[i].motion.pose.rotation, bodies[i].twist, bodies[i].led};
}

void World::Implementation::advance_bodies(double dt) {
  moved.assign(bodies.size(), 0);
  solver.begin(bodies.size());
  block_solver.begin(bodies.size());
  for (const IslandContents& island : island_sorter.sort(bodies, islands, active, stiff_springs)) {
    if (blocks::BlockSolver::takes(island, bodies, dt))
      block_solver.solve(bodies, loads, island.contacts, settings, dt, moved);
    else
      solver.solve(bodies, loads, island.contacts, island.springs, settings, dt, moved);
  }
  for (const std::uint32_t i : watched) {
    Body& body = bodies[i];
    body.placed = body.led = false;
    if (body.immovable()) {
      arrive(body);
      continue;
    }
    if (!body.asleep && !moved[i]) {
      if (body.drive.owner() == Owner::driven)
        pull(body, loads[i], dt);
      else
        fly(body, loads[i], settings.integrator, dt);
    }
    body.force = Vec3::Zero();
    body.torque = Vec3::Zero();
    if (body.drive.owner() == Owner::driven) body.target.twist = {};
    body.has_target = false;
  }
}

void World::Implementation::report() {
  remembered.clear();
  next_contacts.clear();
  // Between bodies at rest all is as it was, but nothing has begun there.
  std::size_t next_retained = 0, next_contact = 0;
  const auto keep_before = [&](const auto& pair) {
    for (; next_retained < retained.size() && before(memories[retained[next_retained]], pair); ++next_retained) {
      const ContactMemory& memory = memories[retained[next_retained]];
      remembered.push_back(retained[next_retained]);
      if (!memory.touching) continue;
      while (contacts[next_contact].a.index != memory.a || contacts[next_contact].b.index != memory.b) ++next_contact;
      next_contacts.push_back(contacts[next_contact]);
      next_contacts.back().began = false;
    }
  };
  for (const ContactConstraint& constraint : active) {
    double normal = 0;
    Vec3 total = Vec3::Zero();
    double approach = 0;
    bool overlap = false;
    for (int i = 0; i < constraint.count; ++i) {
      const PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      normal += point.total_normal;
      total += point.total_normal * constraint.manifold.normal + point.total_friction;
      approach = std::max(approach, point.approach);
      overlap = overlap || point.start_gap <= 0;
    }
    const bool touching = normal > 0 || overlap;
    if (bodies[constraint.a].immovable()) bodies[constraint.a].reaction -= total;
    if (bodies[constraint.b].immovable()) bodies[constraint.b].reaction += total;
    keep_before(constraint);
    const bool known = constraint.memory != ContactMemories::nowhere;
    const std::uint32_t place = known ? constraint.memory : memories.take();
    remember(constraint, touching, memories[place]);
    remembered.push_back(place);
    if (touching)
      next_contacts.push_back({{constraint.a, bodies[constraint.a].generation},
                               {constraint.b, bodies[constraint.b].generation},
                               constraint.manifold,
                               normal,
                               total,
                               approach,
                               constraint.began});
  }
  constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  ContactMemory end;
  end.a = end.b = last;
  keep_before(end);
  memories.keep(remembered);
  std::swap(contacts, next_contacts);
}

void World::Implementation::step(double dt) {
  struct Stepping {
    bool& flag;
    ~Stepping() { flag = false; }
  } const guard{stepping};
  stepping = true;
  begin_watch();
  check_bodies(0, time);
  wake_by_fields();
  do {
    gather_loads(bodies, watched, forces, settings, time, dt, loads, stiff_springs);
    check_loads(time + dt);
    find_constraints(dt);
  } while (wake_islands());
  note_starts();
  advance_bodies(dt);
  let_sleep(dt);
  report();
  end_watch();
  time += dt;
  check_bodies(dt, time);
}

}  // namespace tweenfall
