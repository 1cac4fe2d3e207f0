#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/marker_sync.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "blending/linear_course.h"
#include "blending/rising_root.h"
#include "blending/shares.h"

namespace tweenfall {

namespace blending {
namespace {

using Names = std::vector<std::string>;

Names names_of(const SyncClip& clip) {
  Names names;
  names.reserve(clip.markers.size());
  for (const SyncMarker& marker : clip.markers) names.push_back(marker.name);
  return names;
}

// The shortest round of which the names are repetitions.
Names round_of(const Names& names) {
  for (std::size_t length = 1; length < names.size(); ++length) {
    if (names.size() % length != 0) continue;
    bool repeats = true;
    for (std::size_t i = length; i < names.size(); ++i) repeats &= names[i] == names[i - length];
    if (repeats) return Names(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(length));
  }
  return names;
}

// The index of the marker in the round with which the names begin; the round's size where they do not repeat it.
std::size_t start_in(const Names& round, const Names& names) {
  if (names.size() % round.size() != 0) return round.size();
  for (std::size_t start = 0; start < round.size(); ++start) {
    bool same = true;
    for (std::size_t i = 0; i < names.size(); ++i) same &= names[i] == round[(start + i) % round.size()];
    if (same) return start;
  }
  return round.size();
}

std::string listed(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

// Also sorts the markers by time, where the end of the loop counts as its start.
std::string problems_of(SyncClip& clip, const std::string& name) {
  std::string problems;
  if (!(clip.duration > 0) || !std::isfinite(clip.duration))
    return "\n  the duration of " + name + " must be finite and above 0 s; it is " + number_text(clip.duration);
  for (SyncMarker& marker : clip.markers) {
    if (!(marker.time >= 0 && marker.time <= clip.duration))
      problems += "\n  the marker \"" + marker.name + "\" of " + name + " must lie within its " +
                  number_text(clip.duration) + " s; it is at " + number_text(marker.time);
    if (marker.time == clip.duration) marker.time = 0;
  }
  if (!problems.empty()) return problems;
  std::ranges::stable_sort(clip.markers, {}, &SyncMarker::time);
  for (std::size_t i = 1; i < clip.markers.size(); ++i)
    if (clip.markers[i].time == clip.markers[i - 1].time)
      problems += "\n  the markers \"" + clip.markers[i - 1].name + "\" and \"" + clip.markers[i].name + "\" of " +
                  name + " are both at " + number_text(clip.markers[i].time) + " s";
  return problems;
}

double sum_of(std::span<const double> weights) noexcept {
  double sum = 0;
  for (const double weight : weights) sum += std::max(weight, 0.0);
  return sum;
}

}  // namespace
}  // namespace blending

SyncClip sync_clip(const Clip& clip, std::string_view markers) {
  SyncClip result{.duration = clip.duration};
  for (const ClipEvent& event : clip.events)
    if (matches(markers, event.name)) result.markers.push_back({event.from, event.name});
  return result;
}

MarkerSync::MarkerSync(std::vector<SyncClip> clips) {
  std::string problems;
  if (clips.empty()) problems += "\n  there are no clips";
  blending::Names round;
  std::string leader;
  std::size_t repetitions = 1;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const std::string name = "clip " + std::to_string(i);
    const std::string own = blending::problems_of(clips[i], name);
    problems += own;
    if (!own.empty() || clips[i].markers.empty()) continue;
    const blending::Names names = blending::names_of(clips[i]);
    if (round.empty()) {
      round = blending::round_of(names);
      leader = name;
    }
    if (blending::start_in(round, names) == round.size()) {
      problems += "\n  the markers of " + name + " (" + blending::listed(names) +
                  ") are not in the same order as those of " + leader + " (" + blending::listed(round) + ")";
      continue;
    }
    repetitions = std::lcm(repetitions, names.size() / round.size());
    if (repetitions > 1000000) {
      problems += "\n  the markers of " + name + " go around so often that the clips never coincide again";
      repetitions = 1;
    }
  }
  if (!problems.empty()) throw std::invalid_argument("clips cannot be played in phase:" + problems);

