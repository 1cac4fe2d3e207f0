#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "collision/impact_time.h"
#include "contacts/found_manifold.h"
#include "forces/drive_law.h"
#include "state/world_data.h"
#include "step/keyed_step.h"

namespace tweenfall {

namespace step {
namespace {

/// Bodies, or contacts, that are worth more than one thread.
constexpr std::size_t worth_sharing = 128;
/// Contacts of islands that are solved together, and a part of their joints: more of them would not stay in a
/// processor's nearest memory.
constexpr std::size_t worth_a_batch = 256;
/// Contacts of an island that are worth dividing it.
constexpr std::size_t worth_dividing = 256;

void remember(const contacts::ContactConstraint& constraint, bool touching, state::ContactMemory& memory) {
  memory.a = constraint.a;
  memory.b = constraint.b;
  memory.part_a = constraint.part_a;
  memory.part_b = constraint.part_b;
  memory.count = constraint.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
    const contacts::PointConstraint& point = constraint.points[i];
    memory.point(i) = {point.feature, point.start_arm_b, point.kept_normal, point.kept_friction};
  }
  memory.kept = constraint;
  memory.touching = touching;
}

template <class A, class B>
bool before(const A& left, const B& right) {
  return std::tie(left.a, left.b, left.part_a, left.part_b) < std::tie(right.a, right.b, right.part_a, right.part_b);
}

}  // namespace
}  // namespace step

void step::Workspace::note(std::uint32_t body) {
  if (fresh) return;
  if (body >= is_noted.size()) is_noted.resize(body + std::size_t{1}, 0);
  if (is_noted[body] != 0) return;
  is_noted[body] = 1;
  noted.push_back(body);
}

void World::Implementation::begin_watch() {
  sleepers.clear();
  lingering.clear();
  starts.resize(bodies.size());
  is_noted.resize(bodies.size(), 0);
  if (fresh) {
    noted.clear();
    watched.clear();
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      is_noted[i] = 1;
      noted.push_back(i);
    }
  }
  const auto watch = [this](std::uint32_t i) {
    const state::Body& body = bodies[i];
    starts[i] = {body.center, body.motion.pose.rotation, body.twist, body.led};
    if (body.asleep) sleepers.push_back(i);
    if (body.immovable() && (body.placed || body.has_target)) lingering.push_back(i);
  };
  std::erase_if(watched, [&](std::uint32_t i) {
    if (!bodies[i].alive || bodies[i].immovable() || is_noted[i] != 0) return true;
    watch(i);
    return false;
  });
  const auto known = static_cast<std::ptrdiff_t>(watched.size());
  for (const std::uint32_t i : noted) {
    if (!bodies[i].alive) continue;
    watch(i);
    watched.push_back(i);
  }
  std::sort(watched.begin() + known, watched.end());
  std::inplace_merge(watched.begin(), watched.begin() + known, watched.end());
}

void World::Implementation::end_watch() {
  for (const std::uint32_t i : noted) is_noted[i] = 0;
  noted.clear();
  fresh = false;
  for (const std::uint32_t i : lingering) note(i);
}

step::Batch& step::Solvers::put_by(const islands::IslandContents& island, const blocks::BlockSolver::Effort& effort) {
  auto batch = std::find_if(batches.begin(), batches.end(), [&](const Batch& one) { return one.effort == effort; });
  if (batch == batches.end()) {
    batches.emplace_back().effort = effort;
    batch = batches.end() - 1;
  }
  batch->islands.push_back(island);
  batch->size += island.contacts.size() + island.joints.size() / 4;
  return *batch;
}

void step::Solvers::solve(Batch& batch, std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
                          const WorldSettings& settings, double dt, std::vector<char>& moved) {
  if (!batch.islands.empty()) many.solve(bodies, loads, batch.islands, batch.effort, settings, dt, moved);
  batch.islands.clear();
  batch.size = 0;
}

