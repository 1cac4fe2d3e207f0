#pragma once

// What the limits of a joint allow.

#include <tweenfall/anim/joint_chain.h>

#include "chains/moving.h"

namespace tweenfall::chains {

/// By how much a rotation turns about a unit axis, -pi to pi.
[[nodiscard]] Dual twist_about(const Vec3& axis, const Turning& turn) noexcept;

/// The rotation about a unit axis that does not move.
[[nodiscard]] Turning about(const Vec3& axis, const Dual& angle) noexcept;

/// The nearest rotation that the limit allows. @param turn  from the joint's rest pose, in the axes of that
[[nodiscard]] Turning within_limits(const JointChain::Joint& joint, const Turning& turn) noexcept;

/// The middle of the range of the limit; for a joint without a limit, `turn`.
[[nodiscard]] Turning middle_of(const JointChain::Joint& joint, const Turning& turn) noexcept;

/// The axes about which a joint can turn from where it is, and how far its limit allows.
struct Freedom {
  struct Way {
    Arrow axis;             ///< unit, at right angles to the others, in the axes of the joint's rest pose
    Dual low, high;         ///< rad
    bool is_round = false;  ///< whether this way and the next are limited together, by a disc
    Dual out;               ///< then the turns are from `out` along this way, and end no farther than `high` from 0
  };
  Way ways[3];
  int count = 0;
};
[[nodiscard]] Freedom freedom_of(const JointChain::Joint& joint, const Turning& turn) noexcept;

/// A turn of the joint that brings the direction `from` toward `to`, as far as its limits allow.
[[nodiscard]] Turning turned_towards(const JointChain::Joint& joint, const Turning& turn, const Arrow& from,
                                     const Arrow& to) noexcept;

/// Turned by the rotation vector `by`.
[[nodiscard]] Turning turned_by(const JointChain::Joint& joint, const Turning& turn, const Arrow& by) noexcept;

}  // namespace tweenfall::chains
