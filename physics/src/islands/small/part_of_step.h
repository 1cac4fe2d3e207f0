#pragma once

#include <span>
#include <vector>

#include "collision/passage.h"
#include "contacts/contact_constraint.h"
#include "forces/free_flight.h"
#include "islands/island_contents.h"

namespace tweenfall::small {

/// A contact that has none of its points yet.
[[nodiscard]] contacts::ContactConstraint looked_for_again(const contacts::ContactConstraint& before);
/// Hands the impulses on to the points of the same features.
void inherit(const contacts::ContactConstraint& before, contacts::ContactConstraint& next);
/// Of a body, or of a part of it.
[[nodiscard]] collision::Passage way_of(const state::Body& body, std::uint32_t part, const forces::Load& load,
                                        double dt);

/// A small island that goes through a step part by part, and what comes of its contacts in all of them.
class PartsOfStep {
 public:
  PartsOfStep(const islands::IslandContents& island, const std::vector<state::Body>& bodies);

  [[nodiscard]] std::span<const std::uint32_t> movable() const { return movable_; }
  /// Contacts that the part at hand found, in the island's order.
  std::vector<contacts::ContactConstraint*> near;
  /// What the last solving made of a contact.
  void add(const contacts::ContactConstraint& contact);
  void add(const contacts::ContactConstraint& contact, const Vec3& impulse, double normal, double approach);
  /// Tells it all as if it had come of one step.
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
