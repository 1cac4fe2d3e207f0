#pragma once

#include <span>
#include <vector>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"
#include "forces/free_flight.h"
#include "islands/island_contents.h"

namespace tweenfall::small {

/// The same contact without its points.
[[nodiscard]] contacts::ContactConstraint looked_for_again(const contacts::ContactConstraint& before);
/// Passes the impulses on to the points of the same features.
void inherit(const contacts::ContactConstraint& before, contacts::ContactConstraint& next);
/// The passage of a body, or of a part of it.
[[nodiscard]] collision::Passage way_of(const state::Body& body, std::uint32_t part, const forces::Load& load,
                                        double dt);

/// A small island that goes through a step part by part, and the result of its contacts over all parts.
class PartsOfStep {
 public:
  PartsOfStep(const islands::IslandContents& island, const std::vector<state::Body>& bodies);

  [[nodiscard]] std::span<const std::uint32_t> movable() const { return movable_; }
  /// Contacts found for the present part, in the island's order.
  std::vector<contacts::ContactConstraint*> near;
  /// Adds the result of the last solution of a contact.
  void add(const contacts::ContactConstraint& contact) { add(contact, contact); }
  /// The same, reported by a contact of the island.
  void add(const contacts::ContactConstraint& told, const contacts::ContactConstraint& solved);
  void add(const contacts::ContactConstraint& contact, const Vec3& impulse, double normal, double approach);
  /// Reports everything as if it had happened in one step.
  void finish(double dt);

 private:
  struct Sum {
    Vec3 impulse{0, 0, 0}, rolling{0, 0, 0};
    double normal = 0, approach = 0;
    bool overlap = false;
  };
  Sum& sum_of(const contacts::ContactConstraint& contact);

  std::span<contacts::ContactConstraint* const> contacts_;
  std::vector<Sum> sums_;
  std::vector<std::uint32_t> movable_;  ///< sorted
};

}  // namespace tweenfall::small
