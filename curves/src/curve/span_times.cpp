#include "curve/span_times.h"

namespace tweenfall {

SpanTimes::SpanTimes(std::span<const double> knots) : knots_(knots.begin(), knots.end()) {
  const std::size_t count = knots_.size() - 1;
  inverses_.resize(count);
  for (std::size_t i = 0; i < count; ++i) inverses_[i] = 1 / duration(i);
  if (count == 1) return;
  bucket_scale_ = static_cast<double>(2 * count) / (end() - start());
  buckets_.assign(2 * count + 1, 0);
  for (std::size_t i = 0; i < count; ++i) ++buckets_[bucket(knots_[i]) + 1];
  for (std::size_t b = 1; b < buckets_.size(); ++b) buckets_[b] += buckets_[b - 1];
}

std::shared_ptr<const SpanTimes> spans::shared_times(std::span<const double> knots) {
  static thread_local std::weak_ptr<const SpanTimes> last;
  std::shared_ptr<const SpanTimes> times = last.lock();
  if (!times || !std::ranges::equal(times->knots(), knots)) {
    times = std::make_shared<const SpanTimes>(knots);
    last = times;
  }
  return times;
}

}  // namespace tweenfall
