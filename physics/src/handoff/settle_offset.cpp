#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/settle_offset.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace tweenfall {

namespace {

/// exp(r) q for a rotation vector in world axes: the left Jacobian is the right one of -r.
Mat3 left_jacobian(const Vec3& r) {
  return right_jacobian(-r);
}
Mat3 left_jacobian_inverse(const Vec3& r) {
  return right_jacobian_inverse(-r);
}

}  // namespace

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
  const Vec3 turn_rate = left_jacobian_inverse(turn) * difference;

  for (int i = 0; i < 6; ++i) {
    const double value = i < 3 ? offset[i] : turn[i - 3], rate = i < 3 ? offset_rate[i] : turn_rate[i - 3];
    if (settle.kind == Settle::Kind::quintic)
      quintic_[static_cast<std::size_t>(i)] = QuinticDecay(value, rate, settle.seconds);
    if (settle.kind == Settle::Kind::half_life) spring_[static_cast<std::size_t>(i)] = {value, rate, settle.seconds};
  }
}

Motion SettleOffset::apply(double time, const Motion& path) const noexcept {
  if (!any_) return path;
  const double since = time - start_;
  if (since < 0) return path;

  if (settle_.kind == Settle::Kind::dead_blend) {
    // Source: Holden, "Dead Blending", 2023: extrapolate what was, cross-fade to what shall be.
    if (since >= settle_.seconds) return path;
    Motion onward = body_;
    onward.pose.position += since * body_.twist.linear;
    onward.pose.rotation = exp_map(since * body_.twist.angular) * body_.pose.rotation;
    const double u = since / settle_.seconds;
    Motion mixed = mix(onward, path, u * u * (3 - 2 * u), 6 * u * (1 - u) / settle_.seconds);
    mixed.pose.scale = path.pose.scale;
    mixed.scale_rate = path.scale_rate;
    return mixed;
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
  if (!turn.isZero(0) || !turn_rate.isZero(0)) {
    const Quat relative = exp_map(turn);
    settled.pose.rotation = relative * path.pose.rotation;
    settled.pose.rotation.normalize();
    settled.twist.angular = left_jacobian(turn) * turn_rate + relative * path.twist.angular;
  }
  return settled;
}

}  // namespace tweenfall
