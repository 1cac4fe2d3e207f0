#include <tweenfall/curves/batch.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "curve/curve_data.h"
#include "math/polynomial.h"

namespace tweenfall::spans {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_size(std::size_t given, std::size_t wanted, const char* what) {
  if (given != wanted)
    throw std::invalid_argument("a batch of " + std::to_string(wanted) + " curves needs as many " + what + "; " +
                                std::to_string(given) + " were given");
}

template <class Data>
bool is_plain(const Data& data) {
  return data.times && data.warps.empty() && data.before.rule.rule == Outside::hold &&
         data.after.rule.rule == Outside::hold &&
         std::ranges::all_of(data.kinds, [](const auto& kind) { return kind.degree <= 3; });
}

// 1 at and after the end of the stretch, and where `start` is minus infinity.
double position(double time, double start, double inverse) noexcept {
  const double s = (time - start) * inverse;
  return s < 1 ? s : 1;
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

CurveBatch::CurveBatch(std::span<const Curve<double>> curves) : tracks_(curves.size()), order_(curves.size()) {
  std::vector<std::size_t> counts;
  counts.reserve(size());
  for (const Curve<double>& curve : curves) {
    const auto& data = CurveAccess::data(curve);
    counts.push_back(spans::is_plain(data) ? data.span_count() + 2 : 1);
  }
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::stable_sort(order_, std::ranges::greater{}, [&](std::uint32_t index) { return counts[index]; });
  std::size_t total = 0;
  for (std::size_t having = size(); having > 0; total += having) {
    while (having > 0 && counts[order_[having - 1]] <= rows_.size()) --having;
    rows_.push_back(total);
  }
  stretches_.resize(total);

  double seconds = 0, spans = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Curve<double>& curve = curves[order_[i]];
    std::uint32_t number = 0;
    const auto add = [&](double start, double end, double c0, double c1 = 0, double c2 = 0, double c3 = 0) {
      stretches_[rows_[number++] + i] = {start, end, c0, c1, c2, c3};
    };
    Track& track = tracks_[i];
    track = {0, spans::infinity, spans::infinity, 0};
    const auto& data = CurveAccess::data(curve);
    if (spans::is_plain(data)) {
      add(-spans::infinity, data.start, curve.value(data.start, Side::in));
      for (std::size_t k = 0; k < data.span_count(); ++k) {
        const spans::Segment segment = data.segment(k);
        double c[4]{};
        std::copy_n(&data.pool[segment.first], segment.degree + 1, c);
        add(segment.start, data.knots()[k + 1], c[0], c[1], c[2], c[3]);
      }
      add(data.end, spans::infinity, curve.value(data.end));
      track.start = data.start;
      track.end = data.end;
      track.spans_per_second = static_cast<double>(data.span_count()) / (data.end - data.start);
      seconds += data.end - data.start;
      spans += static_cast<double>(data.span_count());
    } else {
      apart_.push_back({order_[i], curve});
      add(-spans::infinity, spans::infinity, 0);
    }
    track.last = number - 1;
  }
  if (spans > 0) stride_ = seconds / spans;
  if (std::ranges::is_sorted(order_)) order_.clear();
  place_.resize(size());
  stale_.resize(size());
  found_.resize(2 * order_.size());
  for (std::vector<double>* column : {&start_, &end_, &inverse_, &c0_, &c1_, &c2_, &c3_}) column->resize(size());
  for (std::size_t i = 0; i < size(); ++i) remember(i);
}

// The stretch that would hold `time` if all spans were equally long.
std::uint32_t CurveBatch::guess(const Track& track, double time) noexcept {
  if (!(time >= track.start)) return 0;
  if (time >= track.end) return track.last;
  const double spans = (time - track.start) * track.spans_per_second;
  const std::uint32_t most = track.last - 2;
  return 1 + (spans < most ? static_cast<std::uint32_t>(spans) : most);
}

// The stretch that holds `time`.
std::uint32_t CurveBatch::search(std::size_t track, double time) const noexcept {
  std::uint32_t first = 0, behind = tracks_[track].last + 1;  // `first` never starts later than `time`
  while (behind - first > 1) {
    const std::uint32_t middle = first + (behind - first) / 2;
    (stretch(middle, track).start <= time ? first : behind) = middle;
  }
  return first;
}

void CurveBatch::remember(std::size_t i) noexcept {
  const Stretch& found = stretch(place_[i], i);
  start_[i] = found.start;
  end_[i] = found.end;
  inverse_[i] = 1 / (found.end - found.start);
  c0_[i] = found.c0;
  c1_[i] = found.c1;
  c2_[i] = found.c2;
  c3_[i] = found.c3;
}

// Calls `found` for each of some tracks once its `place_` is the stretch that holds `time`. The guess is made and
// corrected some tracks ahead, so that what it needs is loaded from memory while other tracks are processed.
template <class TrackOf, class Found>
void CurveBatch::seek(std::size_t count, double time, const TrackOf& track_of, const Found& found) noexcept {
  constexpr std::size_t ahead = 16;
  for (std::size_t k = 0; k < count + 2 * ahead; ++k) {
    if (k < count) {
      const std::size_t i = track_of(k);
      place_[i] = guess(tracks_[i], time);
      __builtin_prefetch(&stretch(place_[i], i));
    }
    // Usually it is the stretch guessed or one beside it; which one is hard to predict, so there is no branch.
    if (k >= ahead && k - ahead < count) {
      const std::size_t i = track_of(k - ahead);
      const Stretch& guessed = stretch(place_[i], i);
      place_[i] += static_cast<std::uint32_t>(time >= guessed.end) - static_cast<std::uint32_t>(time < guessed.start);
      __builtin_prefetch(&stretch(place_[i], i));
    }
    if (k >= 2 * ahead) {
      const std::size_t i = track_of(k - 2 * ahead);
      const Stretch& near = stretch(place_[i], i);
      if (time < near.start || time >= near.end) place_[i] = search(i, time);
      found(i);
    }
  }
}

// Remembers the stretch of each curve at `time`, which is near the time before.
void CurveBatch::go_on(double time) noexcept {
  const std::size_t count = size();
  // Listed first without a branch: which ones change is hard to predict.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    stale_[changed] = static_cast<std::uint32_t>(i);
    changed += static_cast<std::size_t>(!(time >= start_[i])) | static_cast<std::size_t>(!(time < end_[i]));
  }
  if (time > time_) {
    // Usually the next stretch holds the time.
    for (std::size_t k = 0; k < changed; ++k) __builtin_prefetch(&stretch(place_[stale_[k]] + 1, stale_[k]));
    std::size_t far = 0;
    for (std::size_t k = 0; k < changed; ++k) {
      const std::uint32_t i = stale_[k];
      if (time < stretch(place_[i] + 1, i).end) {
        ++place_[i];
        remember(i);
      } else {
        stale_[far++] = i;
      }
    }
    changed = far;
  }
  seek(
      changed, time, [&](std::size_t k) { return stale_[k]; }, [&](std::size_t i) { remember(i); });
}

