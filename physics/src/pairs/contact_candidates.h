#pragma once

/// Chooses the points of a manifold.

#include <tweenfall/curves/values.h>

#include <cstdint>
#include <span>

namespace tweenfall::pairs {

struct ContactCandidate {
  Vec3 position;  ///< on one of the two surfaces
  double gap;
  std::uint32_t feature;
};

/// Of more than four candidates, moves four to the front: the deepest, the farthest from it, and the two that span the
/// most area to either side.
/// @param leaning  a direction in the contact's plane, fixed to a body: of equally deep candidates, the farthest along
/// it counts as deepest
/// @return how many are left, at most 4
[[nodiscard]] std::size_t reduce_to_four(std::span<ContactCandidate> candidates, const Vec3& normal,
                                         const Vec3& leaning) noexcept;

}  // namespace tweenfall::pairs
