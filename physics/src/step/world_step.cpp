#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "collision/impact_time.h"
#include "contacts/found_manifold.h"
#include "forces/drive_law.h"
#include "islands/jointed_energy.h"
#include "islands/pinched.h"
#include "islands/squeezed.h"
#include "state/world_data.h"
#include "step/keyed_step.h"

namespace tweenfall {

namespace step {
namespace {

/// Number of bodies, or contacts, that are worth more than one thread.
constexpr std::size_t worth_sharing = 128;
/// Number of contacts, plus a share of joints, of islands that are solved together: more would not fit into a
/// processor's nearest cache. Towards the end of what several threads share it is fewer, so that they end together.
constexpr std::size_t worth_a_batch = 256, fewest_in_a_batch = 64;
/// Number of contacts that make an island worth dividing.
constexpr std::size_t worth_dividing = 256;

/// Whether the points of a contact were found for the positions of the bodies at the start of the step.
bool found_at_start(const contacts::ContactConstraint& constraint, const Start& b) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i)
    if (constraint.manifold.points[i].position - b.center != constraint.points[i].start_arm_b) return false;
  return true;
}

/// Whether more must be remembered of it than of a single round point.
bool needs_more(const contacts::ContactConstraint& constraint, const Outcome& outcome) {
  return constraint.count > 1 || constraint.kept_twist != 0 || outcome.holds;
}
bool needs_rare(const contacts::ContactConstraint& constraint, const Outcome& outcome) {
  return constraint.part_a != 0 || constraint.part_b != 0 || constraint.kept_spin != 0 || constraint.passed_over != 0 ||
         constraint.kept_rolling != Vec3::Zero() || outcome.elsewhere;
}

/// `memories` must have room for all of it.
void remember(const contacts::ContactConstraint& constraint, const Outcome& outcome, const Start& a, const Start& b,
              state::ContactMemories& memories) {
  using state::ContactMemory;
  ContactMemory& memory = memories[outcome.place];
  memory.a = constraint.a;
  memory.b = constraint.b;
  memory.count = static_cast<std::uint8_t>(constraint.count);
  memory.mark(ContactMemory::touching, outcome.touching);
  memory.mark(ContactMemory::began, constraint.began);
  memory.mark(ContactMemory::slid, constraint.slid);
  memory.mark(ContactMemory::taken_up, constraint.kept);
  memory.mark(ContactMemory::within, constraint.within);
  memory.kept_step = constraint.kept_step;
  memory.impulse = outcome.normal;
  memory.approach = outcome.approach;
  memory.total_impulse = outcome.total;
  // -0 becomes 0, so that it does not matter whether there is room for a value that is zero.
  state::MoreOfContact* more = memories.more(memory);
  if (more) more->kept_twist = constraint.kept_twist + 0.0;
  state::RareOfContact* rare = memories.rare(memory);
  if (rare) {
    rare->part_a = constraint.part_a;
    rare->part_b = constraint.part_b;
    rare->kept_spin = constraint.kept_spin + 0.0;
    rare->kept_rolling = constraint.kept_rolling + Vec3::Zero();
    rare->passed_over = constraint.passed_over;
    rare->has_arms = outcome.elsewhere;
  }
  const auto count = static_cast<std::size_t>(constraint.count);
  for (std::size_t i = 0; i < count; ++i) {
    state::PointMemory& point = memories.point(memory, i);
    point.kept_normal = constraint.points[i].kept_normal;
    point.kept_friction = constraint.points[i].kept_friction;
  }
  // A manifold that was used again stays as it was found.
  if (constraint.kept) return;
  memory.mark(ContactMemory::holds, outcome.holds);
  memory.normal = constraint.manifold.normal;
  for (std::size_t i = 0; i < count; ++i) {
    const ContactPoint& found = constraint.manifold.points[i];
    state::PointMemory& point = memories.point(memory, i);
    point.position = found.position;
    point.penetration = found.penetration;
    (i == 0 ? memory.feature : more->features[i - 1]) = found.feature;
    if (rare && outcome.elsewhere) rare->arms_b[i] = constraint.points[i].start_arm_b;
  }
  if (!outcome.holds) return;
  more->a = {a.center, a.rotation};
  more->b = {b.center, b.rotation};
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
    state::Body& body = bodies[i];
    body.squeezed = false;
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

namespace step {
namespace {

/// How much an island adds to a batch.
std::size_t batch_size_of(const islands::IslandContents& island) {
  return island.contacts.size() + island.joints.size() / 4;
}

}  // namespace
}  // namespace step

step::Batch& step::Solvers::put_by(const islands::IslandContents& island, const blocks::BlockSolver::Effort& effort) {
  auto batch = std::find_if(batches.begin(), batches.end(), [&](const Batch& one) { return one.effort == effort; });
  if (batch == batches.end()) {
    batches.emplace_back().effort = effort;
    batch = batches.end() - 1;
  }
  batch->islands.push_back(island);
  batch->size += batch_size_of(island);
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
  const threads::Workers work = workers();
  const std::vector<islands::IslandContents>& all =
      island_sorter.sort(bodies, islands, active, stiff_springs, links, work);
  if (all.empty()) return;
  mirrored_islands->find(all, bodies, loads, dt);
  const std::size_t shares =
      active.size() + 4 * links.size() < step::worth_sharing ? 1 : std::min(work.threads(), all.size());
  if (solvers.size() < shares) solvers.resize(shares);
  for (std::size_t i = 0; i < shares; ++i) {
    solvers[i].few.begin(bodies.size(), part_count);
    solvers[i].many.begin(bodies.size(), part_count);
    solvers[i].alone.begin(bodies.size(), part_count);
    solvers[i].complementarity = 0;
  }
  // Largest first, so that no thread ends with a large one; all threads share the very large ones.
  const auto size_of = [&](std::uint32_t island) {
    const islands::IslandContents& contents = all[island];
    return contents.contacts.size() + contents.springs.size() + 4 * contents.joints.size();
  };
  islands_by_size.resize(all.size());
  std::iota(islands_by_size.begin(), islands_by_size.end(), std::uint32_t{0});
  if (work.threads() > 1)
    std::sort(islands_by_size.begin(), islands_by_size.end(), [&](std::uint32_t a, std::uint32_t b) {
      const std::size_t of_a = size_of(a), of_b = size_of(b);
      return of_a != of_b ? of_a > of_b : a < b;
    });
  const bool led =
      std::any_of(lingering.begin(), lingering.end(), [this](std::uint32_t i) { return bodies[i].displaces(); });
  const auto tame = [&](const islands::IslandContents& contents) {
    islands::tame_pinched(contents, bodies, loads, settings, dt,
                          [this](std::uint32_t i) -> const Twist& { return starts[i].twist; });
  };
  // As batches count it.
  std::atomic<std::ptrdiff_t> left{static_cast<std::ptrdiff_t>(active.size() + links.size() / 4)};
  const auto enough = [&] {
    const auto its_share = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, left.load())) / (2 * shares);
    return shares == 1 ? step::worth_a_batch : std::clamp(its_share, step::fewest_in_a_batch, step::worth_a_batch);
  };
  const auto solve = [&](std::size_t island, step::Solvers& by, const threads::Workers& within) {
    const islands::IslandContents& contents = all[islands_by_size[island]];
    left.fetch_sub(static_cast<std::ptrdiff_t>(step::batch_size_of(contents)));
    if (goes_by_strategies(contents)) {
      by.complementarity = std::max(by.complementarity, solve_by_strategies(contents, dt, by.strategies));
      return;
    }
    if (by.sprung.takes(contents, bodies, settings.integrator, dt)) {
      by.sprung.solve(bodies, loads, dt, moved);
      return;
    }
    if (const int pieces = pieces_of(contents, dt); pieces > 1) {
      solve_in_pieces(contents, pieces, dt, by.few);
      return;
    }
    if (hands_on_blows(contents, dt)) {
      solve_by_blows(contents, dt, by);
      return;
    }
    const std::optional<blocks::BlockSolver::Effort> effort =
        by.many.effort_for(contents, bodies, loads, settings, dt, within);
    if (!effort) {
      by.few.solve(bodies, loads, contents.contacts, contents.springs, settings, dt, moved);
      tame(contents);
    } else if (effort->alone) {
      by.alone.solve(bodies, loads, std::span(&contents, 1), *effort, settings, dt, moved, within);
      if (led) tame(contents);
    } else if (step::Batch& batch = by.put_by(contents, *effort); batch.size >= enough()) {
      by.solve(batch, bodies, loads, settings, dt, moved);
    }
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
  take_again_where_sunk(all, shares, dt);
  // Without bodies that may be led there is nothing that squeezes.
  if (!lingering.empty())
    for (const islands::IslandContents& island : all)
      islands::bound_squeezed(island, bodies, loads, settings.push_out_speed, dt,
                              [this](std::uint32_t i) -> const Twist& { return starts[i].twist; });
  if (goes_by_strategies()) {
    by_strategies.assign(bodies.size(), 0);
    for (const islands::IslandContents& island : all)
      if (goes_by_strategies(island))
        for (const contacts::ContactConstraint* contact : island.contacts)
          by_strategies[contact->a] = by_strategies[contact->b] = 1;
  }
  free_islands.begin(bodies.size());
  const auto start_of = [this](std::uint32_t index) { return free_start(index); };
  for (const islands::IslandContents& island : all)
    if (!goes_by_strategies(island)) free_islands.keep(island, bodies, loads, moved, settings.integrator, dt, start_of);
  for (const islands::IslandContents& island : all)
    if (!goes_by_strategies(island)) islands::bound_jointed(island, bodies, loads, moved, dt, start_of);
  if (std::any_of(solvers.begin(), solvers.begin() + static_cast<std::ptrdiff_t>(shares),
                  [](const step::Solvers& one) { return one.many.shifts(); }))
    for (const islands::IslandContents& island : all)
      shifted_apart.shift(island.contacts, bodies, settings.push_out_speed * dt);
  for (std::size_t i = 0; i < shares; ++i) complementarity = std::max(complementarity, solvers[i].complementarity);
}

void World::Implementation::advance_bodies(double dt) {
  by_strategies.clear();
  if (!mirrored_islands) mirrored_islands = std::make_unique<islands::MirroredIslands>();
  mirrored_islands->begin(bodies.size());
  if (goes_by_impacts())
    solve_by_impacts(dt);
  else
    solve_islands(dt);
  const bool asks = forces::asking(settings.integrator) != nullptr;
  stands.resize(bodies.size());
  workers().ranges(watched.size(), step::worth_sharing, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = watched[k];
      state::Body& body = bodies[i];
      if (!body.asleep) stands[i] = {starts[i].center, starts[i].rotation};
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
      body.clear_work();
      if (body.drive.owner() == Owner::driven) body.target().twist = {};
      body.has_target = false;
    }
  });
}

