#pragma once

// How the size of a body settles after it is handed back: position and rotation settle by their `SettleOffset`.

#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/settle.h>
#include <tweenfall/physics/handoff/rule.h>

#include <array>

namespace tweenfall::staging {

/// The difference between the scale that is shown and that of the path, along each axis.
struct SizeOffset {
  Settle settle = {};
  double start = 0;  ///< s
  bool any = false;
  Vec3 shown{1, 1, 1}, rate{0, 0, 0};  ///< what the dead blend extrapolates
  std::array<QuinticDecay, 3> quintic{};
  std::array<SpringDecay, 3> spring{};
};

[[nodiscard]] SizeOffset size_offset(const Settle& settle, double time, const Motion& path, const Motion& shown);
/// The scale of a path at `time`, and its rate, with what is left of the offset.
[[nodiscard]] Sample<Vec3> settled_size(const SizeOffset& offset, double time, const Motion& path) noexcept;

}  // namespace tweenfall::staging
