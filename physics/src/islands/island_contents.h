#pragma once

#include <span>
#include <vector>

#include "contacts/contact_constraint.h"
#include "islands/islands.h"
#include "joints/joint_link.h"
#include "state/body.h"
#include "step/spring_row.h"
#include "threads/workers.h"

namespace tweenfall::islands {

/// What holds the bodies of one island together. Islands share only bodies that nothing moves, so that they
/// do not depend on each other.
struct IslandContents {
  std::span<contacts::ContactConstraint* const> contacts;  ///< by pair
  std::span<step::SpringRow* const> springs;
  std::span<joints::JointLink* const> joints;
};

/// Sorts contacts, stiff springs and joints by island.
class IslandSorter {
 public:
  /// In order of the smallest index of a movable body; the result refers to the arguments and to this.
  const std::vector<IslandContents>& sort(const std::vector<state::Body>& bodies, const Islands& islands,
                                          std::span<contacts::ContactConstraint* const> contacts,
                                          std::vector<step::SpringRow>& springs, std::vector<joints::JointLink>& links,
                                          const threads::Workers& workers);

 private:
  struct Entry {
    std::uint32_t island, number;
  };
  void sort_by_island(std::size_t bodies, std::vector<Entry>& entries);

  std::vector<std::uint32_t> starts_;  ///< by island
  std::vector<Entry> sorted_;
  std::vector<Entry> contact_entries_, spring_entries_, link_entries_;
  std::vector<contacts::ContactConstraint*> contacts_;
  std::vector<step::SpringRow*> springs_, listed_springs_;
  std::vector<joints::JointLink*> links_, listed_links_;
  std::vector<IslandContents> islands_;
};

}  // namespace tweenfall::islands