/// Fills in the results of the active contacts, and the memories of those that are already known.
void World::Implementation::remember_contacts() {
  outcomes.resize(active.size());
  const auto remember = [this](std::size_t k) {
    const contacts::ContactConstraint& constraint = *active[k];
    step::remember(constraint, outcomes[k], starts[constraint.a], starts[constraint.b], memories);
  };
  workers().ranges(active.size(), step::worth_sharing, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      constexpr std::size_t far = 8, near = 4;
      if (k + far < end) {
        const std::uint32_t place = active[k + far]->memory;
        if (place != state::nowhere) state::fetch(&memories[place]);
      }
      if (k + near < end) {
        const std::uint32_t place = active[k + near]->memory;
        if (place != state::nowhere)
          if (const state::MoreOfContact* more = memories.more(memories[place])) state::fetch(more);
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
      const bool known = constraint.memory != state::nowhere;
      outcome.touched = known && memories[outcome.place].is(state::ContactMemory::touching);
      outcome.holds = known && !constraint.kept && constraint.impact_time == 0 && contacts::keeps_manifold(constraint);
      outcome.elsewhere = !constraint.kept && !step::found_at_start(constraint, starts[constraint.b]);
      outcome.remembered = known &&
                           (memories.more(memories[outcome.place]) || !step::needs_more(constraint, outcome)) &&
                           (memories.rare(memories[outcome.place]) || !step::needs_rare(constraint, outcome));
      if (outcome.remembered) remember(k);
    }
  });
  for (std::size_t k = 0; k < active.size(); ++k) {
    step::Outcome& outcome = outcomes[k];
    if (outcome.remembered) continue;
    if (outcome.place == state::nowhere) outcome.place = memories.take();
    if (step::needs_more(*active[k], outcome)) memories.own_more(memories[outcome.place]);
    if (step::needs_rare(*active[k], outcome)) memories.own_rare(memories[outcome.place]);
    remember(k);
  }
}

