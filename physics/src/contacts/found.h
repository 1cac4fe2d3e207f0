#pragma once

#include <span>
#include <vector>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"
#include "pairs/broad_phase.h"

namespace tweenfall::contacts {

/// A pair that was told apart in the step before.
struct KnownApart {
  pairs::Pair pair;
  collision::Apart apart;
};

/// How two bodies may hand a blow on.
struct Link {
  std::uint32_t a = 0, b = 0;
  bool a_moves = false, b_moves = false;  ///< or stands like a wall
  double gap = 0, closing = 0;            ///< m, m/s
};

/// A pair that stays apart as its bodies go now, but might not if one of them were stopped.
struct Followers {
  Link link;
  std::uint32_t memory = state::ContactMemories::nowhere;
  bool known = true;  ///< how wide the gap is; otherwise only that it is no less
};

/// Of two bodies that meet within this step.
struct Blow {
  std::uint32_t a = 0, b = 0;
  double time = 0, change = 0;  ///< s after the start of the step; of their velocities at most, m/s
};

/// What the blows of this step may do to a body.
struct Struck {
  double time = 0;         ///< by the first, s
  double most = 0;         ///< change of its velocity, m/s
  std::uint64_t when = 0;  ///< it was last told of a harder or an earlier one: a number that rises
};

/// The memories of a pair of bodies: one, or one for each pair of parts that touched; places in the sorted list.
struct PairMemories {
  std::uint32_t first = 0, count = 0;
};

/// Contacts one after the other, in places that are used again and not cleared: most have few points.
class FoundContacts {
 public:
  /// One without points.
  ContactConstraint& add() {
    if (count_ == all_.size()) all_.emplace_back();
    ContactConstraint& contact = all_[count_++];
    static_cast<ContactHead&>(contact) = {};
    return contact;
  }
  void drop_last() { --count_; }
  void clear() { count_ = 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] std::span<ContactConstraint> all() { return std::span(all_).first(count_); }

 private:
  std::vector<ContactConstraint> all_;
  std::size_t count_ = 0;
};

/// What a part of the pairs comes to, in their order.
struct FoundPart {
  FoundContacts contacts;
  std::vector<KnownApart> aparts;
  std::vector<Followers> followers;
  std::vector<Blow> blows;
};

}  // namespace tweenfall::contacts
