#pragma once

// The times at which the spans of a curve begin, and the search for the one that holds a time.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tweenfall {

class SpanTimes {
 public:
  explicit SpanTimes(std::span<const double> knots);

  [[nodiscard]] std::span<const double> knots() const noexcept { return knots_; }
  [[nodiscard]] std::size_t count() const noexcept { return inverses_.size(); }  ///< of spans
  [[nodiscard]] double start() const noexcept { return knots_.front(); }
  [[nodiscard]] double end() const noexcept { return knots_.back(); }
  [[nodiscard]] double duration(std::size_t i) const noexcept { return knots_[i + 1] - knots_[i]; }
  [[nodiscard]] double inverse(std::size_t i) const noexcept { return inverses_[i]; }  ///< of the duration

  /// Where in span i `time` lies, 0 to 1.
  [[nodiscard]] double position(std::size_t i, double time) const noexcept {
    return std::min((time - knots_[i]) * inverses_[i], 1.0);
  }

  /// Index of the span that leaves the last knot at or before `time`, for start <= time < end.
  [[nodiscard]] std::size_t locate(double time) const noexcept {
    if (inverses_.size() == 1) return 0;
    const std::size_t b = bucket(time);
    std::size_t low = buckets_[b], high = buckets_[b + 1];  // knots below the bucket, and up to its end
    // Without a branch that depends on the time; a knot beyond the bucket is later than `time` anyway.
    if (high - low <= 1) return low + (knots_[low] <= time ? 1 : 0) - 1;
    while (high - low > 4) {
      const std::size_t middle = (low + high) / 2;
      (knots_[middle] <= time ? low : high) = knots_[middle] <= time ? middle + 1 : middle;
    }
    while (low < high && knots_[low] <= time) ++low;
    return low - 1;
  }

 private:
  [[nodiscard]] std::size_t bucket(double time) const noexcept {
    const double b = (time - knots_.front()) * bucket_scale_;
    const std::size_t last = buckets_.size() - 2;
    return b < static_cast<double>(last) ? static_cast<std::size_t>(b) : last;
  }

  std::vector<double> knots_;  // one more than there are spans
  std::vector<double> inverses_;
  // Buckets are equal shares of the duration; entry b counts the knots in the buckets below b. There are two buckets
  // per span, so that evenly spaced keys never share one.
  std::vector<std::uint32_t> buckets_;
  double bucket_scale_ = 0;
};

namespace spans {

/// The times of `knots`, shared by curves made in succession with the same knots, as in many clips.
[[nodiscard]] std::shared_ptr<const SpanTimes> shared_times(std::span<const double> knots);

}  // namespace spans

}  // namespace tweenfall