void World::Implementation::report() {
  remember_contacts();
  remembered.clear();
  parted.clear();
  std::size_t next_retained = 0;
  const auto pair_of = [](const auto& of) { return pairs::Pair(of.a, of.b); };
  // Between bodies at rest nothing changes, and nothing has begun there.
  const auto keep_before = [&](const pairs::Pair& pair) {
    for (; next_retained < retained.size(); ++next_retained) {
      state::ContactMemory& memory = memories[retained[next_retained]];
      if (!(pair_of(memory) < pair)) return;
      memory.mark(state::ContactMemory::began, false);
      remembered.push_back(retained[next_retained]);
    }
  };
  for (std::uint32_t i = 0; i < active.size(); ++i) {
    const step::Outcome& outcome = outcomes[i];
    if (outcome.borne) {
      state::Body &a = bodies[active[i]->a], &b = bodies[active[i]->b];
      if (a.immovable()) a.extra.own().reaction -= outcome.total;
      if (b.immovable()) b.extra.own().reaction += outcome.total;
    }
    if (next_retained < retained.size()) keep_before(pair_of(*active[i]));
    remembered.push_back(outcome.place);
    if (outcome.touched && !outcome.touching) parted.push_back(pair_of(*active[i]));
  }
  constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  keep_before({last, last});
  memories.keep(remembered, [&](const state::ContactMemory& memory) {
    if (memory.is(state::ContactMemory::touching)) parted.push_back(pair_of(memory));
  });
  tell_ended();
}

