#pragma once

#include <span>
#include <vector>

#include "state/body.h"
#include "step/contact_constraint.h"
#include "step/islands.h"
#include "step/spring_row.h"

namespace tweenfall::step {

/// What holds the bodies of one island together. Islands share only bodies that nothing moves, so that what one does
/// depends on no other.
struct IslandContents {
  std::span<ContactConstraint* const> contacts;  ///< by pair
  std::span<SpringRow* const> springs;
};

/// Sorts contacts and stiff springs by islands.
class IslandSorter {
 public:
  /// By the smallest index of a movable body; what is returned refers to the arguments and to this.
  const std::vector<IslandContents>& sort(const std::vector<state::Body>& bodies, Islands& islands,
                                          std::vector<ContactConstraint>& contacts, std::vector<SpringRow>& springs);

 private:
  struct Entry {
    std::uint32_t island, number;
  };
  std::vector<Entry> contact_entries_, spring_entries_;
  std::vector<ContactConstraint*> contacts_;
  std::vector<SpringRow*> springs_;
  std::vector<IslandContents> islands_;
};

}  // namespace tweenfall::step
