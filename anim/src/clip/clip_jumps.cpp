#include <tweenfall/anim/clip_jumps.h>

#include "clip/differ.h"
#include "clip/each_curve.h"
#include "clip/formula_jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall {

namespace clips {
namespace {

/// Formulas are looked at over this long as often as elsewhere, s; over more, less often.
constexpr double long_clip = 3600;
constexpr int most_leaps = 10'000;

/// Times inside (0, duration] at which a curve jumps.
template <class T>
void collect(const Curve<T>& curve, double duration, std::vector<double>& jumps) {
  if (std::isfinite(duration)) {
    const double cell = std::max(1.0, duration / long_clip) / cells_per_second;
    double time = 0;
    for (int i = 0; i < most_leaps && (time = first_leap(curve, time, duration, cell)) <= duration; ++i)
      jumps.push_back(time);
  }
  for (const double knot : curve.knots())
    if (knot > 0 && knot <= duration && differ(curve.value(knot, Side::in), curve.value(knot, Side::out)))
      jumps.push_back(knot);
  // A track that repeats within its clip may jump at each of its own seams.
  const double length = curve.duration();
  if (std::isfinite(length) && length > 0 && differ(curve.value(curve.end(), Side::in), curve.value(curve.start()))) {
    constexpr int most = 1000;
    const auto plays = [](const auto& rule, int k) {
      return rule.rule == Outside::repeat && k < most && (rule.plays == 0 || k < rule.plays);
    };
    for (int k = 0; plays(curve.rule_after(), k) && curve.end() + k * length < duration; ++k)
      jumps.push_back(curve.end() + k * length);
    for (int k = 0; plays(curve.rule_before(), k) && curve.start() - k * length > 0; ++k)
      jumps.push_back(curve.start() - k * length);
  }
}

}  // namespace
}  // namespace clips

bool moves_its_node(const Track& track) {
  const Property property = clips::property_of(track);
  return property == Property::position || property == Property::rotation || property == Property::scale;
}

std::vector<double> jumps_of(const Clip& clip, const TrackFilter& counts) {
  std::vector<double> jumps;
  clips::for_each_curve(clip, counts, [&](const auto& curve, bool) { clips::collect(curve, clip.duration, jumps); });
  std::ranges::sort(jumps);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return jumps;
}

bool jumps_at_seam(const Clip& clip, LoopMode mode, double from, double to, const TrackFilter& counts) {
  if ((mode != LoopMode::repeat && mode != LoopMode::repeat_offset) || !std::isfinite(to)) return false;
  bool any = false;
  clips::for_each_curve(clip, counts, [&](const auto& curve, bool accumulates) {
    if (mode == LoopMode::repeat || !accumulates)
      any = any || clips::differ(curve.value(to, Side::in), curve.value(from, Side::out));
  });
  return any;
}

double first_jump(const Curve<double>& curve, double from, double to) {
  double first = std::numeric_limits<double>::infinity();
  const auto meet = [&](double time) {
    if (time > from && time <= to) first = std::min(first, time);
  };
  const auto jumps_at = [&](double time) {
    return clips::differ(curve.value(time, Side::in), curve.value(time, Side::out));
  };
  const double start = curve.start(), end = curve.end(), length = curve.duration();
  const Outside after = curve.after();
  const double plays = curve.rule_after().plays;
  const bool around = std::isfinite(length) && length > 0 && after != Outside::hold && after != Outside::linear;
  // Where a curve comes around, so do its jumps, the next of each within two rounds: told of the first one, for sums of
  // lengths are not exact.
  const double round = around ? std::max(1.0, std::floor((from - start) / length) - 1) : 1;
  const auto meet_later = [&](double passed) {
    for (double more = 0; around && more < 4; ++more) {
      const double its = round + more;
      const bool is_backwards = after == Outside::pingpong && std::fmod(its, 2) != 0;
      const double since = its * length + (is_backwards ? length - passed : passed);
      if (plays == 0 || since < (1 + plays) * length) meet(start + since);
    }
  };
  for (const double knot : curve.knots()) {
    if (!jumps_at(knot)) continue;
    meet(knot);
    if (knot > start && knot < end) meet_later(knot - start);
  }
  if (std::isfinite(to)) meet(clips::first_leap(curve, from, to));
  if (around && after == Outside::repeat && clips::differ(curve.value(end, Side::in), curve.value(start))) {
    meet(end);
    meet_later(0);
  }
  return first;
}

}  // namespace tweenfall
