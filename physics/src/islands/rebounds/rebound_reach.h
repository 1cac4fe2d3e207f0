#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "islands/blocks/contact_blocks.h"
#include "islands/rebounds/rebound_ball.h"
#include "islands/rebounds/rebound_contact.h"

namespace tweenfall::blocks {

/// The contacts that a rebound reaches, and which of them are to be looked at again because a body of theirs was
/// pushed. Contacts are told by lanes: 8 * block + lane, balls after all blocks.
class ReboundReach {
 public:
  /// The blocks have others in them.
  void forget() { starts_.clear(); }
  /// Nothing is reached yet.
  void begin(const ContactBlocks& contacts, const std::vector<IslandBody>& bodies);
  /// Calls act(contact) for the contact of a lane, from now on reached: a ReboundContact or a ReboundBall, as it stands
  /// in its block when it is reached for the first time.
  template <class Act>
  auto reach(std::uint32_t lane, const ContactBlocks& contacts, const std::vector<IslandBody>& bodies,
             const std::vector<BodyLanes>& velocities, const Act& act) {
    if (lane >= first_ball_) {
      if (slots_[lane] == 0) {
        add(balls_, ball_count_, lane).take(contacts, lane);
        note(balls_[ball_count_ - 1], velocities);
      }
      return act(balls_[slots_[lane] - 1]);
    }
    if (slots_[lane] == 0) {
      add(contacts_, contact_count_, lane).take(contacts, lane, bodies);
      note(contacts_[contact_count_ - 1], velocities);
    }
    return act(contacts_[slots_[lane] - 1]);
  }
  /// All contacts of a movable body are to be looked at.
  void push(std::uint32_t place);
  void look_at(std::uint32_t lane) { open_[lane / 64] |= std::uint64_t{1} << (lane % 64); }
  void pass_by(std::uint32_t lane) { open_[lane / 64] &= ~(std::uint64_t{1} << (lane % 64)); }

  /// Calls `visit(lane)` in order for what is to be looked at; also for what comes to be so further on meanwhile.
  /// @return whether there was any
  template <class Visit>
  bool visit(const Visit& visit) {
    bool any = false;
    for (std::size_t word = 0; word < open_.size(); ++word) {
      std::uint64_t ahead = ~std::uint64_t{0};
      while (const std::uint64_t open = open_[word] & ahead) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(open));
        ahead = bit == 63 ? 0 : ~std::uint64_t{0} << (bit + 1);
        any = true;
        visit(static_cast<std::uint32_t>(64 * word) + bit);
      }
    }
    return any;
  }

  [[nodiscard]] std::span<ReboundContact> contacts() { return std::span(contacts_).first(contact_count_); }
  [[nodiscard]] std::span<ReboundBall> balls() { return std::span(balls_).first(ball_count_); }
  /// The velocity that a body had before, if a contact of it was reached.
  [[nodiscard]] const BodyLanes* before(std::uint32_t place) const { return known_[place] ? &before_[place] : nullptr; }

 private:
  template <class Contact>
  Contact& add(std::vector<Contact>& list, std::size_t& count, std::uint32_t lane) {
    if (count == list.size()) list.emplace_back();
    slots_[lane] = static_cast<std::uint32_t>(count + 1);
    return list[count++];
  }
  /// Velocities before the rebound.
  template <class Contact>
  void note(const Contact& contact, const std::vector<BodyLanes>& velocities) {
    for (const std::uint32_t place : {contact.a(), contact.b()}) {
      if (known_[place]) continue;
      known_[place] = 1;
      before_[place] = velocities[place];
    }
  }

  std::vector<std::uint32_t> starts_, lanes_;  ///< by place: the contacts of each movable body
  std::vector<std::uint64_t> open_;            ///< bits of lanes
  std::vector<std::uint32_t> slots_;           ///< by lane: one more than where it is in its list; 0 for nowhere
  std::vector<ReboundContact> contacts_;
  std::vector<ReboundBall> balls_;
  std::size_t contact_count_ = 0, ball_count_ = 0;  ///< how many of them are reached
  std::size_t first_ball_ = 0;                      ///< lane
  std::vector<char> known_;                         ///< by place: it is in before_
  std::vector<BodyLanes> before_;
};

}  // namespace tweenfall::blocks
