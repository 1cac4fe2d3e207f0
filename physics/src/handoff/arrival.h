#pragma once

// What arrives at an instant at which a script bends or jumps.

#include <tweenfall/physics/handoff/path.h>

#include <algorithm>
#include <limits>

namespace tweenfall::handing_over {

/// So little before an instant that nothing moves in between, and so much that no clock, as it rounds, is already
/// behind what happens at that instant.
[[nodiscard]] inline double just_before(double instant) noexcept {
  return std::max(0.0, instant - 16 * std::numeric_limits<double>::epsilon() * (1 + instant));
}

/// The same motion some seconds later, at its own velocity.
[[nodiscard]] Motion carried_on(Motion motion, double seconds) noexcept;

/// `path.world(instant, Side::in)`. Where the path bends or jumps at that instant and its clock, as it rounds, is
/// already behind that: what there was just before.
[[nodiscard]] WorldMotion arriving(const Path& path, double instant) noexcept;

}  // namespace tweenfall::handing_over