/// Contacts of bodies that were removed went with them.
void World::Implementation::tell_ended() {
  ended.clear();
  std::swap(ended, gone_contacts);
  std::sort(parted.begin(), parted.end());
  parted.erase(std::unique(parted.begin(), parted.end()), parted.end());
  const auto pair_of = [](const contacts::ContactConstraint* contact) { return pairs::Pair(contact->a, contact->b); };
  for (const pairs::Pair& pair : parted) {
    // If several parts touched, all of them must have separated.
    auto its = std::lower_bound(active.cbegin(), active.cend(), pair,
                                [&](const auto* contact, const pairs::Pair& than) { return pair_of(contact) < than; });
    bool touching = false;
    for (; its != active.cend() && pair_of(*its) == pair; ++its)
      touching = touching || outcomes[static_cast<std::size_t>(its - active.cbegin())].touching;
    if (touching) continue;
    const auto [a, b] = pair;
    ended.push_back({{a, bodies[a].generation}, {b, bodies[b].generation}});
  }
}

/// Assembles what the caller sees of the contacts of the last step.
void World::Implementation::tell_contacts(std::vector<Contact>& all) const {
  all.clear();
  for (const std::uint32_t place : memories.sorted()) {
    const state::ContactMemory& memory = memories[place];
    if (!memory.is(state::ContactMemory::touching) || memory.is(state::ContactMemory::gone)) continue;
    const auto [part_a, part_b] = memories.parts(memory);
    all.push_back({{memory.a, bodies[memory.a].generation},
                   {memory.b, bodies[memory.b].generation},
                   contacts::manifold_of(memories, memory, stands[memory.a], stands[memory.b]),
                   memory.impulse,
                   memory.total_impulse,
                   memory.approach,
                   memory.is(state::ContactMemory::began),
                   part_a,
                   part_b});
  }
}

void World::Implementation::step(double dt, double of_parts) {
  struct Stepping {
    Implementation& world;
    ~Stepping() {
      if (world.mirrored_islands) world.mirrored_islands->end(world.bodies);
      world.stepping = false;
      world.scene.forget();
      world.told.forget();
    }
  } const guard{*this};
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
    check_softs();
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
  mirrored_islands->keep(bodies, [this](std::uint32_t index) { return free_start(index); });
  mirrored_islands->end(bodies);
  advance_softs(dt, dt * part_count);
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
