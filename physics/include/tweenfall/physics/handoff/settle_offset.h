#pragma once

/// The bridge from where a body is to where its path wants it.
///
/// At the hand-back, the difference in pose and twist is kept as an offset that dies away as
/// `Settle` says. It is part of the path and not a state of the body, so that colliders follow it, and pose and
/// velocity are continuous at its start and, for the quintic and the dead blend, at its end.

#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/settle.h>
#include <tweenfall/physics/handoff/rule.h>

#include <array>

namespace tweenfall {

namespace saving {
struct PathFields;
}

class SettleOffset {
 public:
  SettleOffset() = default;  ///< no offset

  /// Starts at `time` with exactly `body`, while the path is at `path`; both of the node's origin, world axes.
  SettleOffset(const Settle& settle, double time, const Motion& path, const Motion& body);

  /// `path`, the path's motion at `time`, with the offset at that time applied.
  [[nodiscard]] Motion apply(double time, const Motion& path) const noexcept;

  [[nodiscard]] const Settle& settle() const noexcept { return settle_; }

  /// Whether nothing is left of it: exactly nothing, or of a spring, after 60 half-lives, less than rounding.
  [[nodiscard]] bool over(double time) const noexcept;

 private:
  friend struct saving::PathFields;
  Settle settle_ = {};
  double start_ = 0;
  bool any_ = false;
  Motion body_ = {};                       ///< what the dead blend extrapolates
  std::array<QuinticDecay, 6> quintic_{};  ///< x, y, z, then the parts of the rotation vector, world axes
  std::array<SpringDecay, 6> spring_{};
  struct Extrapolated {
    double value = 0, rate = 0;
  };
  std::array<Extrapolated, 3> extrapolated_{};  ///< for the dead blend: the parts of the rotation vector
};

}  // namespace tweenfall
