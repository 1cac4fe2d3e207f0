#pragma once

#include <memory>
#include <vector>

#include "actors/soft/meetings/partners.h"
#include "collision/passage.h"
#include "contacts/found.h"
#include "forces/flight.h"
#include "forces/forces.h"
#include "islands/blocks/block_solver.h"
#include "islands/free_islands.h"
#include "islands/island_contents.h"
#include "islands/mirrored.h"
#include "islands/shifted_apart.h"
#include "islands/sprung/sprung_flight.h"
#include "joints/joint_link.h"
#include "pairs/broad_phase.h"
#include "queries/scene.h"
#include "state/lazily_made.h"
#include "state/makeups.h"
#include "step/solver.h"
#include "strategies/island_by_strategies.h"
#include "threads/workers.h"

namespace tweenfall::step {

/// A body at the start of a step.
struct Start {
  Vec3 center;
  Quat rotation;
  Twist twist;
  bool led = false;  ///< by a drive whose target moves
};

/// The result of a contact.
struct Outcome {
  std::uint32_t place = 0;  ///< of its memory
  bool remembered = false;
  bool touched = false, touching = false;  ///< in the step before, and now
  bool holds = false;                      ///< its manifold may be used again
  bool elsewhere = false;  ///< its points were found for other positions than those at the start of the step
  bool borne = false;      ///< carried by a body that does not move
  double normal = 0;       ///< N s
  double approach = 0;     ///< m/s
  Vec3 total{0, 0, 0};     ///< on the second body, N s
};

/// What a contact is with, when that body moves only by its own will.
enum class Obstacle : char { none, solid, surface };

/// Islands that are solved together.
struct Batch {
  blocks::BlockSolver::Effort effort;
  std::vector<islands::IslandContents> islands;
  std::size_t size = 0;  ///< contacts of all of them, and a share of their joints
};

struct Solvers {
  Solver few;
  blocks::BlockSolver many;
  blocks::BlockSolver
      alone;  ///< for islands solved by themselves: after those of others its room would be cleared anew
  std::vector<Batch> batches;  ///< for `many`, by effort
  sprung::SprungFlight sprung;
  strategies::IslandByStrategies strategies;
  double complementarity = 0;  ///< of the islands of this step, m/s

  Batch& put_by(const islands::IslandContents& island, const blocks::BlockSolver::Effort& effort);
  void solve(Batch& batch, std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
             const WorldSettings& settings, double dt, std::vector<char>& moved);
};

/// The bodies that a contact ties together; of two that do not both move by themselves, the same one twice.
struct ContactEnds {
  std::uint32_t a, b;
};

/// Room for a step to work in, and what makes the next one fast. Whether it is left from earlier steps or starts
/// empty never changes one bit of the result, so copies do not take it along.
struct Workspace {
  double part_count = 1;                 ///< length of the whole step divided by that of this one
  std::vector<std::uint32_t> noted;      ///< bodies that the caller changed or led, and those noted before them
  std::vector<char> is_noted;            ///< by body
  std::vector<std::uint32_t> watched;    ///< sorted: what a step looks at, everything but scenery at rest
  std::vector<std::uint32_t> sleepers;   ///< among the watched
  std::vector<std::uint32_t> drowsy;     ///< those that have been still long enough themselves
  std::vector<std::uint32_t> lingering;  ///< to be looked at once more after coming to rest

  std::vector<forces::Load> loads;
  forces::Flight flight;  ///< of this step, if the integrator evaluates forces
  std::vector<SpringRow> stiff_springs;
  std::vector<joints::JointLink> links;
  std::vector<Start> starts;
  pairs::BroadPhase broad_phase;
  std::vector<contacts::FoundPart> found;            ///< of all pairs, in their order
  contacts::FoundContacts followers;                 ///< contacts that blows of this step will close
  std::vector<contacts::Struck> struck_bodies;       ///< by body
  std::vector<contacts::Followers> beyond;           ///< of bodies that are struck hard
  std::vector<contacts::Link> touching_links;        ///< of `active`
  std::vector<char> cornered;                        ///< by link: more of its corners may come down
  std::vector<contacts::ContactConstraint*> active;  ///< in `found` and `followers`: contacts near something that moves
  std::vector<ContactEnds> active_ends;              ///< of `active`
  std::vector<std::uint32_t> retained;               ///< memories of contacts between bodies at rest, by pair
  std::vector<std::vector<std::uint32_t>> retained_parts;  ///< of the pairs, in order
  std::vector<std::uint32_t> remembered;
  std::vector<Obstacle> obstacles;               ///< of `active`
  std::vector<Outcome> outcomes;                 ///< of `active`
  std::vector<pairs::Pair> parted;               ///< those of which some part no longer touches
  state::LazilyMade<std::vector<Contact>> told;  ///< what the caller sees of the contacts
  std::vector<SensorOverlap> next_overlaps;
  std::vector<collision::Passage> passages;  ///< by body
  std::vector<std::uint64_t> looked_at;      ///< by body: the look for which its passage was made
  std::uint64_t look = 0;
  std::vector<std::uint32_t> looked_for;              ///< bodies whose passage this look needs
  std::vector<contacts::PairMemories> pair_memories;  ///< by pair of the broad phase
  std::vector<contacts::KnownApart> aparts;           ///< of pairs that do not touch, sorted
  std::vector<char> flags;
  std::vector<char> carried;                   ///< by island: something keyed moves it
  std::vector<std::uint32_t> neighbor_counts;  ///< by body: pairs of bodies that move by themselves
  std::vector<std::uint32_t> contact_counts;   ///< by body in a crowd: contacts with others in it
  std::vector<double> stillness;
  islands::Islands islands;
  islands::IslandSorter island_sorter;
  islands::FreeIslands free_islands;
  std::unique_ptr<islands::MirroredIslands> mirrored_islands;  ///< within a step never null
  islands::ShiftedApart shifted_apart;
  std::vector<Solvers> solvers;  ///< one for each thread
  std::vector<std::uint32_t> islands_by_size;
  std::vector<char> moved;          ///< by a solver in this step
  std::vector<char> by_strategies;  ///< by body: its island goes by its own strategies; empty if none does
  std::vector<contacts::ContactConstraint> struck;  ///< in this step, between bodies that have separated since
  double complementarity = 0;                       ///< residual of the last step where the solver is `lcp`, m/s
  state::Makeups makeups;                           ///< of the bodies that were added last
  std::vector<soft::Place> soft_starts;             ///< by body, if there are soft bodies
  state::LazilyMade<queries::Scene> scene;          ///< of the bodies, between two changes
  // Last, where it takes no room of its own.
  bool fresh = true;  ///< knows nothing of earlier steps: the next step looks at every body

  void note(std::uint32_t body);  ///< the next step looks at this body
};

}  // namespace tweenfall::step
