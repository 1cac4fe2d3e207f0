#pragma once

#include <utility>

#include "islands/small/part_of_step.h"
#include "islands/small/retake.h"
#include "state/world_state.h"
#include "step/workspace.h"

namespace tweenfall {

/// The state of a world, and the memory that its steps work in.
struct World::Implementation : state::WorldState, step::Workspace {
  bool stepping = false;               ///< a field may be running: nothing may change
  std::shared_ptr<Executor> executor;  ///< null: the calling thread

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
  void wake_jointed(std::uint32_t index);  ///< the joint, and what it holds to this body
  void remove_joint(std::uint32_t index);
  void remove_joints_of(std::uint32_t body);
  void drop_contacts(std::uint32_t index);
  void wake(std::uint32_t index);
  void wake_neighbors(std::uint32_t index);
  void meet_or_not(std::uint32_t a, std::uint32_t b);  ///< call it when whether the two may meet has changed
  void forget_impulses(std::uint32_t index);           ///< forgets what the contacts of this body remember
  void step(double dt, double parts);

  [[nodiscard]] threads::Workers workers() const { return threads::Workers(executor.get()); }
  void check_bodies(double dt,
                    double at) const;  ///< @throws NotFinite for the first body that is not; dt of the step before
  void check_loads(double at) const;   ///< @throws NotFinite for the first body with a load that is not
  void begin_watch();
  void end_watch();
  void find_constraints(double dt);
  /// The manifold at the start of the step, or where the bodies meet in it. Returns false when they do not.
  bool find_manifold(contacts::ContactConstraint& constraint, const state::Body& a, const state::Body& b,
                     const collision::Passage& way_a, const collision::Passage& way_b, double dt,
                     contacts::FoundPart* told_apart) const;
  /// Finds the memories of the broad phase's pairs, and which of the others are kept; @return whether both bodies of
  /// some pair may have more contacts in a crowd than a body gets there
  bool recall(std::span<const pairs::Pair> pairs);
  [[nodiscard]] bool in_crowd(const pairs::Pair& pair) const;
  void find_memories(std::span<const pairs::Pair> pairs);
  void fetch_ahead(std::span<const pairs::Pair> pairs, std::span<const contacts::PairMemories> memories_of,
                   std::size_t i) const;
  void find_part(std::span<const pairs::Pair> pairs, std::span<const contacts::PairMemories> memories_of, bool crowded,
                 double dt, contacts::FoundPart& part);
  /// The contact of two bodies, or of two of their parts, if any.
  void find_contact(const contacts::PairInContact& pair, const collision::Passage& way_a,
                    const collision::Passage& way_b, double dt, bool alone, contacts::FoundPart& part) const;
  /// Contacts of pairs that would come together within this step after a blow on one of the two.
  /// @param parts  of `found`
  void find_followers(std::size_t parts, double dt);
  /// Adds to `beyond` what a body that was struck hard may meet, but would not have met without the blow.
  void find_beyond(std::uint32_t index, std::span<contacts::FoundPart> parts, double dt);
  /// Fills in what a contact takes from its bodies and from the step before.
  void finish_contact(contacts::ContactConstraint& constraint, const state::ContactMemory* memory, double dt) const;
  /// Contacts of a body, or of all its parts, with a body that is a mesh or a height field.
  void find_contacts_with_surface(const contacts::PairInContact& pair, contacts::PairMemories known, double dt,
                                  contacts::FoundPart& part) const;
  /// Contacts of all parts of two bodies of which one is a compound.
  void find_contacts_of_parts(const contacts::PairInContact& pair, contacts::PairMemories known, double dt,
                              contacts::FoundPart& part) const;
  void find_obstacles();  ///< among the contacts
  /// Keeps bodies that a step deflected or made fast from ending behind a mesh or height field they were in front of.
  void hold_before_surfaces();
  [[nodiscard]] bool may_pass_wall(const contacts::ContactConstraint& contact, double dt) const;
  void hold_before_walls(double dt);
  void gather_links();             ///< joints that hold something that can move
  void leave_sleeping_links();     ///< removes them from what is solved
  void end_links(double dt);       ///< reads reactions, and breaks joints
  void wake_by_forces(double dt);  ///< bodies at rest on which a force acts that may have changed
  void wake_forced(BodyId body);   ///< bodies on which a force of this body acts
  bool wake_islands();             ///< true when a sleeping body woke, so that its contacts must be found
  void solve_islands(double dt);
  [[nodiscard]] islands::FreeStart free_start(std::uint32_t index) const {
    return {starts[index].center, starts[index].rotation, starts[index].twist};
  }
  /// In how many pieces an island goes through a step; nearly always one.
  [[nodiscard]] int pieces_of(const islands::IslandContents& island, double dt) const;
  /// Whether bodies of an island collide in a step so that one passes on to a third what it got from another.
  [[nodiscard]] bool hands_on_blows(const islands::IslandContents& island, double dt) const;
  void solve_by_blows(const islands::IslandContents& island, double dt, step::Solvers& by);
  /// Contacts of a small island for the present positions of its bodies, for a part of the step.
  std::span<contacts::ContactConstraint* const> find_again(const islands::IslandContents& island,
                                                           small::PartsOfStep& parts, double h) const;
  /// Before and after its contacts are solved for a part of the step: bodies that they did not move fly freely.
  void begin_part(const small::PartsOfStep& parts);
  void end_part(small::PartsOfStep& parts, std::span<contacts::ContactConstraint* const> near, double h);
  void solve_in_pieces(const islands::IslandContents& island, int pieces, double dt, step::Solver& solver);
  /// Whether bodies of a small island that were solved have got deep into each other, in a way that no contact was
  /// there for.
  [[nodiscard]] bool has_sunk(const islands::IslandContents& island, double dt) const;
  /// The same, in a part of the step. @param before  of the movable bodies, sorted by index
  [[nodiscard]] bool has_sunk(const small::Retake& retake, std::span<const small::Before> before,
                              std::span<const std::uint32_t> movable, double h) const;
  [[nodiscard]] double depth_at_start(const pairs::Pair& pair) const;  ///< of the step, m
  /// Moves the bodies of such an island through the step once more, from its start.
  void take_again(const islands::IslandContents& island, double dt, step::Solver& solver);
  /// @param shares  number of the solvers that this step has made ready
  void take_again_where_sunk(const std::vector<islands::IslandContents>& all, std::size_t shares, double dt);
  void take_part_again(small::Retake& retake, double h, int halvings, step::Solver& solver);
  /// The contacts of two bodies where they are now, for a part of the step.
  void find_pair_again(const pairs::Pair& pair, double h, contacts::FoundPart& part) const;
  void advance_bodies(double dt);

