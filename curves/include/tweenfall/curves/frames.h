#pragma once

/// Axes that travel along a curve in space: what a camera, a tube or a train needs besides the position.
///
/// The tangent is exact. Frenet's frame leans into the bend, and flips or fails where the curve is straight; a
/// rotation-minimizing frame never turns about its tangent, so nothing swept along it is twisted.

#include <tweenfall/curves/curve.h>

#include <optional>
#include <span>
#include <vector>

namespace tweenfall {

/// Three unit axes at right angles, right-handed: binormal = tangent x normal.
struct Frame {
  Vec3 position{0, 0, 0};  ///< m
  Vec3 tangent{1, 0, 0};   ///< along the curve, forwards
  Vec3 normal{0, 1, 0};
  Vec3 binormal{0, 0, 1};
};

/// 1 over the radius of the circle that fits best, 1/m; 0 where the curve rests.
[[nodiscard]] double curvature(const Sample<Vec3>& sample) noexcept;

/// The frame whose normal points to the center of the bend; empty where the curve rests or does not bend.
[[nodiscard]] std::optional<Frame> frenet_frame(const Curve<Vec3>& curve, double time, Side side = Side::out) noexcept;

struct FrameOptions {
  std::optional<Vec3> normal{};  ///< of the first frame; its part along the tangent is removed. Absent: any
  double twist = 0;              ///< radians about the tangent, spread evenly along the way from first to last
  bool closed = false;           ///< the last frame equals the first; the turn missing for that is spread along the way
};

/// Frames at `times`, none of which turns about its tangent on the way from the one before.
///
/// The error of their angle shrinks with the fourth power of the step; on a plane curve there is none. Where the curve
/// rests, the tangent is the direction in which it sets out, or the tangent at the time before. Source: Wang, Juettler,
/// Zheng and Liu, "Computation of rotation minimizing frames", 2008 (double reflection).
/// @param times  s, increasing
/// @throws std::invalid_argument for no times, times not increasing, or a first normal along the tangent.
[[nodiscard]] std::vector<Frame> rotation_minimizing_frames(const Curve<Vec3>& curve, std::span<const double> times,
                                                            const FrameOptions& options = {});

}  // namespace tweenfall
