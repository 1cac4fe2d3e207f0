#include <tweenfall/curves/batch.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "curve_data.h"
#include "polynomial.h"

namespace tweenfall {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_size(std::size_t given, std::size_t wanted, const char* what) {
  if (given != wanted)
    throw std::invalid_argument("a batch of " + std::to_string(wanted) + " curves needs as many " + what + "; " +
                                std::to_string(given) + " were given");
}

template <class Data>
bool is_plain(const Data& data) {
  return !data.segments.empty() && data.warps.empty() && data.before.rule.rule == Outside::hold &&
         data.after.rule.rule == Outside::hold &&
         std::all_of(data.segments.begin(), data.segments.end(), [](const Segment& s) { return s.degree <= 3; });
}

// 1 from the stretch's end on, and where `start` is infinitely early.
double position(double time, double start, double inverse) noexcept {
  const double s = (time - start) * inverse;
  return s < 1 ? s : 1;
}

}  // namespace

CurveBatch::CurveBatch(std::span<const Curve<double>> curves) {
  const auto add = [&](double start, const Cubic& cubic) {
    starts_.push_back(start);
    cubics_.push_back(cubic);
  };
  for (const Curve<double>& curve : curves) {
    const auto& data = CurveAccess::data(curve);
    Track track{};
    track.first = static_cast<std::uint32_t>(starts_.size());
    track.start = track.end = infinity;
    if (is_plain(data)) {
      track.start = data.start;
      track.end = data.end;
      track.bucket = static_cast<std::uint32_t>(buckets_.size());
      track.buckets = static_cast<std::uint32_t>(data.buckets.size());
      track.bucket_scale = data.bucket_scale;
      buckets_.insert(buckets_.end(), data.buckets.begin(), data.buckets.end());
      add(-infinity, {curve.value(data.start), 0, 0, 0});
      for (const Segment& segment : data.segments) {
        double c[4]{};
        std::copy_n(&data.pool[segment.first], segment.degree + 1, c);
        add(segment.start, {c[0], c[1], c[2], c[3]});
      }
      add(data.end, {curve.value(data.end), 0, 0, 0});
    } else {
      apart_.push_back({tracks_.size(), curve});
      add(-infinity, {0, 0, 0, 0});
    }
    track.last = static_cast<std::uint32_t>(starts_.size()) - 1;
    tracks_.push_back(track);
  }
  place_.resize(size());
  stale_.resize(size());
  for (std::vector<double>* column : {&start_, &end_, &inverse_, &c0_, &c1_, &c2_, &c3_}) column->resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    place_[i] = tracks_[i].first;
    remember(i);
  }
}

// The stretch of curve `i` that holds `time`.
std::uint32_t CurveBatch::locate(std::size_t i, double time) const noexcept {
  const Track& track = tracks_[i];
  // Mostly the next one.
  if (time >= end_[i] && time - end_[i] < end_[i] - start_[i] &&
      (place_[i] + 1 == track.last || time < starts_[place_[i] + 2]))
    return place_[i] + 1;
  if (time >= track.end) return track.last;
  if (time < track.start) return track.first;
  std::uint32_t low = track.first + 1, high = track.last - 1;
  if (track.buckets > 1) {
    // The buckets tell how many knots lie before a share of the duration: mostly all, or all but one, of those wanted.
    const double b = (time - track.start) * track.bucket_scale;
    const std::uint32_t top = track.buckets - 2;
    const std::uint32_t bucket = track.bucket + (b < top ? static_cast<std::uint32_t>(b) : top);
    low = track.first + buckets_[bucket];
    high = track.first + buckets_[bucket + 1];
  }
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (starts_[middle] <= time ? low : high) = middle;
  }
  // No branch, as the answer is hard to foresee.
  return low + static_cast<std::uint32_t>((high != low) & (starts_[high] <= time));
}

void CurveBatch::remember(std::size_t i) noexcept {
  const std::uint32_t place = place_[i];
  start_[i] = starts_[place];
  end_[i] = place < tracks_[i].last ? starts_[place + 1] : infinity;
  inverse_[i] = 1 / (end_[i] - start_[i]);
  const Cubic& cubic = cubics_[place];
  c0_[i] = cubic.c0;
  c1_[i] = cubic.c1;
  c2_[i] = cubic.c2;
  c3_[i] = cubic.c3;
}

void CurveBatch::sample(double time, std::span<double> values, std::span<double> rates) {
  check_size(values.size(), size(), "values");
  if (!rates.empty()) check_size(rates.size(), size(), "rates");
  const std::size_t count = size();

  // Listed first, since which ones change is hard to foresee: the processor would wait for each.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    stale_[changed] = static_cast<std::uint32_t>(i);
    changed += static_cast<std::size_t>(!((time >= start_[i]) & (time < end_[i])));
  }
  // In two rounds, so that the cubics of all are on their way from memory at once.
  for (std::size_t k = 0; k < changed; ++k) {
    const std::uint32_t place = locate(stale_[k], time);
    __builtin_prefetch(&cubics_[place]);
    place_[stale_[k]] = place;
  }
  for (std::size_t k = 0; k < changed; ++k) remember(stale_[k]);

  const double *start = start_.data(), *inverse = inverse_.data();
  const double *c0 = c0_.data(), *c1 = c1_.data(), *c2 = c2_.data(), *c3 = c3_.data();
  double* value = values.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double s = position(time, start[i], inverse[i]);
    value[i] = c0[i] + s * (c1[i] + s * (c2[i] + s * c3[i]));
  }
  if (!rates.empty()) {
    double* rate = rates.data();
    for (std::size_t i = 0; i < count; ++i)
      rate[i] = cubic_rate(c1[i], c2[i], c3[i], position(time, start[i], inverse[i])) * inverse[i];
  }
  for (const Apart& apart : apart_) {
    const Sample<double> sample = apart.curve.sample(time);
    value[apart.index] = sample.value;
    if (!rates.empty()) rates[apart.index] = sample.rate;
  }
}

}  // namespace tweenfall
