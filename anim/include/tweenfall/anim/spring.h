#pragma once

/// Springs that follow a moving target: a position or a rotation that lags behind, overshoots and comes to rest.
///
/// A spring keeps its state at the points of a fixed grid in absolute time, computed from one to the next in closed
/// form; times in between are computed from the last point and not kept. So the movement is the same, to the bit, at
/// 30, 60 or 144 frames per second. What is returned has its exact rate.

#include <tweenfall/curves/values.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tweenfall {

/// x'' = -w^2 (x - target) - 2 z w (x' - target') + gravity, w being 2 pi hz and z the damping.
struct SpringSettings {
  double hz = 4;                  ///< of the undamped spring, 1/s; 0 to 100,000, 0 for no spring
  double damping = 0.5;           ///< ratio: 0 rings forever, 1 arrives the fastest without overshooting; 0 to 100
  Vec3 gravity{0, 0, 0};          ///< acceleration that acts on it, m/s^2; it sags by gravity / w^2
  double steps_per_second = 120;  ///< of the grid; 1 to 100,000
};

/// The state of a spring relative to its target, at a point of its grid.
struct SpringState {
  std::int64_t step = 0;  ///< number of the point
  Vec3 offset{0, 0, 0};   ///< m; for a rotation its rotation vector, rad, in the same axes as the target
  Vec3 rate{0, 0, 0};     ///< of the offset, 1/s

  bool operator==(const SpringState&) const = default;
  /// 56 bytes, the same on all machines of the same byte order.
  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for another number of bytes, or numbers that are not finite
  [[nodiscard]] static SpringState from_bytes(std::span<const std::byte> bytes);
};

/// How the offset of a spring at s seconds after a point of its grid depends on the state there.
struct SpringShares {
  double offset = 1, rate = 0;                  ///< factors of the point's offset and rate in the offset
  double offset_in_rate = 0, rate_in_rate = 1;  ///< and in the rate
  double forced[4]{}, forced_in_rate[4]{};      ///< contributions of accelerations 1, s, s^2 and s^3 to both
};

class SpringFollower {
 public:
  /// @throws std::invalid_argument listing settings that are out of range
  explicit SpringFollower(const SpringSettings& settings);

  [[nodiscard]] const SpringSettings& settings() const noexcept { return settings_; }

  /// At its target, at rest relative to it. @param time s, any finite
  [[nodiscard]] SpringState at_rest(double time) const noexcept;

  /// The spring at `time`, with its velocity and acceleration. Advances the state to the last point of the grid up to
  /// then. If `time` is before the state's point, or more than four million steps after it, the state is reset to rest.
  /// Within a step the target is approximated by the quintic from its values, rates and accelerations at both ends.
  /// @param target called for times up to one step after `time`; must not throw
  [[nodiscard]] Sample<Vec3> follow(SpringState& state, double time,
                                    const std::function<Sample<Vec3>(double)>& target) const noexcept;

  /// The same for a rotation: its offset is a rotation vector, which the spring draws to zero while the target's own
  /// acceleration drives it. Exact for turns about one axis. No gravity acts on it.
  [[nodiscard]] Sample<Quat> follow(SpringState& state, double time,
                                    const std::function<Sample<Quat>(double)>& target) const noexcept;

  // The parts that chains of springs are built from.

  [[nodiscard]] double time_of(std::int64_t step) const noexcept;
  [[nodiscard]] std::int64_t step_at(double time) const noexcept;  ///< the last one up to `time`
  [[nodiscard]] SpringShares shares(double seconds) const noexcept;
  [[nodiscard]] const SpringShares& of_step() const noexcept { return of_step_; }

 private:
  SpringSettings settings_;
  double frequency_;  // rad/s
  SpringShares of_step_;
};

}  // namespace tweenfall
