#include "clip/formula_jumps.h"

#include <tweenfall/curves/leaps.h>

#include "clip/differ.h"
#include "clip/each_curve.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::clips {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t most_in_second = 10'000;
constexpr std::size_t most_seconds = 100'000;  // kept

}  // namespace

template <class T>
double first_leap(const Curve<T>& curve, double from, double to, double cell) {
  if (leaping(curve).empty()) return never;
  // Parts may leap together so that the whole does not.
  const auto jumps_at = [&](double time) {
    return differ(curve.value(std::nextafter(time, -never), Side::in), curve.value(std::nextafter(time, never)));
  };
  double first = never;
  for (const NumberOverTime& part : leaping(curve)) {
    double begin = from;
    // Cells lie where they lie, whatever the stretch that is asked for.
    for (double count = std::floor(from / cell) + 1; begin < std::min(to, first); ++count) {
      const double end = std::min(count * cell, to);
      while (begin < end) {
        const double leap = next_leap(part, begin, end);
        if (leap <= end && jumps_at(leap)) {
          first = std::min(first, leap);
          break;
        }
        begin = leap <= end ? leap : end;
      }
      begin = end;
    }
  }
  return first;
}

template double first_leap<double>(const Curve<double>&, double, double, double);
template double first_leap<Vec2>(const Curve<Vec2>&, double, double, double);
template double first_leap<Vec3>(const Curve<Vec3>&, double, double, double);
template double first_leap<Vec4>(const Curve<Vec4>&, double, double, double);
template double first_leap<Color>(const Curve<Color>&, double, double, double);
template double first_leap<Quat>(const Curve<Quat>&, double, double, double);

std::shared_ptr<const FormulaJumps> FormulaJumps::of(const Clip& clip, const TrackFilter& counts) {
  if (std::isfinite(clip.duration)) return nullptr;
  std::vector<NextLeap> curves;
  for_each_curve(clip, counts, [&](const auto& curve, bool) {
    if (!leaping(curve).empty())
      curves.emplace_back([curve](double from, double to) { return first_leap(curve, from, to); });
  });
  if (curves.empty()) return nullptr;
  return std::shared_ptr<const FormulaJumps>(new FormulaJumps(std::move(curves)));
}

const std::vector<double>& FormulaJumps::of_second(std::int64_t second) const {
  const auto known = seconds_.find(second);
  if (known != seconds_.end()) return known->second;
  if (seconds_.size() >= most_seconds) seconds_.clear();
  std::vector<double> jumps;
  const auto end = static_cast<double>(second + 1);
  for (const NextLeap& next_leap : curves_) {
    const std::size_t least = jumps.size();
    for (double time = static_cast<double>(second); jumps.size() - least < most_in_second;) {
      time = next_leap(time, end);
      if (!(time <= end)) break;
      jumps.push_back(time);
    }
  }
  std::ranges::sort(jumps);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return seconds_.emplace(second, std::move(jumps)).first->second;
}

double FormulaJumps::next(double after, double until) const {
  // Beyond this no digit is left below a second.
  constexpr double far = 1e12;
  if (!(after < until) || std::abs(after) > far) return never;
  const std::lock_guard lock(mutex_);
  const auto last = static_cast<std::int64_t>(std::floor(std::min(until, far)));
  for (auto second = static_cast<std::int64_t>(std::ceil(after)) - 1; second <= last; ++second) {
    const std::vector<double>& jumps = of_second(second);
    const auto jump = std::ranges::upper_bound(jumps, after);
    if (jump != jumps.end()) return *jump <= until ? *jump : never;
  }
  return never;
}

std::vector<double> FormulaJumps::between(double from, double to) const {
  std::vector<double> jumps;
  for (double time = std::nextafter(from, -never); (time = next(time, to)) <= to;) jumps.push_back(time);
  return jumps;
}

}  // namespace tweenfall::clips