  // If other strategies than the defaults are asked for
  [[nodiscard]] bool goes_by_strategies() const;
  [[nodiscard]] bool goes_by_strategies(const islands::IslandContents& island) const;
  [[nodiscard]] Detection detection_of(const contacts::PairInContact& pair) const;
  /// @return the residual of complementarity, m/s
  double solve_by_strategies(const islands::IslandContents& island, double dt, strategies::IslandByStrategies& by);
  void fly_alone(std::uint32_t index, double h, double dt);  ///< a body that nothing moved, through a part of dt
  /// Those that are found before the bodies overlap.
  [[nodiscard]] std::vector<contacts::ContactConstraint*> foreseen(
      std::span<contacts::ContactConstraint* const> contacts) const;
  /// What overlaps at the end of the step, and is looked for only then, responds together with what touches it.
  /// @param found_at  where bodies were when the contacts were found, by index
  /// @param left  time of the step since then, s
  /// @return the residual of complementarity, m/s
  double respond_late(std::span<contacts::ContactConstraint* const> contacts, std::span<const step::Start> found_at,
                      double left, double dt, strategies::IslandByStrategies& by);
  /// A contact where its bodies are now; without points if they are apart there.
  /// @param from_a, from_b  where they were when it was found
  [[nodiscard]] contacts::ContactConstraint overlap_now(const contacts::ContactConstraint& contact,
                                                        const state::Body& a, const state::Body& b,
                                                        const step::Start& from_a, const step::Start& from_b) const;
  /// @param found_at  as above
  void separate(std::span<contacts::ContactConstraint* const> overlapping, std::span<const step::Start> found_at);
  [[nodiscard]] bool goes_by_impacts() const;
  /// Steps the whole world from impact to impact, but for islands that are solved as usual.
  void solve_by_impacts(double dt);
  /// Moves those through the step, before all others.
  /// @param usual  written: by body, whether it has been moved
  /// @return their contacts, which are active no more
  std::vector<contacts::ContactConstraint> solve_as_usual(double dt, std::vector<char>& usual);
  void lead_on(double h, double left);  ///< moves bodies with a target through a part of what is left of the step
  void step_in_plane(double dt);        ///< all of a step of a planar world
  void push_in_plane(double dt);        ///< forces
  void break_in_plane();                ///< breaks joints that bore too much
  void let_sleep(double dt);
  void remember_contacts();
  void report();
  void tell_ended();
  void tell_contacts(std::vector<Contact>& all) const;
  void sense();
  void note_soft_starts();  ///< where bodies are before a step, for soft bodies
  /// Steps soft bodies, and their effect on bodies that have been moved already. @param whole  the step of which this
  /// is a part, s
  void advance_softs(double dt, double whole);
  void check_softs() const;  ///< @throws SoftNotFinite
};

}  // namespace tweenfall
