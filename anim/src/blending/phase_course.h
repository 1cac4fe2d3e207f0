#pragma once

// How far a phase comes while the shares of its clips change.
//
// The pace, in seconds per phase, depends on the time by the shares and on the phase by the clips. It is smooth between
// whole phases, at which clips have their markers: so the time is integrated over the phase from marker to marker, and
// only the last piece, which ends where the time does, is integrated the other way about.

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::blending {

struct CoursePlace {
  double phase = 0;
  double time = 0;  ///< s
};

/// The change of y over a short stretch of x by the modified midpoint rule, extrapolated until it stays the same.
/// Source: Bulirsch and Stoer, "Numerical Treatment of Ordinary Differential Equations by Extrapolation Methods", 1966.
/// @param rate of y, from x and y
template <class Rate>
[[nodiscard]] double integrated(const Rate& rate, double x, double y, double length) noexcept {
  constexpr std::array<int, 6> parts{2, 4, 6, 8, 10, 12};
  std::array<double, parts.size()> found{};
  for (std::size_t j = 0; j < parts.size(); ++j) {
    const double step = length / parts[j];
    double correction = 0;
    double before = 0, here = step * rate(x, y);
    for (int k = 1; k < parts[j]; ++k) {
      const double next = before + 2 * step * rate(x + k * step, y + here);
      before = here;
      here = next;
    }
    found[j] = 0.5 * (before + here + step * rate(x + length, y + here));
    for (std::size_t k = j; k-- > 0;) {
      const double ratio = static_cast<double>(parts[j]) / parts[k];
      correction = (found[k + 1] - found[k]) / (ratio * ratio - 1);
      found[k] = found[k + 1] + correction;
    }
    if (j > 0 && std::abs(correction) <= 1e-15 * std::abs(found[0])) break;
  }
  return found[0];
}

/// `Pace` gives the seconds per phase, above 0, from a time and a phase.
template <class Pace>
class PhaseCourse {
 public:
  /// @param end time at which it ends, s; below 0 the phase goes back.
  PhaseCourse(const Pace& pace, double end) : pace_(pace), end_(end), way_(end < 0 ? -1 : 1) {}

  /// The place at the end of the time, or at a phase that comes before.
  [[nodiscard]] CoursePlace until(CoursePlace at, double phase) const noexcept {
    while (at.phase != phase && at.time != end_) {
      const double marker = way_ * (std::floor(way_ * at.phase) + 1);
      const Calm calm = calm_after(at, way_ * std::min(way_ * phase, way_ * marker));
      const double to = calm.end;
      if (to == at.phase) return {at.phase, end_};  // too short a time for the phase to move
      // Where even the least pace takes too long, the time ends first.
      if (!(way_ * (to - at.phase) * calm.least > little * (way_ * (end_ - at.time)))) {
        const double time =
            at.time + integrated([&](double p, double t) { return pace_(t, p); }, at.phase, at.time, to - at.phase);
        if (way_ * time < way_ * end_) {
          at = {to, time};
          continue;
        }
      }
      const double left = end_ - at.time;
      const double gone = integrated([&](double t, double p) { return 1 / pace_(t, p); }, at.time, at.phase, left);
      return {at.phase + gone, end_};
    }
    return at;
  }

 private:
  static constexpr double little = 1.25;
  struct Calm {
    double end;    // phase
    double least;  // pace seen up to there
  };
  /// Halves the way until the pace changes little over it, so that the integration is good to rounding.
  [[nodiscard]] Calm calm_after(const CoursePlace& at, double to) const noexcept {
    const double first = pace_(at.time, at.phase);
    // Much further than the time lasts at this pace need not be looked at.
    const double enough = at.phase + 2 * (end_ - at.time) / first;
    if (way_ * enough < way_ * to) to = enough;
    while (to != at.phase) {
      const double middle = at.phase + (to - at.phase) / 2;
      const double last = pace_(at.time, to);
      const double passed = (to - at.phase) * std::max(first, last);
      const double time = way_ * std::min(way_ * (at.time + passed), way_ * end_);
      const auto [least, most] =
          std::minmax({first, last, pace_(at.time, middle), pace_(time, middle), pace_(time, to)});
      if (most <= little * least) return {to, least};
      to = middle;
    }
    return {to, first};
  }

  const Pace& pace_;
  double end_, way_;
};

}  // namespace tweenfall::blending
