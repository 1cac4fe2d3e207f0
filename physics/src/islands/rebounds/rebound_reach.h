#pragma once

#include <atomic>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "islands/blocks/contact_blocks.h"
#include "islands/rebounds/rebound_ball.h"
#include "islands/rebounds/rebound_contact.h"

namespace tweenfall::blocks {

/// The contacts that a rebound reaches, and which of them must be visited again because one of their bodies was
/// pushed. Contacts are identified by lanes: 8 * block + lane, balls after all blocks.
class ReboundReach {
 public:
  /// Call it when the blocks have other contacts.
  void forget() { starts_.clear(); }
  /// Starts with nothing reached.
  void begin(const ContactBlocks& contacts, const std::vector<IslandBody>& bodies,
             const std::vector<BodyLanes>& velocities);
  /// Makes room for the contacts of these lanes, each named once: those that are new must then be taken.
  void reach(std::span<const std::uint32_t> lanes);
  /// Takes the contact of a lane from its block if it is new. Several threads may take different lanes.
  void take(std::uint32_t lane, const ContactBlocks& contacts, const std::vector<IslandBody>& bodies) {
    const std::uint32_t place = slots_[lane] - 1;
    if (lane >= first_ball_) {
      if (place >= known_balls_) balls_[place].take(contacts, lane);
    } else if (place >= known_contacts_) {
      contacts_[place].take(contacts, lane, bodies);
    }
  }
  /// Calls act(contact) for the contact of a lane that was taken: a ReboundContact or a ReboundBall.
  template <class Act>
  auto with(std::uint32_t lane, const Act& act) {
    return lane >= first_ball_ ? act(balls_[slots_[lane] - 1]) : act(contacts_[slots_[lane] - 1]);
  }

  void look_at(std::uint32_t lane, bool shared) {
    std::atomic<std::uint64_t>& word = open_[lane / 64];
    const std::uint64_t bit = std::uint64_t{1} << (lane % 64);
    if (shared)
      word.fetch_or(bit, std::memory_order_relaxed);
    else
      word.store(word.load(std::memory_order_relaxed) | bit, std::memory_order_relaxed);
  }
  /// Marks all other contacts of a movable body as due.
  void push(std::uint32_t place, std::uint32_t by, bool shared) {
    for (std::uint32_t i = starts_[place]; i < starts_[place + 1]; ++i)
      if (lanes_[i] != by) look_at(lanes_[i], shared);
  }
  /// Returns those of a stretch that are due, in order, and clears their marks.
  [[nodiscard]] std::span<const std::uint32_t> due(const ContactBlocks::Stretch& stretch);

  [[nodiscard]] std::span<ReboundContact> contacts() { return std::span(contacts_).first(contact_count_); }
  [[nodiscard]] std::span<ReboundBall> balls() { return std::span(balls_).first(ball_count_); }
  /// The velocity that a body had before.
  [[nodiscard]] const BodyLanes& before(std::size_t place) const { return before_[place]; }

 private:
  std::vector<std::uint32_t> starts_, lanes_;     ///< by place: the contacts of each movable body
  std::vector<std::atomic<std::uint64_t>> open_;  ///< bits of lanes
  std::vector<std::uint32_t> due_;
  std::vector<std::uint32_t> slots_;  ///< by lane: its index in the list of its kind, plus one; 0 for none
  std::vector<ReboundContact> contacts_;
  std::vector<ReboundBall> balls_;
  std::size_t contact_count_ = 0, ball_count_ = 0;    ///< how many of them are reached
  std::size_t known_contacts_ = 0, known_balls_ = 0;  ///< how many of those are taken
  std::size_t first_ball_ = 0;                        ///< lane
  std::vector<BodyLanes> before_;
};

}  // namespace tweenfall::blocks