void CurveBatch::play(double time, double* values, double* rates) noexcept {
  const std::size_t count = size();
  for (std::size_t i = 0; i < count && !remembered_; ++i) remember(i);
  remembered_ = true;
  go_on(time);
  const double *start = start_.data(), *inverse = inverse_.data();
  const double *c0 = c0_.data(), *c1 = c1_.data(), *c2 = c2_.data(), *c3 = c3_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double s = spans::position(time, start[i], inverse[i]);
    values[i] = c0[i] + s * (c1[i] + s * (c2[i] + s * c3[i]));
  }
  if (!rates) return;
  for (std::size_t i = 0; i < count; ++i)
    rates[i] = math::cubic_rate(c1[i], c2[i], c3[i], spans::position(time, start[i], inverse[i])) * inverse[i];
}

// Remembers only the numbers of the stretches: the next time will probably be as far away.
void CurveBatch::jump(double time, double* values, double* rates) noexcept {
  remembered_ = false;
  seek(
      size(), time, [](std::size_t k) { return k; },
      [&](std::size_t i) {
        const Stretch& at = stretch(place_[i], i);
        const double inverse = 1 / (at.end - at.start), s = spans::position(time, at.start, inverse);
        values[i] = at.c0 + s * (at.c1 + s * (at.c2 + s * at.c3));
        if (rates) rates[i] = math::cubic_rate(at.c1, at.c2, at.c3, s) * inverse;
      });
}

void CurveBatch::sample(double time, std::span<double> values, std::span<double> rates) {
  spans::check_size(values.size(), size(), "values");
  if (!rates.empty()) spans::check_size(rates.size(), size(), "rates");
  double* const value = order_.empty() ? values.data() : found_.data();
  double* const rate = rates.empty() ? nullptr : order_.empty() ? rates.data() : found_.data() + size();
  if (std::abs(time - time_) < stride_)
    play(time, value, rate);
  else
    jump(time, value, rate);
  time_ = time;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    values[order_[i]] = value[i];
    if (rate) rates[order_[i]] = rate[i];
  }
  for (const Apart& apart : apart_) {
    const Sample<double> sample = apart.curve.sample(time);
    values[apart.index] = sample.value;
    if (rate) rates[apart.index] = sample.rate;
  }
}

}  // namespace tweenfall