void World::Implementation::solve_islands(double dt) {
  moved.assign(bodies.size(), 0);
  complementarity = 0;
  leave_sleeping_links();
  const std::vector<islands::IslandContents>& all = island_sorter.sort(bodies, islands, active, stiff_springs, links);
  if (all.empty()) return;
  const threads::Workers work = workers();
  const std::size_t shares =
      active.size() + 4 * links.size() < step::worth_sharing ? 1 : std::min(work.threads(), all.size());
  if (solvers.size() < shares) solvers.resize(shares);
  for (std::size_t i = 0; i < shares; ++i) {
    solvers[i].few.begin(bodies.size(), part_count);
    solvers[i].many.begin(bodies.size(), part_count);
    solvers[i].complementarity = 0;
  }
  // The biggest first, so that no thread is left with one at the end; the very big ones by all threads together.
  const auto size_of = [&](std::uint32_t island) {
    const islands::IslandContents& contents = all[island];
    return contents.contacts.size() + contents.springs.size() + 4 * contents.joints.size();
  };
  islands_by_size.resize(all.size());
  std::iota(islands_by_size.begin(), islands_by_size.end(), std::uint32_t{0});
  if (work.threads() > 1)
    std::stable_sort(islands_by_size.begin(), islands_by_size.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return size_of(a) > size_of(b); });
  const auto solve = [&](std::size_t island, step::Solvers& by, const threads::Workers& within) {
    const islands::IslandContents& contents = all[islands_by_size[island]];
    if (goes_by_strategies(contents)) {
      by.complementarity = std::max(by.complementarity, solve_by_strategies(contents, dt, by.strategies));
      return;
    }
    if (const int pieces = pieces_of(contents, dt); pieces > 1) {
      solve_in_pieces(contents, pieces, dt, by.few);
      return;
    }
    if (hands_on_blows(contents, dt)) {
      solve_by_blows(contents, dt, by.few);
      return;
    }
    const std::optional<blocks::BlockSolver::Effort> effort =
        by.many.effort_for(contents, bodies, loads, settings, dt, within);
    if (!effort)
      by.few.solve(bodies, loads, contents.contacts, contents.springs, settings, dt, moved);
    else if (effort->alone)
      by.many.solve(bodies, loads, std::span(&contents, 1), *effort, settings, dt, moved, within);
    else if (step::Batch& batch = by.put_by(contents, *effort); batch.size >= step::worth_a_batch)
      by.solve(batch, bodies, loads, settings, dt, moved);
  };
  std::size_t divided = 0;
  if (work.threads() > 1)
    while (divided < all.size() && all[islands_by_size[divided]].contacts.size() >= step::worth_dividing)
      solve(divided++, solvers[0], work);
  std::atomic<std::size_t> next{divided};
  work.parts(shares, [&](std::size_t share) {
    for (std::size_t i = next.fetch_add(1); i < all.size(); i = next.fetch_add(1)) solve(i, solvers[share], {});
    for (step::Batch& batch : solvers[share].batches) solvers[share].solve(batch, bodies, loads, settings, dt, moved);
  });
  free_islands.begin(bodies.size());
  const auto start_of = [this](std::uint32_t index) -> islands::FreeStart {
    const step::Start& start = starts[index];
    return {start.center, start.rotation, start.twist};
  };
  for (const islands::IslandContents& island : all)
    if (!goes_by_strategies(island)) free_islands.keep(island, bodies, loads, moved, settings.integrator, dt, start_of);
  for (std::size_t i = 0; i < shares; ++i) complementarity = std::max(complementarity, solvers[i].complementarity);
}

