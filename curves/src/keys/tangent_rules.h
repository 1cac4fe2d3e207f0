#pragma once

// The slopes of the tangent kinds that depend on both neighboring keys.

#include <tweenfall/curves/keys.h>

namespace tweenfall::keying {

/// One component of a key, and what lies on its two sides.
struct KeyNeighbors {
  double secant_before, secant_after;      ///< U/s
  double duration_before, duration_after;  ///< s
  double weight_in = 1.0 / 3, weight_out = 1.0 / 3;
};

/// Precondition: `kind` is automatic, flat, or one from plateau on.
[[nodiscard]] double neighbor_slope(TangentKind kind, const KeyNeighbors& key) noexcept;

/// Whether a key at which these secants meet is no higher or no lower than both its neighbors.
[[nodiscard]] bool is_extreme(double secant_before, double secant_after) noexcept;

}  // namespace tweenfall::keying
