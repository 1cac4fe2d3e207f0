#pragma once

// Where formulas make the tracks of a clip jump: beside their knots.

#include <tweenfall/anim/clip_jumps.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace tweenfall::clips {

/// A formula is looked at eight times as often, per s.
inline constexpr double cells_per_second = 16;

/// The first time in (from, to] at which a curve jumps because a formula leaps; infinity for none. What the formulas do
/// between two looks may go unseen if it undoes itself.
template <class T>
[[nodiscard]] double first_leap(const Curve<T>& curve, double from, double to, double cell = 1 / cells_per_second);

/// The jumps of an endless clip's formulas, found as far as was asked. For any number of threads.
class FormulaJumps {
 public:
  /// Null where the clip ends, or none of its formulas can leap.
  [[nodiscard]] static std::shared_ptr<const FormulaJumps> of(const Clip& clip, const TrackFilter& counts = {});

  /// The first clip time in (after, until] at which a track jumps; infinity for none.
  [[nodiscard]] double next(double after, double until) const;
  /// All clip times in [from, to], in order.
  [[nodiscard]] std::vector<double> between(double from, double to) const;

 private:
  using NextLeap = std::function<double(double from, double to)>;
  explicit FormulaJumps(std::vector<NextLeap> curves) : curves_(std::move(curves)) {}
  /// Those of one second. Only with the mutex held.
  [[nodiscard]] const std::vector<double>& of_second(std::int64_t second) const;

  std::vector<NextLeap> curves_;
  mutable std::mutex mutex_;
  mutable std::map<std::int64_t, std::vector<double>> seconds_;
};

}  // namespace tweenfall::clips
