#pragma once

#include "state/body.h"
#include "state/ignored_pairs.h"

namespace tweenfall::pairs {

/// Which pairs may meet at all, wherever they are.
struct PairFilter {
  const std::vector<state::Body>& bodies;
  const state::IgnoredPairs& ignored;

  [[nodiscard]] bool lets(std::uint32_t a, std::uint32_t b) const {
    const state::Body &first = bodies[a], &second = bodies[b];
    return first.may_meet(second) && !first.sensor() && !second.sensor() && !ignored.contains(a, b);
  }
};

}  // namespace tweenfall::pairs
