#include "clip/landing.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tweenfall::clips {

namespace {

bool are_apart(double a, double b) {
  return std::abs(a - b) > 1e-9 * (1 + std::abs(a));
}
bool are_apart(const Quat& a, const Quat& b) {
  return (hemisphere_aligned(a, b).coeffs() - b.coeffs()).squaredNorm() > 1e-18;
}
bool are_apart(const Color& a, const Color& b) {
  return (a.rgba - b.rgba).squaredNorm() > 1e-18 * (1 + a.rgba.squaredNorm());
}
bool are_apart(bool a, bool b) {
  return a != b;
}
bool are_apart(const std::string& a, const std::string& b) {
  return a != b;
}
template <int size, int options>
bool are_apart(const Eigen::Matrix<double, size, 1, options>& a, const Eigen::Matrix<double, size, 1, options>& b) {
  return (a - b).squaredNorm() > 1e-18 * (1 + a.squaredNorm());
}

/// What the curves of a clip do at its end.
struct AtEnd {
  double time;
  bool lands = false, begins_anew = false;

  template <class T>
  void look_at(const Curve<T>& curve) {
    if (!are_apart(curve.value(time, Side::in), curve.value(time))) return;
    const bool ends = curve.after() == Outside::hold || curve.after() == Outside::linear;
    (ends ? lands : begins_anew) = true;
  }
  template <class T>
  void look_at(const StepCurve<T>& curve) {
    lands = lands || are_apart(curve.value(time, Side::in), curve.value(time, Side::out));
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
