#pragma once

/// The curves that move many things, sampled together: positions, rotations and scales, each with its rate.
///
/// Curves are shared and not copied. Curves with the same knots are searched for a time only once, and accelerations
/// are not computed. The numbers are those of `Curve::sample`, to the bit.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/pose.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall {

class SpanTimes;

class MotionCurves {
 public:
  /// What moves one thing; parts that are null are left as they are.
  struct Parts {
    const Curve<Vec3>* position = nullptr;
    const Curve<Quat>* rotation = nullptr;
    const Curve<Vec3>* scale = nullptr;
  };

  /// @param target  index of the thing's motion among those that `sample` writes
  void add(std::size_t target, const Parts& parts);

  [[nodiscard]] std::size_t size() const noexcept { return things_.size(); }

  /// All things at any finite `time`; `motions[target]` is written. Rates are multiplied by `rate`.
  void sample(double time, Side side, double rate, std::span<Motion> motions) const noexcept;

  /// One of the things, by its number in the order in which they were added.
  void sample_one(std::size_t thing, double time, Side side, double rate, Motion& motion) const noexcept;

 private:
  // A curve in the form stored here, if its spans are all of one degree and without a warp.
  struct Channel {
    const SpanTimes* times = nullptr;  // null: the curve itself is sampled
    const Vec3* rows = nullptr;
    const Quat* starts = nullptr;  // rotations only
    std::int32_t curve = -1;       // -1: there is none
    std::int32_t degree = 0;
    bool passed = false;  // rows are values and rates at knots instead of coefficients
  };
  struct Thing {
    std::size_t target;
    Channel position, rotation, scale;
  };
  class Sampler;

  [[nodiscard]] Channel channel_of(const Curve<Vec3>* curve);
  [[nodiscard]] Channel channel_of(const Curve<Quat>* curve);

  std::vector<Thing> things_;
  std::vector<Curve<Vec3>> vectors_;
  std::vector<Curve<Quat>> rotations_;
};

}  // namespace tweenfall
