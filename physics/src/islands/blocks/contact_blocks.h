#pragma once

#include <array>
#include <span>
#include <vector>

#include "contacts/contact_constraint.h"
#include "contacts/meeting.h"
#include "islands/blocks/coloring.h"
#include "islands/blocks/contact_block.h"
#include "islands/blocks/island_body.h"
#include "islands/blocks/uncleared.h"
#include "step/keyed_step.h"
#include "threads/workers.h"

namespace tweenfall::blocks {

/// The contacts of an island, eight at a time, by color.
class ContactBlocks {
 public:
  using Origin = ContactOrigin;

  /// Sorts the contacts and starts with the impulses that they kept.
  /// @param places    from a body's index to its place in `bodies`
  /// @param closings  by contact
  void build(std::span<contacts::ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
             const std::vector<IslandBody>& bodies, std::span<const contacts::Closing> closings, double h,
             const threads::Workers& work);
  /// After the rows were prepared: how surfaces move at them. @param again  only for bodies that have turned since
  void prepare_drifts(const std::vector<IslandBody>& bodies, bool again);
  /// In a sub-step with led bodies: adds what the slip of their riders lacks.
  void ride(const std::vector<IslandBody>& bodies, std::span<const step::LedBody> led,
            const std::vector<BodyLanes>& starts, double h);
  /// Call it once the bodies have been moved.
  void end_ride();
  /// Returns the impulses to the contacts, after a step of `dt` in sub-steps of `h`.
  /// @param parts  how often it fits into the whole step
  void store(double h, double dt, double parts, const threads::Workers& work);

  [[nodiscard]] std::size_t size() const { return blocks.size() + balls.size(); }
  /// Of blocks, then of balls.
  [[nodiscard]] const Origin& origin(std::size_t i) const {
    return i < blocks.size() ? origins[i] : ball_origins[i - blocks.size()];
  }

  /// Of a point of the contact in a lane, 8 * block + lane, N s.
  [[nodiscard]] double impulse(std::uint32_t lane, std::uint32_t point) const {
    const std::size_t i = lane / lane_count;
    return i < blocks.size() ? points[blocks[i].point + point].impulse[lane % lane_count]
                             : balls[i - blocks.size()].impulse[lane % lane_count];
  }

  /// The places of a contact's bodies, and the kind of its block.
  struct Ends {
    std::uint32_t a, b, kind;
    bool a_moves, b_moves;
  };
  std::vector<Ends> ends;  ///< of the contacts, in their order
  Uncleared<ContactBlock> blocks;
  Uncleared<BallBlock> balls;
  std::size_t pairs = 0, ball_pairs = 0;  ///< those of two movable bodies come first
  std::vector<PointRow> points;           ///< more than are used
  std::vector<FrictionRow> frictions;     ///< more than are used
  std::vector<DriftRow> drifts;           ///< parallel to `frictions`, or empty if no surface moves and nothing is led
  std::vector<InertiaRow> inertias;
  Uncleared<MeetingRow> meetings, ball_meetings;
  Uncleared<Origin> origins, ball_origins;

  /// Blocks, or balls, of one color, in the order in which they are solved. They share no movable body.
  struct Phase {
    bool of_balls = false;
    std::size_t begin = 0, end = 0;
  };
  std::vector<Phase> phases;
  /// The same in lanes, and in their order.
  struct Stretch {
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<Stretch> stretches;
  std::uint32_t room = 0;  ///< of bodies, and after them of places that are written but never read

 private:
  /// The contacts of a block or ball, and the place for what is never read.
  struct Filling {
    bool of_balls;
    std::uint32_t index, first, count, room;  ///< `first` in `sorted_`
  };

  /// For a block: what the most demanding of its lanes needs.
  struct Makeup {
    int grip = 0, points = 1;
    bool even = true;
  };

  void sort_by_key();
  void find_keys(std::span<contacts::ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
                 const std::vector<IslandBody>& bodies, const threads::Workers& work);
  void lay_out();
  void open(const Makeup& makeup);
  void find_phases();
  void clear(const Filling& filling);
  void clear_rows(const ContactBlock& block, const Filling& filling,
                  std::span<contacts::ContactConstraint* const> contacts);
  void fill(std::size_t block, int lane, contacts::ContactConstraint& contact, const std::vector<IslandBody>& bodies,
            const Ends& own, const contacts::Closing& closing, double h);
  void fill_ball(std::size_t ball, int lane, contacts::ContactConstraint& contact,
                 const std::vector<IslandBody>& bodies, const Ends& own, const contacts::Closing& closing, double h);

  bool drifting_ = false;  ///< some surface moves, or something is led
  Coloring coloring_;
  std::uint32_t point_count_ = 0, friction_count_ = 0;
  std::vector<Filling> fillings_;
  std::vector<std::uint32_t> keys_, counts_, sorted_;
  std::vector<std::size_t> color_blocks_, color_balls_;  ///< by color: where its blocks begin
};

}  // namespace tweenfall::blocks