  const std::size_t markers = std::max<std::size_t>(round.size(), 1);
  period_ = static_cast<double>(markers * repetitions);
  clips_.reserve(clips.size());
  for (const SyncClip& clip : clips) {
    Track track{.duration = clip.duration};
    std::vector<Stretch>& stretches = track.stretches;
    if (clip.markers.empty()) {
      const double even = clip.duration / static_cast<double>(markers);
      for (std::size_t i = 0; i < markers; ++i) stretches.push_back({static_cast<double>(i) * even, even, even, even});
    } else {
      track.first = static_cast<double>(blending::start_in(round, blending::names_of(clip)));
      const std::size_t count = clip.markers.size();
      for (std::size_t i = 0; i < count; ++i) {
        const double from = clip.markers[i].time;
        const double to = i + 1 < count ? clip.markers[i + 1].time : clip.markers[0].time + clip.duration;
        stretches.push_back({from, to - from, 0, 0});
      }
      // The harmonic mean of both sides is at most twice the lesser, so that every cubic is monotone.
      for (std::size_t i = 0; i < count; ++i) {
        Stretch& before = stretches[(i + count - 1) % count];
        const double a = before.length, b = stretches[i].length;
        before.slope_end = stretches[i].slope = a == b ? a : 2 * a / (a + b) * b;
      }
    }
    clips_.push_back(std::move(track));
  }
}

/// The time of a clip at a phase, and its derivatives with respect to the phase.
struct MarkerSync::Place {
  double time = 0;  ///< since the start of its first loop, not wrapped
  double cycle = 0;
  double first = 0, second = 0;
};

MarkerSync::Place MarkerSync::place(const Stretch& s, double f) noexcept {
  if (s.slope == s.length && s.slope_end == s.length) return {.time = s.time + s.length * f, .first = s.length};
  const double g = 1 - f;
  return {.time = s.time + (s.length * f * f * (3 - 2 * f) + s.slope * f * g * g - s.slope_end * f * f * g),
          .first = 6 * f * g * s.length + s.slope * g * (1 - 3 * f) + s.slope_end * f * (3 * f - 2),
          .second = 6 * (1 - 2 * f) * s.length + s.slope * (6 * f - 4) + s.slope_end * (6 * f - 2)};
}

MarkerSync::Place MarkerSync::place(const Track& track, double phase) noexcept {
  const double around = static_cast<double>(track.stretches.size());
  const double counted = phase - track.first, cycle = std::floor(counted / around);
  const double within = std::clamp(counted - cycle * around, 0.0, around);
  const std::size_t index = std::min(static_cast<std::size_t>(within), track.stretches.size() - 1);
  Place result = place(track.stretches[index], within - static_cast<double>(index));
  result.cycle = cycle;
  return result;
}

double MarkerSync::slope(const Track& track, double phase) noexcept {
  const double around = static_cast<double>(track.stretches.size());
  const double counted = phase - track.first, cycle = std::floor(counted / around);
  const double within = std::clamp(counted - cycle * around, 0.0, around);
  const std::size_t index = std::min(static_cast<std::size_t>(within), track.stretches.size() - 1);
  const Stretch& s = track.stretches[index];
  if (s.slope == s.length && s.slope_end == s.length) return s.length;
  const double f = within - static_cast<double>(index), g = 1 - f;
  return 6 * f * g * s.length + s.slope * g * (1 - 3 * f) + s.slope_end * f * (3 * f - 2);
}

blending::PiecePace MarkerSync::pace(const Track& track, double phase, double way) noexcept {
  const double around = static_cast<double>(track.stretches.size());
  const double marker = way > 0 ? std::floor(phase) : std::ceil(phase) - 1, counted = marker - track.first;
  const double within = std::clamp(counted - std::floor(counted / around) * around, 0.0, around - 1);
  const Stretch& s = track.stretches[static_cast<std::size_t>(within)];
  if (s.slope == s.length && s.slope_end == s.length) return {s.length, 0, 0};
  const double f = phase - marker, g = 1 - f;
  const double square = 3 * (s.slope + s.slope_end) - 6 * s.length;
  return {6 * f * g * s.length + s.slope * g * (1 - 3 * f) + s.slope_end * f * (3 * f - 2),
          6 * s.length - 4 * s.slope - 2 * s.slope_end + 2 * square * f, square};
}

double MarkerSync::phase_at(std::size_t clip, double time) const noexcept {
  const Track& track = clips_[clip];
  const std::vector<Stretch>& stretches = track.stretches;
  double around = time - std::floor(time / track.duration) * track.duration;
  if (!(around < track.duration)) around = 0;
  if (around < stretches.front().time) around += track.duration;
  const auto after = std::ranges::upper_bound(stretches, around, {}, &Stretch::time);
  const std::size_t index = static_cast<std::size_t>(after - stretches.begin()) - 1;
  const Stretch& stretch = stretches[index];
  const auto over = [&](double part) noexcept {
    const Place at = place(stretch, part);
    return blending::Rise{at.time - around, at.first};
  };
  const double part = blending::rising_root(over, 0, 1, (around - stretch.time) / stretch.length);
  const double phase = track.first + static_cast<double>(index) + part;
  return phase < period_ ? phase : phase - period_;
}

Sample<double> MarkerSync::running(double phase, std::span<const Sample<double>> weights) const noexcept {
  blending::Whole whole;
  for (const Sample<double>& weight : weights) whole.add(blending::above_nothing(weight));
  const bool even = whole.is_nothing();
  // Averaged seconds per phase, and the two parts of its rate: from the weights and from the phase itself.
  double seconds = 0, by_weights = 0, by_phase = 0;
  for (std::size_t i = 0; i < clips_.size(); ++i) {
    const Sample<double> share = even ? Sample<double>{1 / static_cast<double>(clips_.size()), 0, 0}
                                      : whole.share(blending::above_nothing(weights[i]));
    const Place at = place(clips_[i], phase);
    seconds += share.value * at.first;
    by_weights += share.rate * at.first;
    by_phase += share.value * at.second;
  }
  const double rate = 1 / seconds;
  return {phase, rate, -(by_weights + by_phase * rate) * rate * rate};
}

double MarkerSync::rate(double phase, std::span<const double> weights) const noexcept {
  double sum = 0, seconds = 0;
  for (const double weight : weights) sum += weight >= 0 ? weight : 0;
  const bool even = blending::Whole{{sum, 0, 0}}.is_nothing();
  for (std::size_t i = 0; i < clips_.size(); ++i) {
    const double weight = weights[i] >= 0 ? weights[i] : 0;
    seconds += (even ? 1 / static_cast<double>(clips_.size()) : weight / sum) * slope(clips_[i], phase);
  }
  return 1 / seconds;
}

double MarkerSync::share(std::span<const double> weights, double sum, std::size_t clip) const noexcept {
  if (!(sum > 1e-100) || !(sum < 1e300)) return 1 / static_cast<double>(clips_.size());
  return std::max(weights[clip], 0.0) / sum;
}

double MarkerSync::in_period(std::size_t clip) const noexcept {
  return clips_[clip].duration * (period_ / static_cast<double>(clips_[clip].stretches.size()));
}

double MarkerSync::seconds(std::span<const double> weights) const noexcept {
  const double sum = blending::sum_of(weights);
  double whole = 0;
  for (std::size_t i = 0; i < clips_.size(); ++i) whole += share(weights, sum, i) * in_period(i);
  return whole;
}

double MarkerSync::advanced(double phase, double seconds, std::span<const double> weights) const noexcept {
  if (seconds == 0) return phase;
  const double sum_of_weights = blending::sum_of(weights);
  // Whole periods are taken out, and put back at the end.
  const double whole = this->seconds(weights);
  const double periods = std::floor(seconds / whole), rest = seconds - periods * whole;
  if (!std::isfinite(periods * period_)) return phase;  // loops too short to be counted
  const double start = phase - std::floor(phase / period_) * period_;
  // Where clips begin is looked up once, for as many as there usually are.
  constexpr std::size_t few = 8;
  std::array<Place, few> begun;
  for (std::size_t i = 0; i < std::min(few, clips_.size()); ++i) begun[i] = place(clips_[i], start);
  const auto over = [&](double to) noexcept {
    double sum = 0, slope = 0;
    for (std::size_t i = 0; i < clips_.size(); ++i) {
      const double part = share(weights, sum_of_weights, i);
      if (part == 0) continue;
      const Place at = place(clips_[i], to), before = i < few ? begun[i] : place(clips_[i], start);
      sum += part * ((at.time - before.time) + (at.cycle - before.cycle) * clips_[i].duration);
      slope += part * at.first;
    }
    return blending::Rise{sum - rest, slope};
  };
  const double at = blending::rising_root(over, start, start + period_, start);
  return phase + ((at - start) + periods * period_);
}

double MarkerSync::advanced(double phase, double seconds, std::span<const double> from,
                            std::span<const double> to) const noexcept {
  if (std::ranges::equal(from, to)) return advanced(phase, seconds, from);
  if (seconds == 0 || !std::isfinite(seconds)) return phase;
  const double sum_from = blending::sum_of(from), sum_to = blending::sum_of(to);
  const double way = seconds > 0 ? 1 : -1, around = way * period_;
  const auto paces = [&](double at) noexcept {
    std::array<blending::PiecePace, 2> result;
    for (std::size_t i = 0; i < clips_.size(); ++i) {
      const blending::PiecePace own = pace(clips_[i], at, way);
      result[0].add(share(from, sum_from, i) / seconds, own);
      result[1].add(share(to, sum_to, i) / seconds, own);
    }
    return result;
  };
  const double start = phase - std::floor(phase / period_) * period_;
  blending::LinearPlace at = blending::along_course({start, 0}, start + around, way, paces);
  double periods = 0;
  if (at.part < 1) {
    // The pace is linear in the time, so each period multiplies the time by one number and adds another: whole periods
    // are a geometric series.
    double exponent = 0;
    for (std::size_t i = 0; i < clips_.size(); ++i)
      exponent += (share(to, sum_to, i) - share(from, sum_from, i)) * in_period(i) / std::abs(seconds);
    const double growth = std::expm1(exponent), first = at.part;
    periods = std::floor(growth == 0 ? 1 / first : std::log1p(growth / first) / exponent);
    if (!std::isfinite(periods * period_)) return phase;  // loops too short to be counted
    const double part = growth == 0 ? periods * first : first * (std::expm1(periods * exponent) / growth);
    at = blending::along_course({start, part}, start + around, way, paces);
  }
  return phase + ((at.phase - start) + periods * around);
}

SyncedTime MarkerSync::time(std::size_t clip, const Sample<double>& phase) const noexcept {
  const Track& track = clips_[clip];
  const Place at = place(track, phase.value);
  SyncedTime result;
  result.cycle = at.cycle;
  result.time = {at.time, at.first * phase.rate, at.second * phase.rate * phase.rate + at.first * phase.acceleration};
  if (!(at.time < track.duration)) {
    result.time.value = at.time - track.duration;
    result.cycle += 1;
  }
  return result;
}

}  // namespace tweenfall
