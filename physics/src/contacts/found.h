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
};

}  // namespace tweenfall::contacts
