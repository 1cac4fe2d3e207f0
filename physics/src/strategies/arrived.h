#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "contacts/contact_constraint.h"
#include "step/keyed_step.h"

namespace tweenfall::strategies {

/// The bodies of contacts as they are at the end of a step. All others have been moved when this is asked for, but
/// those that are led get there when all islands are through with the step: several islands may touch them.
class Arrived {
 public:
  Arrived(const std::vector<state::Body>& bodies, std::span<contacts::ContactConstraint* const> contacts)
      : bodies_(bodies) {
    for (const contacts::ContactConstraint* contact : contacts)
      for (const std::uint32_t index : {contact->a, contact->b})
        if (bodies[index].immovable() && bodies[index].displaces() && place_of(index) == led_.end()) {
          led_.emplace_back(index, bodies[index]);
          step::arrive(led_.back().second);
        }
  }

  [[nodiscard]] const state::Body& operator[](std::uint32_t index) const {
    const auto led = bodies_[index].immovable() ? place_of(index) : led_.end();
    return led == led_.end() ? bodies_[index] : led->second;
  }

 private:
  using Led = std::vector<std::pair<std::uint32_t, state::Body>>;
  [[nodiscard]] Led::const_iterator place_of(std::uint32_t index) const {
    return std::ranges::find(led_, index, &Led::value_type::first);
  }

  const std::vector<state::Body>& bodies_;
  Led led_;
};

}  // namespace tweenfall::strategies
