#pragma once

// A number of an operation, bound to its parameter.

#include <tweenfall/curves/calculus.h>

#include "blending/heading.h"
#include "graph/log.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

namespace tweenfall::graphs {

class Number {
 public:
  Number() = default;
  explicit Number(double constant) : constant_(constant) {}
  explicit Number(Curve<double> curve) : curve_(std::move(curve)) {}
  Number(const GraphDescription& description, std::size_t parameter)
      : description_(&description), parameter_(parameter) {}

  [[nodiscard]] Sample<double> sample(const Log& log, double time, Side side) const noexcept {
    if (curve_) return curve_->sample(time, side);
    if (description_) return sample_of(log, *description_, parameter_, time, side);
    return {constant_, 0, 0};
  }

  /// Whether it may change from a time until the next setting or `first_change`.
  [[nodiscard]] bool flows(const Log& log, double time, Side side) const noexcept {
    if (curve_) return changes(*curve_, time);
    return description_ && graphs::flows(log, *description_, parameter_, time, side);
  }
  /// After how many seconds its keys come around; infinity where they do not.
  [[nodiscard]] double round() const noexcept {
    if (curve_) return round_of(*curve_);
    if (!description_ || !description_->parameters[parameter_].curve) return std::numeric_limits<double>::infinity();
    return round_of(*description_->parameters[parameter_].curve);
  }
  /// When keys that come later begin to change it; infinity for none.
  [[nodiscard]] double first_change(double after) const noexcept {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (curve_) return graphs::first_change(*curve_, after);
    if (!description_ || !description_->parameters[parameter_].curve) return never;
    return graphs::first_change(*description_->parameters[parameter_].curve, after);
  }
  /// When it was last set or keys began to change it, up to a time; -infinity for never.
  [[nodiscard]] double last_change(const Log& log, double time) const noexcept {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!curve_ && !description_) return -never;
    const std::optional<Curve<double>>& keys = curve_ ? curve_ : description_->parameters[parameter_].curve;
    if (keys) return keys->start() <= time ? keys->start() : -never;
    const Record<Setting>& settings = log.settings[parameter_];
    const auto next = std::ranges::upper_bound(settings, std::min(time, log.until), {}, &Setting::time);
    return next == settings.begin() ? -never : std::prev(next)->time;
  }
  /// The first time after `after` at which it is set; infinity for none.
  [[nodiscard]] double next_setting(const Log& log, double after) const noexcept {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!description_) return never;
    const Record<Setting>& settings = log.settings[parameter_];
    const auto next = std::ranges::upper_bound(settings, after, {}, &Setting::time);
    return next == settings.end() || next->time > log.until ? never : next->time;
  }
  /// The first setting that is hidden while looking ahead; infinity for none.
  [[nodiscard]] double first_unseen(const Log& log) const noexcept {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (!description_ || log.until == never) return never;
    const Record<Setting>& settings = log.settings[parameter_];
    const auto next = std::ranges::upper_bound(settings, log.until, {}, &Setting::time);
    return next == settings.end() ? never : next->time;
  }

  /// Whether it is a keyed curve that is never above 0.
  [[nodiscard]] bool is_nothing_throughout() const {
    if (!curve_ || curve_->knots().empty()) return false;
    const std::span<const double> knots = curve_->knots();
    const double last = knots.back() + std::max(1.0, knots.back() - knots.front());
    return range(*curve_, knots.front() - 1, last).high <= 0;
  }
  /// Its value if it never changes; else empty.
  [[nodiscard]] std::optional<double> constant() const noexcept {
    return curve_ || description_ ? std::nullopt : std::optional(constant_);
  }

 private:
  double constant_ = 1;
  std::optional<Curve<double>> curve_{};
  const GraphDescription* description_ = nullptr;
  std::size_t parameter_ = 0;
};

/// Numbers below 0 become 0, at rest; exactly at 0 the sign just before or just after decides.
[[nodiscard]] inline Sample<double> as_weight(const Sample<double>& number, Side side) noexcept {
  return blending::heading(number, side) < 0 ? Sample<double>{0, 0, 0} : number;
}

/// Numbers outside 0 to 1 are clamped, in the same way.
[[nodiscard]] inline Sample<double> as_share(const Sample<double>& number, Side side) noexcept {
  const Sample<double> left{1 - number.value, -number.rate, -number.acceleration};
  return blending::heading(left, side) < 0 ? Sample<double>{1, 0, 0} : as_weight(number, side);
}

[[nodiscard]] inline Sample<double> product(const Sample<double>& a, const Sample<double>& b) noexcept {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}
/// 1 minus the weight.
[[nodiscard]] inline Sample<double> rest_of(const Sample<double>& weight) noexcept {
  return {1 - weight.value, -weight.rate, -weight.acceleration};
}

[[nodiscard]] inline bool is_nothing(const Sample<double>& weight) noexcept {
  return weight.value == 0 && weight.rate == 0;
}
[[nodiscard]] inline bool is_whole(const Sample<double>& weight) noexcept {
  return weight.value == 1 && weight.rate == 0;
}

}  // namespace tweenfall::graphs
