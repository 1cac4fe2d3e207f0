#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/frames.h>

#include <cmath>
#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::geometry {
namespace {

// Reflection steps between two requested frames.
constexpr int steps_between = 4;

// The direction at `time`; where the curve rests, the one in which it sets out or has arrived, else `fallback`.
Vec3 tangent_at(const Curve<Vec3>& curve, double time, const Vec3& fallback) {
  const bool last = time >= curve.end();
  const Sample<Vec3> s = curve.sample(time, last ? Side::in : Side::out);
  const double speed = s.rate.norm();
  if (speed > 0) {
    const Vec3 onward = s.rate / speed;
    if (last || time <= curve.start()) return onward;
    // At a kink, half way between both directions.
    const Vec3 arriving = curve.rate(time, Side::in);
    const double before = arriving.norm();
    if (!(before > 0)) return onward;
    const Vec3 both = onward + arriving / before;
    const double size = both.norm();
    return size > 1e-9 ? Vec3(both / size) : onward;
  }
  const Vec3 setting_out = last ? Vec3(-s.acceleration) : s.acceleration;
  const double pull = setting_out.norm();
  return pull > 0 ? Vec3(setting_out / pull) : fallback;
}

Vec3 across(const Vec3& v, const Vec3& tangent) {
  const Vec3 part = v - v.dot(tangent) * tangent;
  return part / part.norm();
}

Vec3 any_normal(const Vec3& tangent) {
  Eigen::Index least = 0;
  tangent.cwiseAbs().minCoeff(&least);
  Vec3 axis(0, 0, 0);
  axis[least] = 1;
  return across(axis, tangent);
}

Vec3 first_normal(const FrameOptions& options, const Vec3& tangent) {
  if (!options.normal) return any_normal(tangent);
  const Vec3& wanted = *options.normal;
  if (!spans::all_finite(wanted) || !(wanted.cross(tangent).norm() > 1e-9 * wanted.norm()))
    throw std::invalid_argument("the first normal must be finite, not zero and not along the curve; it is " +
                                spans::text_of(wanted) + ", the tangent " + spans::text_of(tangent));
  return across(wanted, tangent);
}

Vec3 reflected(const Vec3& v, const Vec3& mirror) {
  const double square = mirror.squaredNorm();
  return square > 0 ? Vec3(v - (2 / square) * mirror.dot(v) * mirror) : v;
}

// The normal after a step to `place` and `tangent`.
Vec3 carried(const Frame& from, const Vec3& place, const Vec3& tangent) {
  const Vec3 step = place - from.position;
  const Vec3 first = step.squaredNorm() > 0 ? step : from.tangent;
  return across(reflected(reflected(from.normal, first), tangent - reflected(from.tangent, first)), tangent);
}

Vec3 turned(const Frame& frame, double angle) {
  const elementary::SinCos wave = elementary::sin_cos(angle);
  return wave.cos * frame.normal + wave.sin * frame.tangent.cross(frame.normal);
}

void check_frame_times(std::span<const double> times) {
  if (times.empty()) throw std::invalid_argument("frames need at least one time; none were given");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) throw std::invalid_argument("time " + std::to_string(i) + " must be finite");
    if (i > 0 && !(times[i] > times[i - 1]))
      throw std::invalid_argument("times must increase; time " + std::to_string(i) + ", " + spans::text_of(times[i]) +
                                  " s, is not after " + spans::text_of(times[i - 1]) + " s");
  }
}

}  // namespace
}  // namespace tweenfall::geometry

namespace tweenfall {

double curvature(const Sample<Vec3>& sample) noexcept {
  const double speed = sample.rate.norm();
  return speed > 0 ? sample.rate.cross(sample.acceleration).norm() / (speed * speed * speed) : 0;
}

std::optional<Frame> frenet_frame(const Curve<Vec3>& curve, double time, Side side) noexcept {
  const Sample<Vec3> s = curve.sample(time, side);
  const Vec3 turn = s.rate.cross(s.acceleration);
  const double speed = s.rate.norm(), size = turn.norm();
  // A bend that is only rounding has no direction.
  if (!(size > 1e-14 * speed * s.acceleration.norm())) return {};
  Frame frame{s.value, s.rate / speed, Vec3(0, 0, 0), turn / size};
  frame.normal = frame.binormal.cross(frame.tangent);
  return frame;
}

std::vector<Frame> rotation_minimizing_frames(const Curve<Vec3>& curve, std::span<const double> times,
                                              const FrameOptions& options) {
  geometry::check_frame_times(times);
  Vec3 tangent(1, 0, 0);
  for (std::size_t i = times.size(); i-- > 0;) tangent = geometry::tangent_at(curve, times[i], tangent);

  Frame now{curve.value(times[0]), tangent, geometry::first_normal(options, tangent), Vec3(0, 0, 0)};
  std::vector<Frame> frames = {now};
  std::vector<double> along = {0};
  for (std::size_t i = 1; i < times.size(); ++i) {
    double length = along.back();
    for (int k = 1; k <= geometry::steps_between; ++k) {
      const double t = k == geometry::steps_between
                           ? times[i]
                           : times[i - 1] + (times[i] - times[i - 1]) * k / geometry::steps_between;
      const Vec3 place = curve.value(t, t >= curve.end() ? Side::in : Side::out);
      const Vec3 onward = options.closed && i + 1 == times.size() && k == geometry::steps_between
                              ? frames[0].tangent
                              : geometry::tangent_at(curve, t, now.tangent);
      length += (place - now.position).norm();
      now.normal = geometry::carried(now, place, onward);
      now.position = place;
      now.tangent = onward;
    }
    frames.push_back(now);
    along.push_back(length);
  }

  double turn = options.twist;
  if (options.closed) {
    const Frame& last = frames.back();
    const Vec3& wanted = frames[0].normal;
    turn += elementary::atan2(last.tangent.cross(last.normal).dot(wanted), last.normal.dot(wanted));
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (turn != 0 && along.back() > 0) frames[i].normal = geometry::turned(frames[i], turn * (along[i] / along.back()));
    frames[i].binormal = frames[i].tangent.cross(frames[i].normal);
  }
  return frames;
}

}  // namespace tweenfall
