#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contacts/contact_constraint.h"
#include "state/body.h"
#include "threads/workers.h"

namespace tweenfall::islands {

/// Bodies that lay in each other when they met. Impulses that push them apart would leave them speeds: of a column, the
/// highest box gets the sum of what all contacts ask for, few passes take back only part of that, and uneven passes
/// tilt it. So in large islands such contacts press as if the bodies just touched, and the overlap is removed by
/// shifting bodies along the normals, from the ground up, without turning them. Where nothing carries them they push
/// each other apart as ever: a shift would change their angular momentum.
class ShiftedApart {
 public:
  /// Marks the contacts of an island whose overlap `shift` will remove. Only where something carries its bodies.
  static void mark(std::span<contacts::ContactConstraint* const> contacts, const threads::Workers& workers);
  /// Shifts the bodies of an island in which contacts are marked, none by more than `most` meters. Where the contacts
  /// contradict each other, as between walls, nothing is shifted, and from then on they push.
  void shift(std::span<contacts::ContactConstraint* const> contacts, std::vector<state::Body>& bodies, double most);

 private:
  /// A contact, and by how much it is to open, m; negative: by how much it may close.
  struct Opening {
    const contacts::ContactConstraint* contact;
    double width;
  };

  void find_levels(const std::vector<state::Body>& bodies);
  void sweep(const std::vector<state::Body>& bodies);
  [[nodiscard]] double missing() const;

  std::vector<Opening> openings_;
  std::vector<std::uint32_t> members_;  ///< bodies that the contacts touch
  std::vector<std::uint32_t> levels_;   ///< by body: over how many others it lies; only of the members
  std::vector<Vec3> shifts_;            ///< likewise, m
};

}  // namespace tweenfall::islands
