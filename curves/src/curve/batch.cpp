#include <tweenfall/curves/batch.h>

#include <algorithm>
#include <limits>
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

// 1 from the stretch's end on, and where `start` is infinitely early.
double position(double time, double start, double inverse) noexcept {
  const double s = (time - start) * inverse;
  return s < 1 ? s : 1;
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall {

CurveBatch::CurveBatch(std::span<const Curve<double>> curves) {
  const auto add = [&](double start, double end, double c0, double c1 = 0, double c2 = 0, double c3 = 0) {
    stretches_.push_back({start, end, 1 / (end - start), c0, c1, c2, c3});
  };
  double seconds = 0, spans = 0;
  for (const Curve<double>& curve : curves) {
    const auto& data = CurveAccess::data(curve);
    Track track{static_cast<std::uint32_t>(stretches_.size()), 0, spans::infinity, spans::infinity, 0};
    if (spans::is_plain(data)) {
      add(-spans::infinity, data.start, curve.value(data.start, Side::in));
      for (std::size_t i = 0; i < data.span_count(); ++i) {
        const spans::Segment segment = data.segment(i);
        double c[4]{};
        std::copy_n(&data.pool[segment.first], segment.degree + 1, c);
        add(segment.start, data.knots()[i + 1], c[0], c[1], c[2], c[3]);
      }
      add(data.end, spans::infinity, curve.value(data.end));
      track.start = data.start;
      track.end = data.end;
      track.spans_per_second = static_cast<double>(data.span_count()) / (data.end - data.start);
      seconds += data.end - data.start;
      spans += static_cast<double>(data.span_count());
    } else {
      apart_.push_back({tracks_.size(), curve});
      add(-spans::infinity, spans::infinity, 0);
    }
    track.last = static_cast<std::uint32_t>(stretches_.size()) - 1;
    tracks_.push_back(track);
  }
  if (spans > 0) stride_ = seconds / spans;
  place_.resize(size());
  stale_.resize(size());
  for (std::vector<double>* column : {&start_, &end_, &inverse_, &c0_, &c1_, &c2_, &c3_}) column->resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    place_[i] = tracks_[i].first;
    remember(i);
  }
}

// The stretch that would hold `time` if all spans were as long.
std::uint32_t CurveBatch::guess(const Track& track, double time) const noexcept {
  if (!(time >= track.start)) return track.first;
  if (time >= track.end) return track.last;
  const double spans = (time - track.start) * track.spans_per_second;
  const std::uint32_t most = track.last - track.first - 2;
  return track.first + 1 + (spans < most ? static_cast<std::uint32_t>(spans) : most);
}

// The stretch that holds `time`.
std::uint32_t CurveBatch::search(const Track& track, double time) const noexcept {
  const auto first = stretches_.begin() + track.first, last = stretches_.begin() + track.last + 1;
  const auto next = std::partition_point(first, last, [time](const Stretch& s) { return s.start <= time; });
  return static_cast<std::uint32_t>(next - stretches_.begin()) - 1;
}

void CurveBatch::remember(std::size_t i) noexcept {
  const Stretch& stretch = stretches_[place_[i]];
  start_[i] = stretch.start;
  end_[i] = stretch.end;
  inverse_[i] = stretch.inverse;
  c0_[i] = stretch.c0;
  c1_[i] = stretch.c1;
  c2_[i] = stretch.c2;
  c3_[i] = stretch.c3;
}

// For the first `count` of stale_. Each is guessed some curves ahead and mended fewer ahead, so that what they need is
// on its way from memory while others are worked at.
void CurveBatch::seek(std::size_t count, double time) noexcept {
  constexpr std::size_t ahead = 16;
  for (std::size_t k = 0; k < count + 2 * ahead; ++k) {
    if (k < count) {
      const std::uint32_t i = stale_[k];
      place_[i] = guess(tracks_[i], time);
      __builtin_prefetch(&stretches_[place_[i]]);
    }
    // Mostly it is the one guessed or one beside it; which one is hard to foresee, so there is no branch.
    if (k >= ahead && k - ahead < count) {
      std::uint32_t& place = place_[stale_[k - ahead]];
      const Stretch& guessed = stretches_[place];
      place += static_cast<std::uint32_t>(time >= guessed.end) - static_cast<std::uint32_t>(time < guessed.start);
      __builtin_prefetch(&stretches_[place]);
    }
    if (k >= 2 * ahead) {
      const std::uint32_t i = stale_[k - 2 * ahead];
      const Stretch& found = stretches_[place_[i]];
      if (time < found.start || time >= found.end) place_[i] = search(tracks_[i], time);
      remember(i);
    }
  }
}

void CurveBatch::sample(double time, std::span<double> values, std::span<double> rates) {
  spans::check_size(values.size(), size(), "values");
  if (!rates.empty()) spans::check_size(rates.size(), size(), "rates");
  const std::size_t count = size();

  // Listed first, since which ones change is hard to foresee: the processor would wait for each.
  std::size_t changed = 0;
  for (std::size_t i = 0; i < count; ++i) {
    stale_[changed] = static_cast<std::uint32_t>(i);
    changed += static_cast<std::size_t>(!(time >= start_[i])) | static_cast<std::size_t>(!(time < end_[i]));
  }
  if (time > time_ && time - time_ < stride_) {
    // Mostly the next stretch holds the time.
    for (std::size_t k = 0; k < changed; ++k) __builtin_prefetch(&stretches_[place_[stale_[k]] + 1]);
    std::size_t far = 0;
    for (std::size_t k = 0; k < changed; ++k) {
      const std::uint32_t i = stale_[k];
      if (time < stretches_[place_[i] + 1].end) {
        ++place_[i];
        remember(i);
      } else {
        stale_[far++] = i;
      }
    }
    changed = far;
  }
  seek(changed, time);
  time_ = time;

  const double *start = start_.data(), *inverse = inverse_.data();
  const double *c0 = c0_.data(), *c1 = c1_.data(), *c2 = c2_.data(), *c3 = c3_.data();
  double* value = values.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double s = spans::position(time, start[i], inverse[i]);
    value[i] = c0[i] + s * (c1[i] + s * (c2[i] + s * c3[i]));
  }
  if (!rates.empty()) {
    double* rate = rates.data();
    for (std::size_t i = 0; i < count; ++i)
      rate[i] = math::cubic_rate(c1[i], c2[i], c3[i], spans::position(time, start[i], inverse[i])) * inverse[i];
  }
  for (const Apart& apart : apart_) {
    const Sample<double> sample = apart.curve.sample(time);
    value[apart.index] = sample.value;
    if (!rates.empty()) rates[apart.index] = sample.rate;
  }
}

}  // namespace tweenfall
