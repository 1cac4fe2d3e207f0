#include "clip/landing.h"

#include "clip/differ.h"

#include <cmath>

namespace tweenfall::clips {

namespace {

/// What the curves of a clip do at its end.
struct AtEnd {
  double time;
  bool lands = false, begins_anew = false;

  template <class T>
  void look_at(const Curve<T>& curve) {
    if (!differ(curve.value(time, Side::in), curve.value(time))) return;
    const bool ends = curve.after() == Outside::hold || curve.after() == Outside::linear;
    (ends ? lands : begins_anew) = true;
  }
  template <class T>
  void look_at(const StepCurve<T>& curve) {
    lands = lands || differ(curve.value(time, Side::in), curve.value(time, Side::out));
  }
  void look_at(const WeightCurves& curves) {
    for (const Curve<double>& curve : curves) look_at(curve);
  }
};

}  // namespace

bool lands_on_last_key(const Clip& clip) noexcept {
  if (!std::isfinite(clip.duration)) return false;
  AtEnd end{.time = clip.duration};
  for (const Track& track : clip.tracks) std::visit([&](const auto& curve) { end.look_at(curve); }, track.curve);
  return end.lands && !end.begins_anew;
}

}  // namespace tweenfall::clips
