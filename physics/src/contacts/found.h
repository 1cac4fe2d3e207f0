#pragma once

#include <span>
#include <vector>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"
#include "pairs/broad_phase.h"

namespace tweenfall::contacts {

/// A pair that was found apart in the step before.
struct KnownApart {
  pairs::Pair pair;
  collision::Apart apart;
};

/// A pair through which a blow may be passed on.
struct Link {
  std::uint32_t a = 0, b = 0;
  Vec3 normal{0, 0, 0};                           ///< from a toward b
  double gap = 0, closing = 0;                    ///< along the normal, m, m/s
  double inverse_mass_a = 0, inverse_mass_b = 0;  ///< 0 for an end that does not move: it stands like a wall
};

/// A pair that stays apart on the present paths, but might not if one of its bodies were stopped.
struct Followers {
  Link link;
  std::uint32_t memory = state::ContactMemories::nowhere;
  bool known = true;    ///< the width of the gap is known; otherwise only a lower bound
  bool beyond = false;  ///< of a body that a blow sends where it was not going
};

/// Two bodies that meet within this step.
struct Blow {
  std::uint32_t a = 0, b = 0;
  double time = 0;       ///< s after the start of the step
  Vec3 change{0, 0, 0};  ///< at most of b's velocity relative to a's, m/s
};

/// The possible effect of this step's blows on a body.
struct Struck {
  double time = 0;         ///< of the first blow, s
  Vec3 change{0, 0, 0};    ///< about how its velocity changes, m/s
  double most = 0;         ///< size of that change, m/s
  std::uint64_t when = 0;  ///< rising number of the last time it got a harder or an earlier blow
};

/// The memories of a pair of bodies: one, or one per pair of parts that touched; places in the sorted list.
struct PairMemories {
  std::uint32_t first = 0, count = 0;
};

/// A list of contacts whose places are reused without being cleared, since most have few points.
class FoundContacts {
 public:
  /// Adds one without points.
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

/// The results for a part of the pairs, in their order.
struct FoundPart {
  FoundContacts contacts;
  std::vector<KnownApart> aparts;
  std::vector<Followers> followers;
  std::vector<Blow> blows;
};

}  // namespace tweenfall::contacts
