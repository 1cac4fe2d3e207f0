#include "motion/track_survey.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::cli {

namespace {

double length(double rate) {
  return std::abs(rate);
}
template <class Vector>
double length(const Vector& rate) {
  return rate.norm();
}

double distance(double a, double b) {
  return std::abs(a - b);
}
double distance(const Color& a, const Color& b) {
  return (a.rgba - b.rgba).norm();
}
double distance(const Quat& a, const Quat& b) {
  return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}
template <class Vector>
double distance(const Vector& a, const Vector& b) {
  return (a - b).norm();
}

double size(double value) {
  return std::abs(value);
}
double size(const Color& value) {
  return value.rgba.norm();
}
double size(const Quat&) {
  return 1;
}
template <class Vector>
double size(const Vector& value) {
  return value.norm();
}

/// Greatest speed in a stretch without knots: searched on a fine grid, then narrowed by thirds around the best.
template <class T>
void search_speed(const Curve<T>& curve, double from, double to, TrackSurvey& found) {
  // A span between keys turns a few times at most; a formula may swing often.
  const int grid = curve.knots().empty() ? 2000 : 32;
  constexpr int rounds = 40;
  const auto try_at = [&](double time, Side side) {
    const double speed = length(curve.rate(time, side));
    if (speed > found.top_speed) {
      found.top_speed = speed;
      found.top_speed_at = time;
    }
    return speed;
  };
  try_at(from, Side::out);
  try_at(to, Side::in);
  int best = 1;
  double best_speed = -1;
  for (int i = 1; i < grid; ++i) {
    const double speed = try_at(from + (to - from) * i / grid, Side::out);
    if (speed <= best_speed) continue;
    best_speed = speed;
    best = i;
  }
  double low = from + (to - from) * (best - 1) / grid, high = from + (to - from) * (best + 1) / grid;
  for (int i = 0; i < rounds; ++i) {
    const double third = (high - low) / 3;
    if (try_at(low + third, Side::out) < try_at(high - third, Side::out))
      low += third;
    else
      high -= third;
  }
}

struct Surveyor {
  double end;  ///< of the clip, s

  template <class T>
  TrackSurvey operator()(const Curve<T>& curve) const {
    TrackSurvey found;
    const auto knots = curve.knots();
    found.keys = curve.key_times().size();
    found.from = curve.start();
    found.to = curve.end();
    std::vector<double> ends{0};
    for (const double knot : knots)
      if (knot > 0 && knot < end) ends.push_back(knot);
    ends.push_back(end);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) search_speed(curve, ends[i], ends[i + 1], found);
    // Rounding in evaluation is no jump: differences are compared with the size of the values, and with the top speed.
    constexpr double same = 1e-9;
    for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
      const Sample<T> in = curve.sample(knots[i], Side::in), out = curve.sample(knots[i], Side::out);
      if (distance(in.value, out.value) > same * std::max(1.0, size(out.value)))
        found.value_jumps.push_back(knots[i]);
      else if (distance(in.rate, out.rate) > same * std::max(1.0, found.top_speed))
        found.slope_jumps.push_back(knots[i]);
    }
    return found;
  }

  TrackSurvey operator()(const WeightCurves& curves) const {
    TrackSurvey all;
    bool first = true;
    for (const Curve<double>& curve : curves) {
      const TrackSurvey one = (*this)(curve);
      all.keys = std::max(all.keys, one.keys);
      all.from = first ? one.from : std::min(all.from, one.from);
      all.to = first ? one.to : std::max(all.to, one.to);
      if (one.top_speed > all.top_speed) {
        all.top_speed = one.top_speed;
        all.top_speed_at = one.top_speed_at;
      }
      unite(all.value_jumps, one.value_jumps);
      unite(all.slope_jumps, one.slope_jumps);
      first = false;
    }
    return all;
  }

  template <class T>
  TrackSurvey operator()(const StepCurve<T>& curve) const {
    TrackSurvey found;
    found.keys = curve.steps().size();
    found.from = curve.steps().front().first;
    found.to = curve.steps().back().first;
    return found;
  }

  static void unite(std::vector<double>& times, const std::vector<double>& more) {
    times.insert(times.end(), more.begin(), more.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
  }
};

}  // namespace

TrackSurvey survey(const Track& track, const Clip& clip, double endless) {
  return std::visit(Surveyor{std::isfinite(clip.duration) ? clip.duration : endless}, track.curve);
}

}  // namespace tweenfall::cli
