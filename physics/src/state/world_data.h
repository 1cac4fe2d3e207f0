#pragma once

#include <utility>

#include "islands/small/part_of_step.h"
#include "state/world_state.h"
#include "step/workspace.h"

namespace tweenfall {

/// What a world is, and the room that it works in.
struct World::Implementation : state::WorldState, step::Workspace {
  bool stepping = false;               ///< a field may be running: nothing may change
  std::shared_ptr<Executor> executor;  ///< null: the thread that calls

  Implementation() = default;
  explicit Implementation(state::WorldState other, std::shared_ptr<Executor> shared)
      : WorldState(std::move(other)), executor(std::move(shared)) {}
  Implementation& operator=(const state::WorldState& other) {
    WorldState::operator=(other);
    Workspace::operator=({});
    return *this;
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  state::Body& at(BodyId id);
  const state::Body& at(BodyId id) const;
  state::Joint& at(JointId id);
  const state::Joint& at(JointId id) const;
  void wake_ends(const state::Joint& joint);
  void wake_jointed(std::uint32_t index);  ///< what a joint holds to this body, and itself
  void remove_joint(std::uint32_t index);
  void remove_joints_of(std::uint32_t body);
  void drop_contacts(std::uint32_t index);
  void wake(std::uint32_t index);
  void wake_neighbors(std::uint32_t index);
  void meet_or_not(std::uint32_t a, std::uint32_t b);  ///< whether the two may meet has changed
  void forget_impulses(std::uint32_t index);           ///< what the contacts of this body remember
  void step(double dt, double parts);

  [[nodiscard]] threads::Workers workers() const { return threads::Workers(executor.get()); }
  void check_bodies(double dt,
                    double at) const;  ///< @throws NotFinite for the first that is not; dt of the step before
  void check_loads(double at) const;   ///< @throws NotFinite for the first body with one that is not
  void begin_watch();
  void end_watch();
  void find_constraints(double dt);
  /// The manifold at the start of the step, or where the bodies meet in it. Returns false when they do not.
  bool find_manifold(contacts::ContactConstraint& constraint, const state::Body& a, const state::Body& b,
                     const collision::Passage& way_a, const collision::Passage& way_b, double dt,
                     contacts::FoundPart* told_apart) const;
  /// Which memories the pairs of the broad phase have, and which of the others are kept; @return whether two bodies of
  /// a pair may each have more contacts in a crowd than a body gets there
  bool recall(std::span<const pairs::Pair> pairs);
  [[nodiscard]] bool in_crowd(const pairs::Pair& pair) const;
  void find_memories(std::span<const pairs::Pair> pairs);
  void fetch_ahead(std::span<const pairs::Pair> pairs, std::span<const contacts::PairMemories> memories_of,
                   std::size_t i) const;
  void find_part(std::span<const pairs::Pair> pairs, std::span<const contacts::PairMemories> memories_of, bool crowded,
                 double dt, contacts::FoundPart& part);
  /// The contact of two bodies, or of two of their parts, if there is one.
  void find_contact(const contacts::PairInContact& pair, const collision::Passage& way_a,
                    const collision::Passage& way_b, double dt, bool alone, contacts::FoundPart& part) const;
  /// Contacts of pairs that a blow on one of the two would bring together within this step.
  /// @param parts  of `found`
  void find_followers(std::size_t parts, double dt);
  /// What a contact takes from its bodies and from the step before.
  void finish_contact(contacts::ContactConstraint& constraint, const state::ContactMemory* memory) const;
  /// Contacts of a body, or of all its parts, with a body that is a mesh or a height field.
  void find_contacts_with_surface(const contacts::PairInContact& pair, contacts::PairMemories known, double dt,
                                  contacts::FoundPart& part) const;
  /// Contacts of all parts of two bodies of which one is a compound.
  void find_contacts_of_parts(const contacts::PairInContact& pair, contacts::PairMemories known, double dt,
                              contacts::FoundPart& part) const;
  void find_obstacles();  ///< among the contacts
  /// Keeps what a step has deflected or driven fast from ending behind a mesh or a height field that it was before.
  void hold_before_surfaces();
  void hold_before_walls(double dt);
  void gather_links();             ///< joints that hold something that can move
  void leave_sleeping_links();     ///< out of what is solved
  void end_links(double dt);       ///< reactions, and what breaks
  void wake_by_forces(double dt);  ///< those on whom a force acts that may be another though they rest
  void wake_forced(BodyId body);   ///< those on whom a force acts that is by this body
  bool wake_islands();             ///< true when a sleeper woke, so that its contacts must be looked for
  void solve_islands(double dt);
  /// How many pieces an island goes through a step in; nearly always one.
  [[nodiscard]] int pieces_of(const islands::IslandContents& island, double dt) const;
  /// Whether bodies of an island meet in a step so that what one gives the other goes on to a third.
  [[nodiscard]] bool hands_on_blows(const islands::IslandContents& island, double dt) const;
  void solve_by_blows(const islands::IslandContents& island, double dt, step::Solvers& by);
  /// Contacts of a small island as its bodies lie now, for a part of the step.
  std::span<contacts::ContactConstraint* const> find_again(const islands::IslandContents& island,
                                                           small::PartsOfStep& parts, double h) const;
  /// Before and after its contacts are solved for a part of the step: what they did not move flies.
  void begin_part(const small::PartsOfStep& parts);
  void end_part(small::PartsOfStep& parts, std::span<contacts::ContactConstraint* const> near, double h);
  void solve_in_pieces(const islands::IslandContents& island, int pieces, double dt, step::Solver& solver);
  void advance_bodies(double dt);

  // Where other strategies than the usual ones are asked for
  [[nodiscard]] bool goes_by_strategies(const islands::IslandContents& island) const;
  /// @return how far off complementarity it is, m/s
  double solve_by_strategies(const islands::IslandContents& island, double dt, strategies::IslandByStrategies& by);
  void fly_alone(std::uint32_t index, double h, double dt);  ///< a body that nothing has moved, through a part of dt
  void separate(std::span<contacts::ContactConstraint* const> overlapping);
  [[nodiscard]] bool goes_by_impacts() const;
  /// The whole world from impact to impact.
  void solve_by_impacts(double dt);
  void lead_on(double h, double left);  ///< what is on its way to a target, through a part of what is left
  void step_in_plane(double dt);        ///< all of a step, where there is a plane
  void push_in_plane(double dt);        ///< forces
  void break_in_plane();                ///< joints that bore too much
  void let_sleep(double dt);
  void remember_contacts();
  void report();
  void tell_ended();
  void tell_contacts(std::vector<Contact>& all) const;
  void sense();
  void note_soft_starts();        ///< where bodies are before a step, for soft ones
  void advance_softs(double dt);  ///< soft bodies, and what they give the bodies that have been moved already
  void check_softs() const;       ///< @throws SoftNotFinite
};

}  // namespace tweenfall
