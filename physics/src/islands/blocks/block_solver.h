#pragma once

#include <optional>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "islands/blocks/contact_blocks.h"
#include "islands/blocks/island_body.h"
#include "islands/blocks/island_holds.h"
#include "islands/blocks/jointed_spins.h"
#include "islands/island_contents.h"
#include "islands/island_depth.h"
#include "islands/island_energy.h"
#include "islands/rebounds/rebound_reach.h"
#include "joints/island_joints.h"

namespace tweenfall::blocks {

/// Solves contacts of islands in sub-steps, eight at a time: like `Solver`, but with rows prepared once per step (and
/// again when a body has turned), few passes, and friction at the middle of contacts that do not slide.
/// Sources: Macklin and others, Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024, and SIMD Matters,
/// 2024.
class BlockSolver {
 public:
  /// How thoroughly an island is solved.
  struct Effort {
    int sub_steps = 1;
    int softening = 1, relaxing = 1;  ///< passes that remove overlap, and passes that remove the speed this gave
    int rebound_passes = 1;
    double giving = 1;         ///< share of their softness that contacts get
    double turned_enough = 0;  ///< rows are prepared again when a body has turned by this, rad
    double settled = 1e-6;     ///< with many passes: a smaller change, of the speed that impulses give, ends them
    bool heap = false;         ///< many bodies press on each other
    bool alone = false;        ///< not together with other islands
    bool single = false;       ///< one contact: all passes over it are made at once, until one changes nothing
    bool spins = false;        ///< contacts resist spinning: where one does, impulses do not carry on between sub-steps

    bool operator==(const Effort&) const = default;
  };

  /// Empty for islands that `Solver` has to solve: bodies with drives, stiff springs or rolling friction, steps far
  /// shorter than those before them; with few contacts also impacts that spring back, two bodies that meet alone,
  /// and bodies that spin or move by their own will.
  [[nodiscard]] std::optional<Effort> effort_for(const islands::IslandContents& island,
                                                 const std::vector<state::Body>& bodies,
                                                 const std::vector<forces::Load>& loads, const WorldSettings& settings,
                                                 double dt, const threads::Workers& workers = {});

  /// Call it before the islands of a step.
  void begin(std::size_t bodies, double parts) {
    places_.assign(bodies, 0);
    parts_ = parts;
    shifts_ = false;
  }
  /// Whether contacts of one of the islands were marked, so that `ShiftedApart` shifts them.
  [[nodiscard]] bool shifts() const { return shifts_; }
  /// Moves the bodies of islands by `dt`; fills in the impulses of their contacts and joints. Islands do not
  /// depend on each other.
  /// @param moved  by index: set for the bodies that were moved
  void solve(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
             std::span<const islands::IslandContents> islands, const Effort& effort, const WorldSettings& settings,
             double dt, std::vector<char>& moved, const threads::Workers& workers = {});

 private:
  /// A point that will rebound in this sub-step.
  struct Rebound {
    std::uint32_t lane, point;  ///< 8 * block + lane, and the index of the contact's point
    double speed;               ///< wanted at the end of the sub-step, m/s
    double time;                ///< how long it moves the bodies, s
    double speed_before = 0;    ///< m/s
  };

  /// A point that meets something: with what springs back dully, or gives a blow to joints.
  struct MeetingPoint {
    std::uint32_t lane, point;
  };
  /// Those of a part of the blocks.
  struct Meetings {
    std::vector<Rebound> lively;
    std::vector<MeetingPoint> dull, blows;
  };

  /// Properties of a body, or of a contact, found by any thread and then read in order.
  struct Traits {
    bool conveys = false, uneven = false, immovable = false, driven = false;
  };
  struct Marks {
    bool impact = false, springs_back = false, rolls = false, pushed = false;
  };
  /// The jointed bodies of an island.
  struct JointedFlight {
    bool free = true;      ///< only joints hold it
    bool wild = false;     ///< something moves farther than can be followed
    double mass = 0;       ///< kg
    Vec3 gained{0, 0, 0};  ///< kg m/s
  };