void World::Implementation::advance_bodies(double dt) {
  if (goes_by_impacts())
    solve_by_impacts(dt);
  else
    solve_islands(dt);
  const bool asks = forces::asking(settings.integrator) != nullptr;
  workers().ranges(watched.size(), step::worth_sharing, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = watched[k];
      state::Body& body = bodies[i];
      body.placed = body.led = false;
      if (body.immovable()) {
        step::arrive(body);
        continue;
      }
      if (!body.asleep && !moved[i]) {
        if (body.drive.owner() == Owner::driven)
          forces::pull(body, loads[i], dt);
        else if (asks)
          flight.land(i, body, dt);
        else
          forces::fly(body, loads[i], settings.integrator, dt);
      }
      body.force = Vec3::Zero();
      body.torque = Vec3::Zero();
      if (body.drive.owner() == Owner::driven) body.target().twist = {};
      body.has_target = false;
    }
  });
}

void World::Implementation::remember_contacts() {
  outcomes.resize(active.size());
  const auto keep = [this](const contacts::ContactConstraint& constraint, const step::Outcome& outcome) {
    state::ContactMemory& memory = memories[outcome.place];
    step::remember(constraint, outcome.touching, memory);
    if (constraint.memory == state::ContactMemories::nowhere || constraint.kept) return;
    if (constraint.impact_time == 0 && contacts::keeps_manifold(constraint))
      memory.more.own().found = contacts::found_manifold(constraint, starts[constraint.a], starts[constraint.b]);
    else if (memory.found().holds)
      memory.more.own().found = {};
  };
  workers().ranges(active.size(), step::worth_sharing, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      constexpr std::size_t far = 8, near = 4;
      if (k + far < end) {
        const std::uint32_t place = active[k + far]->memory;
        if (place != state::ContactMemories::nowhere) state::fetch(&memories[place]);
      }
      if (k + near < end) {
        const std::uint32_t place = active[k + near]->memory;
        if (place != state::ContactMemories::nowhere) memories[place].more.fetch();
      }
      const contacts::ContactConstraint& constraint = *active[k];
      step::Outcome& outcome = outcomes[k];
      double normal = 0;
      Vec3 total = Vec3::Zero();
      double approach = 0;
      bool overlap = false;
      for (int i = 0; i < constraint.count; ++i) {
        const contacts::PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
        normal += point.total_normal;
        total += point.total_normal * constraint.manifold.normal + point.total_friction;
        approach = std::max(approach, point.approach);
        overlap = overlap || point.start_gap <= 0;
      }
      outcome.normal = normal;
      outcome.total = total;
      outcome.approach = approach;
      outcome.touching = normal > 0 || overlap;
      outcome.borne = bodies[constraint.a].immovable() || bodies[constraint.b].immovable();
      outcome.place = constraint.memory;
      if (constraint.memory != state::ContactMemories::nowhere) keep(constraint, outcome);
    }
  });
  for (std::size_t k = 0; k < active.size(); ++k) {
    if (outcomes[k].place != state::ContactMemories::nowhere) continue;
    outcomes[k].place = memories.take();
    keep(*active[k], outcomes[k]);
  }
}

void World::Implementation::report() {
  remember_contacts();
  remembered.clear();
  told.clear();
  std::size_t next_retained = 0;
  std::uint32_t next_contact = 0;
  const auto keep_before = [&](const auto& pair) {
    for (; next_retained < retained.size() && step::before(memories[retained[next_retained]], pair); ++next_retained) {
      const state::ContactMemory& memory = memories[retained[next_retained]];
      remembered.push_back(retained[next_retained]);
      if (!memory.touching) continue;
      const auto is_its = [&memory](const Contact& contact) {
        return contact.a.index == memory.a && contact.b.index == memory.b && contact.part_a == memory.part_a &&
               contact.part_b == memory.part_b;
      };
      while (!is_its(contacts[next_contact])) ++next_contact;
      told.push_back({next_contact, false});
    }
  };
  for (std::uint32_t i = 0; i < active.size(); ++i) {
    const step::Outcome& outcome = outcomes[i];
    if (outcome.borne) {
      state::Body &a = bodies[active[i]->a], &b = bodies[active[i]->b];
      if (a.immovable()) a.extra.own().reaction -= outcome.total;
      if (b.immovable()) b.extra.own().reaction += outcome.total;
    }
    if (next_retained < retained.size()) keep_before(*active[i]);
    remembered.push_back(outcome.place);
    if (outcome.touching) told.push_back({i, true});
  }
  constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  state::ContactMemory end;
  end.a = end.b = last;
  keep_before(end);
  memories.keep(remembered);
  next_contacts.resize(told.size());
  workers().ranges(told.size(), step::worth_sharing, [&](std::size_t first, std::size_t behind) {
    for (std::size_t i = first; i < behind; ++i) {
      Contact& contact = next_contacts[i];
      if (!told[i].active) {
        // Between bodies at rest all is as it was, but nothing has begun there.
        contact = contacts[told[i].number];
        contact.began = false;
        continue;
      }
      const contacts::ContactConstraint& constraint = *active[told[i].number];
      const step::Outcome& outcome = outcomes[told[i].number];
      contact = {{constraint.a, bodies[constraint.a].generation},
                 {constraint.b, bodies[constraint.b].generation},
                 constraint.manifold,
                 outcome.normal,
                 outcome.total,
                 outcome.approach,
                 constraint.began,
                 constraint.part_a,
                 constraint.part_b};
    }
  });
  std::swap(contacts, next_contacts);
  tell_ended();
}

