#pragma once

// Rules that build the spans of a run of rotation keys.

#include <tweenfall/curves/ease.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <cstddef>
#include <vector>

#include "keys/span_slopes.h"

namespace tweenfall {

namespace turns {

/// One stretch between two keys. A turn does not change its own axis, so its vector is the same in the axes of both
/// keys.
struct Stretch {
  double start, duration;  ///< s
  Quat from, to;           ///< with the signs that turning arrives at
  Vec3 way;                ///< rotation vector of the short way, in the axes of the keys
  Vec3 spin;               ///< additional whole turns, in the axes of the keys

  /// `to` with the sign at which the short way arrives.
  [[nodiscard]] Quat near_to() const noexcept { return hemisphere_aligned(to, from); }
};

}  // namespace turns

/// One run of consecutive stretches that share a rule, among all stretches of a curve.
struct TurnProblem {
  const std::vector<turns::Stretch>& stretches;
  std::size_t first, last;  ///< the run: stretches first to last - 1
  Ends ends;
  const keying::Slopes& slopes;  ///< angular velocities by the run's slope rule, axes of the keys, whole turns included
  std::vector<RotationSpan>& spans;  ///< result, appended

  /// The slopes without the whole turns, as rotation vectors over the span.
  [[nodiscard]] Vec3 leaving(std::size_t i) const noexcept { return turning(slopes.leaving, i); }
  [[nodiscard]] Vec3 arriving(std::size_t i) const noexcept { return turning(slopes.arriving, i); }
  /// Whether the stretch begins or ends at an end of the curve where no slope is required.
  [[nodiscard]] bool starts_open(std::size_t i) const noexcept { return i == 0 && ends == Ends::secant; }
  [[nodiscard]] bool ends_open(std::size_t i) const noexcept {
    return i + 1 == stretches.size() && ends == Ends::secant;
  }
  /// The neighbors of a stretch, also around a loop; null where there is none.
  [[nodiscard]] const turns::Stretch* before(std::size_t i) const noexcept {
    return i > 0 ? &stretches[i - 1] : ends == Ends::wrap ? &stretches.back() : nullptr;
  }
  [[nodiscard]] const turns::Stretch* after(std::size_t i) const noexcept {
    return i + 1 < stretches.size() ? &stretches[i + 1] : ends == Ends::wrap ? &stretches.front() : nullptr;
  }
  /// Whether to use the plain cubic with the slopes of the rule instead of slerps of slerps: all turns are about one
  /// axis, where both are the same, or there are whole turns nearby, which slerps cannot tell from none.
  [[nodiscard]] bool is_plain(std::size_t i) const noexcept;

 private:
  [[nodiscard]] Vec3 turning(const std::vector<double>& slope, std::size_t i) const noexcept {
    return stretches[i].duration * Vec3(&slope[3 * i]) - stretches[i].spin;
  }
};

namespace turns {

[[nodiscard]] inline Vec4 padded(const Vec3& v) noexcept {
  return {v.x(), v.y(), v.z(), 0};
}

/// A span across the stretch with its spin, at rest.
[[nodiscard]] inline RotationSpan blank_span(const Stretch& stretch) {
  RotationSpan span{};
  span.start = stretch.start;
  span.duration = stretch.duration;
  span.from = stretch.from;
  span.end = stretch.to;
  span.spin = stretch.from * stretch.spin;
  for (Vec4& c : span.coefficients) c.setZero();
  return span;
}

/// The cubic of rotation vectors with the angular velocities at its ends, as `leaving` and `arriving` give them.
[[nodiscard]] RotationSpan cubic_turn(const Stretch& stretch, const Vec3& leaving, const Vec3& arriving);

/// The turn rules of the slope rules that have one.
void de_casteljau(const TurnProblem& problem);
void natural(const TurnProblem& problem);

/// Slerps of slerps between four control rotations, the first and last of them passed.
void set_de_casteljau(RotationSpan& span, const Quat& a, const Quat& b, const Quat& c, const Quat& d);

}  // namespace turns

}  // namespace tweenfall
