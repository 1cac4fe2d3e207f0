#pragma once

#include <tweenfall/physics/world.h>

#include <vector>

#include "blocks/block_solver.h"
#include "collision/passage.h"
#include "forces/forces.h"
#include "islands/island_contents.h"
#include "pairs/broad_phase.h"
#include "state/body.h"
#include "state/contact_memories.h"
#include "state/ignored_pairs.h"
#include "step/contact_constraint.h"
#include "step/solver.h"

namespace tweenfall {

namespace state {

/// A body at the start of a step.
struct Start {
  Vec3 center;
  Quat rotation;
  Twist twist;
  bool led = false;  ///< by a drive whose target moves
};

}  // namespace state

struct World::Implementation {
  WorldSettings settings;
  std::vector<state::Body> bodies;
  std::vector<std::uint32_t> unused;  ///< indices of removed bodies
  std::vector<forces::NumberedForce> forces;
  std::size_t next_force = 0;
  double time = 0;
  bool stepping = false;            ///< a field may be running: nothing may change
  bool failed = false;              ///< the last step left a body that is not finite
  state::ContactMemories memories;  ///< of the last step
  state::IgnoredPairs ignored;
  std::vector<Contact> contacts;     ///< of those that touch, what the caller sees
  std::vector<std::uint32_t> noted;  ///< bodies that the caller changed or led, and those that had been

  // Room for work, kept between steps
  std::vector<forces::Load> loads;
  std::vector<step::SpringRow> stiff_springs;
  std::vector<state::Start> starts;
  std::vector<std::uint32_t> watched;    ///< sorted: what a step looks at, all but scenery at rest
  std::vector<std::uint32_t> sleepers;   ///< of them
  std::vector<std::uint32_t> drowsy;     ///< still for long enough themselves
  std::vector<std::uint32_t> lingering;  ///< to be looked at once more, when it has come to rest
  pairs::BroadPhase broad_phase;
  std::vector<step::ContactConstraint> active;  ///< near something that stirs
  std::vector<std::uint32_t> retained;          ///< memories of contacts between bodies at rest, by pair
  std::vector<std::uint32_t> remembered;
  std::vector<Contact> next_contacts;
  std::vector<collision::Passage> passages;  ///< by body
  std::vector<std::uint64_t> looked_at;      ///< by body: the look that its passage is of
  std::uint64_t look = 0;
  std::vector<std::pair<pairs::Pair, collision::Apart>> aparts, aparts_before;  ///< of pairs that do not touch, sorted
  std::vector<char> flags;
  std::vector<char> carried;  ///< by island: something keyed moves it
  std::vector<std::uint32_t> contact_counts;
  std::vector<double> stillness;
  islands::Islands islands;
  islands::IslandSorter island_sorter;
  step::Solver solver;
  blocks::BlockSolver block_solver;
  std::vector<char> moved;  ///< by a solver in this step

  state::Body& at(BodyId id);
  const state::Body& at(BodyId id) const;
  void drop_contacts(std::uint32_t index);
  void wake(std::uint32_t index);
  void note(std::uint32_t index);  ///< the next step looks at this body
  void wake_neighbors(std::uint32_t index);
  void meet_or_not(std::uint32_t a, std::uint32_t b);  ///< whether the two may meet has changed
  void forget_impulses(std::uint32_t index);           ///< what the contacts of this body remember
  void step(double dt);

  void check_bodies(double dt,
                    double at) const;  ///< @throws NotFinite for the first that is not; dt of the step before
  void check_loads(double at) const;   ///< @throws NotFinite for the first body with one that is not
  void begin_watch();
  void end_watch();
  void find_constraints(double dt);
  /// The manifold at the start of the step, or where the bodies meet in it. Returns false when they do not.
  bool find_manifold(step::ContactConstraint& constraint, const state::Body& a, const state::Body& b,
                     const collision::Passage& way_a, const collision::Passage& way_b, double dt);
  void wake_by_fields();
  bool wake_islands();  ///< true when a sleeper woke, so that its contacts must be looked for
  void advance_bodies(double dt);
  void let_sleep(double dt);
  void report();
};

}  // namespace tweenfall