/// Both lists of contacts are by pair; bodies that left meanwhile took theirs along.
void World::Implementation::tell_ended() {
  ended.clear();
  std::swap(ended, gone_contacts);
  const threads::Workers work = workers();
  const auto pair_of = [](const Contact& contact) { return pairs::Pair(contact.a.index, contact.b.index); };
  const std::vector<Contact>& before = next_contacts;
  ended_parts.resize(std::max(ended_parts.size(), work.range_count(before.size(), step::worth_sharing)));
  for (std::vector<EndedContact>& part : ended_parts) part.clear();
  work.numbered_ranges(before.size(), step::worth_sharing, [&](std::size_t part, std::size_t first, std::size_t end) {
    auto still = std::lower_bound(contacts.cbegin(), contacts.cend(), pair_of(before[first]),
                                  [&](const Contact& one, const pairs::Pair& pair) { return pair_of(one) < pair; });
    for (std::size_t i = first; i < end; ++i) {
      const pairs::Pair pair = pair_of(before[i]);
      // Of several parts that touched, all have let go.
      if (i > 0 && pair_of(before[i - 1]) == pair) continue;
      while (still != contacts.cend() && pair_of(*still) < pair) ++still;
      if (still != contacts.cend() && pair_of(*still) == pair) continue;
      ended_parts[part].push_back({before[i].a, before[i].b});
    }
  });
  for (const std::vector<EndedContact>& part : ended_parts) ended.insert(ended.end(), part.begin(), part.end());
}

void World::Implementation::step(double dt, double of_parts) {
  struct Stepping {
    bool& flag;
    queries::LazyScene& scene;
    ~Stepping() {
      flag = false;
      scene.forget();
    }
  } const guard{stepping, scene};
  stepping = true;
  part_count = of_parts;
  begin_watch();
  if (failed) check_bodies(0, time);
  if (flat.has_value()) {
    wake_by_forces(dt);
    failed = true;
    step_in_plane(dt);
    end_watch();
    time += dt;
    if (failed) check_bodies(dt, time);
    return;
  }
  wake_by_forces(dt);
  do {
    forces::gather_loads(bodies, watched, forces, settings, time, dt, workers(), loads, stiff_springs, flight);
    check_loads(time + dt);
    gather_links();
    find_constraints(dt);
  } while (wake_islands());
  failed = true;
  note_soft_starts();
  advance_bodies(dt);
  if (!strategies::chosen(settings)) {
    find_obstacles();
    hold_before_surfaces();
    hold_before_walls(dt);
  }
  advance_softs(dt);
  let_sleep(dt);
  report();
  sense();
  end_links(dt);
  end_watch();
  time += dt;
  if (failed) check_bodies(dt, time);
  check_softs();
}

}  // namespace tweenfall
