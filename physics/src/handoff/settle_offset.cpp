#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/settle_offset.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tweenfall {

namespace handing_over {
namespace {

/// For exp(r) q with a rotation vector in world axes: the left Jacobian is the right one of -r.
Mat3 left_jacobian(const Vec3& r) {
  return right_jacobian(-r);
}
Mat3 left_jacobian_inverse(const Vec3& r) {
  return right_jacobian_inverse(-r);
}

/// The motion turned further by a changing rotation vector, world axes.
Motion turned(Motion motion, const Vec3& turn, const Vec3& turn_rate) {
  if (turn.isZero(0) && turn_rate.isZero(0)) return motion;
  const Quat relative = exp_map(turn);
  motion.pose.rotation = relative * motion.pose.rotation;
  motion.pose.rotation.normalize();
  motion.twist.angular = left_jacobian(turn) * turn_rate + relative * motion.twist.angular;
  return motion;
}

}  // namespace
}  // namespace handing_over

SettleOffset::SettleOffset(const Settle& settle, double time, const Motion& path, const Motion& body)
    : settle_(settle), start_(time), any_(true), body_(body) {
  if (!(settle.seconds > 0) || !std::isfinite(settle.seconds))
    throw std::invalid_argument("a settle needs a time above 0, not " + number_text(settle.seconds) + " s");

  const Vec3 offset = body.pose.position - path.pose.position;
  const Vec3 offset_rate = body.twist.linear - path.twist.linear;
  // body = exp(turn) path; differentiated: w_body = J_left(turn) turn' + exp(turn) w_path
  const Quat relative = hemisphere_aligned(body.pose.rotation * path.pose.rotation.conjugate(), Quat(1, 0, 0, 0));
  const Vec3 turn = log_map(relative);
  const Vec3 difference = body.twist.angular - relative * path.twist.angular;
  const Vec3 turn_rate = handing_over::left_jacobian_inverse(turn) * difference;

  for (int i = 0; i < 6; ++i) {
    const double value = i < 3 ? offset[i] : turn[i - 3], rate = i < 3 ? offset_rate[i] : turn_rate[i - 3];
    if (settle.kind == Settle::Kind::quintic)
      quintic_[static_cast<std::size_t>(i)] = QuinticDecay(value, rate, settle.seconds);
    if (settle.kind == Settle::Kind::dead_blend && i >= 3)
      extrapolated_[static_cast<std::size_t>(i - 3)] = {value, rate};
    if (settle.kind == Settle::Kind::half_life) spring_[static_cast<std::size_t>(i)] = {value, rate, settle.seconds};
  }
}

bool SettleOffset::over(double time) const noexcept {
  constexpr double half_lives = 60;
  return !any_ || time - start_ >= settle_.seconds * (settle_.kind == Settle::Kind::half_life ? half_lives : 1);
}

Motion SettleOffset::apply(double time, const Motion& path) const noexcept {
  if (!any_) return path;
  const double since = std::max(0.0, time - start_);  // just before its start, it is as at its start

  if (settle_.kind == Settle::Kind::dead_blend) {
    // Source: Holden, "Dead Blending", 2023: extrapolate the old motion, and cross-fade to the new one. Rotation fades
    // as the turn from the path, as one vector: so any number of turns is unwound, and none is taken for its opposite.
    if (since >= settle_.seconds) return path;
    const double u = since / settle_.seconds, fade = u * u * (3 - 2 * u), rate = 6 * u * (1 - u) / settle_.seconds;
    Motion mixed = path;
    const Vec3 apart = body_.pose.position + since * body_.twist.linear - path.pose.position;
    mixed.pose.position += (1 - fade) * apart;
    mixed.twist.linear += (1 - fade) * (body_.twist.linear - path.twist.linear) - rate * apart;
    Vec3 turn, turn_rate;
    for (int i = 0; i < 3; ++i) {
      const auto& [value, speed] = extrapolated_[static_cast<std::size_t>(i)];
      turn[i] = (1 - fade) * (value + speed * since);
      turn_rate[i] = (1 - fade) * speed - rate * (value + speed * since);
    }
    return handing_over::turned(mixed, turn, turn_rate);
  }

  Vec3 offset, offset_rate, turn, turn_rate;
  for (int i = 0; i < 6; ++i) {
    const std::size_t part = static_cast<std::size_t>(i);
    const Sample<double> sample =
        settle_.kind == Settle::Kind::quintic ? quintic_[part].sample(since) : spring_[part].sample(since);
    (i < 3 ? offset[i] : turn[i - 3]) = sample.value;
    (i < 3 ? offset_rate[i] : turn_rate[i - 3]) = sample.rate;
  }
  Motion settled = path;
  settled.pose.position += offset;
  settled.twist.linear += offset_rate;
  return handing_over::turned(settled, turn, turn_rate);
}

}  // namespace tweenfall