  [[nodiscard]] std::optional<Effort> effort_of_small(const islands::IslandContents& island,
                                                      const std::vector<state::Body>& bodies,
                                                      const std::vector<forces::Load>& loads,
                                                      const WorldSettings& settings, double dt) const;
  [[nodiscard]] std::optional<Effort> effort_of_large(const islands::IslandContents& island,
                                                      const std::vector<state::Body>& bodies,
                                                      const WorldSettings& settings, double dt,
                                                      const threads::Workers& workers);
  void gather(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
              std::span<const islands::IslandContents> islands, Integrator integrator, double dt);
  void number(std::span<const islands::IslandContents> islands);
  void take(std::size_t place, const state::Body& body, const forces::Load& load, Integrator integrator);
  void foresee(std::span<contacts::ContactConstraint* const> contacts, const std::vector<forces::Load>& loads,
               double trembling, double dt);
  void begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, double dt,
                      int sub_steps, int sub_step);
  void begin_sub_step_of(std::size_t place, const state::Body& body, const forces::Load& load, double h);
  void carry_on(std::size_t place, const BodyLanes& ended);
  void prepare_again(const std::vector<state::Body>& bodies);
  void find_lags();
  void find_lags_of_jointed();
  void tame_jointed(const std::vector<state::Body>& bodies, double h);
  void end_sub_step(double h);
  void include_turn(std::size_t place);
  void lead(double dt, int sub_steps, int sub_step);
  void end_lead();
  void carry_spins(double h);
  [[nodiscard]] bool bounds_spin(std::uint32_t place, double h) const;
  void bound_spins(const std::vector<state::Body>& bodies, double h);
  void follow_spins(const std::vector<state::Body>& bodies);
  void end_jointed(const std::vector<state::Body>& bodies);
  [[nodiscard]] Rows rows();
  /// Calls see(rows) for all blocks, color by color, each perhaps in several parts.
  template <class See>
  void by_color(const See& see) {
    const Rows all = rows();
    if (work_.threads() == 1) {
      see(all);
      return;
    }
    for (const ContactBlocks::Phase& phase : contacts_.phases) {
      work_.ranges(phase.end - phase.begin, blocks_worth_a_part, [&](std::size_t begin, std::size_t end) {
        see(part_of(all, phase.of_balls, phase.begin + begin, phase.begin + end));
      });
    }
  }
  /// Calls see(rows) for all blocks, in parts and in any order.
  template <class See>
  void each_block(const See& see) {
    const Rows all = rows();
    work_.ranges(contacts_.blocks.size(), blocks_worth_a_part,
                 [&](std::size_t begin, std::size_t end) { see(part_of(all, false, begin, end)); });
  }
  /// Calls see(place) for all bodies.
  template <class See>
  void each_body(const See& see) const {
    work_.ranges(bodies_.size() - 1, worth_a_part, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin + 1; i < end + 1; ++i) see(i);
    });
  }

  // Rebound
  void find_meetings(double h);
  void find_meetings(const Rows& rows, std::size_t first, double h, Meetings& found);
  [[nodiscard]] bool springs_back_dully() const;
  void end_dull_rebounds();
  void end_blows(bool any);
  void start_anew(const MeetingPoint& one, double share);
  void rebound(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, int passes);
  template <class See>
  void each_rebound(const See& see);
  template <class Contact>
  bool move_by(const Rebound& rebound, const Contact& contact);
  [[nodiscard]] double work_of_driven() const;
  void bound_energy(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads);

  /// Number of bodies, or contacts, that are worth a task of their own; of blocks; and of contacts that rebound.
  static constexpr std::size_t worth_a_part = 48;
  static constexpr std::size_t blocks_worth_a_part = 24;
  static constexpr std::size_t rebounds_worth_a_part = 24;

  threads::Workers work_;               ///< within the present island
  double parts_ = 1;                    ///< length of the whole step divided by that of this one
  std::vector<std::uint32_t> places_;   ///< from a body's index into bodies_; 0 for none
  std::vector<std::uint32_t> indices_;  ///< by place: of the bodies
  std::vector<Traits> traits_;          ///< by place
  std::vector<Marks> marks_;            ///< of the contacts
  std::vector<IslandBody> bodies_;      ///< the first stands for no body, in empty lanes
  std::vector<BodyPace> paces_;
  std::vector<BodyTurn> turns_;
  std::vector<BodyLanes> velocities_, starts_, displacements_;
  std::vector<BodyLanes> begun_;    ///< velocities at the start of the sub-step, with forces but without contacts
  std::vector<BodyLanes> ended_;    ///< velocities that the passes left; if nothing rebounds, only of `uneven_`
  std::vector<step::LedBody> led_;  ///< of bodies_
  std::vector<BodyLag> lags_;
  std::vector<BodyLag> sub_starts_;  ///< linear displacements at the start of the sub-step
  islands::IslandDepth depth_;
  std::vector<std::uint32_t> held_by_joints_;  ///< workspace: bodies at the ends of joints, sorted
  bool shifts_ = false;
  std::vector<std::uint32_t> island_of_;              ///< of bodies_: its index among the present islands
  std::vector<islands::IslandEnergy> energies_;       ///< of the present islands
  std::vector<islands::IslandEnergy> even_energies_;  ///< of each body with the same moment about every axis
  std::vector<char> reached_;                         ///< by island: reached by a rebound
  std::vector<char> changed_;                         ///< of bodies_: its velocity was changed by a rebound
  std::vector<double> shares_;                        ///< of the rebound, that the islands let through
  std::vector<contacts::ContactConstraint*> listed_;  ///< contacts of all the islands
  std::vector<joints::JointLink*> listed_joints_;     ///< joints of all the islands
  std::vector<JointedFlight> jointed_;                ///< by island
  std::vector<std::uint32_t> uneven_;        ///< places of movable bodies with different moments about their axes
  std::vector<contacts::Closing> closings_;  ///< of the contacts
  ContactBlocks contacts_;
  joints::IslandJoints joints_;
  JointedSpins spins_;  ///< empty if there are no joints
  IslandHolds holds_;
  bool carries_on_ = false;  ///< bodies start the sub-step with what contacts gave them in the one before
  bool rebounded_ = false;   ///< something sprang back in the sub-step before
  bool bouncy_ = false;      ///< some contact has restitution
  bool rolls_ = false;       ///< some contact resists rolling
  bool meets_ = false;       ///< some contact is an impact
  bool conveyed_ = false;    ///< some surface moves
  bool driven_ = false;      ///< a drive holds some body
  std::vector<char> stale_;  ///< by part of the bodies: one of them has turned too far
  std::vector<char> wild_;   ///< by part of the bodies: one of them moves farther than can be followed
  double turned_enough_ = 0;
  bool any_stale_ = false;               ///< a body has turned since its rows were prepared
  std::vector<std::uint32_t> meetings_;  ///< lanes
  std::vector<Rebound> rebounds_;
  std::vector<Meetings> meeting_parts_;  ///< of parts of the blocks, in order
  std::vector<char> struck_;             ///< of bodies_: a jointed body that meets something in this sub-step
  ReboundReach reach_;
};

}  // namespace tweenfall::blocks
