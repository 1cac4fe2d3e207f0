#include "chains/joint_limits.h"

namespace tweenfall::chains {
namespace {

constexpr double pi = std::numbers::pi;

// The nearest angle of the range, around the circle.
Dual within(const Dual& angle, double low, double high) noexcept {
  if (angle.v >= low && angle.v <= high) return angle;
  const double over = angle.v > high ? angle.v - high : angle.v + 2 * pi - high;
  const double under = angle.v < low ? low - angle.v : low + 2 * pi - angle.v;
  return over <= under ? Dual(high) : Dual(low);
}

Turning within_cone(const JointChain::Joint& joint, const ConeLimit& cone, const Turning& turn) noexcept {
  const Vec3 still(0, 0, 0);
  const Arrow rest{joint.bone, still};
  const Arrow bone = turn * rest;
  const Arrow beside = across(bone, rest);
  const Measured side = measured(beside);
  const Dual swing = angle_of(side.length, dot(bone, rest));
  const Dual twist = twist_about(joint.bone, turn), held = within(twist, cone.twist_low, cone.twist_high);
  if (swing.v <= cone.swing && held.v == twist.v) return turn;
  Arrow toward = bone;
  if (swing.v > cone.swing) {
    const Arrow away = side.any ? side.unit : Arrow{any_across(joint.bone), still};
    const elementary::SinCos edge = elementary::sin_cos(cone.swing);
    toward = Dual(edge.cos) * rest + Dual(edge.sin) * away;
  }
  return arc(rest, toward, any_across(joint.bone)) * about(joint.bone, held);
}

}  // namespace

Dual twist_about(const Vec3& axis, const Turning& turn) noexcept {
  const Quat& q = turn.v;
  // q' = w q / 2
  const double along = q.vec().dot(axis), along_rate = 0.5 * (q.w() * turn.w + turn.w.cross(q.vec())).dot(axis);
  const double rest_rate = -0.5 * turn.w.dot(q.vec());
  Dual angle = Dual(2) * angle_of({along, along_rate}, {q.w(), rest_rate});
  if (angle.v > pi) angle.v -= 2 * pi;
  if (angle.v < -pi) angle.v += 2 * pi;
  return angle;
}

Turning about(const Vec3& axis, const Dual& angle) noexcept {
  const elementary::SinCos half = elementary::sin_cos(0.5 * angle.v);
  return {Quat(half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z()), angle.d * axis};
}

Turning within_limits(const JointChain::Joint& joint, const Turning& turn) noexcept {
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit))
    return about(hinge->axis, within(twist_about(hinge->axis, turn), hinge->low, hinge->high));
  if (const auto* cone = std::get_if<ConeLimit>(&joint.limit)) return within_cone(joint, *cone, turn);
  return turn;
}

Turning middle_of(const JointChain::Joint& joint, const Turning& turn) noexcept {
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit))
    return about(hinge->axis, Dual(0.5 * (hinge->low + hinge->high)));
  if (const auto* cone = std::get_if<ConeLimit>(&joint.limit))
    return about(joint.bone, Dual(0.5 * (cone->twist_low + cone->twist_high)));
  return turn;
}

Freedom freedom_of(const JointChain::Joint& joint, const Turning& turn) noexcept {
  constexpr double anywhere = 2 * pi;
  const Vec3 still(0, 0, 0);
  Freedom freedom;
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
    const Dual angle = twist_about(hinge->axis, turn);
    freedom.count = 1;
    freedom.ways[0] = {{hinge->axis, still}, Dual(hinge->low) - angle, Dual(hinge->high) - angle};
    return freedom;
  }
  freedom.count = 3;
  const auto* cone = std::get_if<ConeLimit>(&joint.limit);
  if (!cone) {
    for (int i = 0; i < 3; ++i) freedom.ways[i] = {{Vec3::Unit(i), still}, Dual(-anywhere), Dual(anywhere)};
    return freedom;
  }
  // A turn about the normal of rest and bone is pure swing, one about their sum pure twist.
  // Source: differential of the swing-twist decomposition; twist' = w . (rest + bone) / (1 + rest . bone).
  const Arrow rest{joint.bone, still}, bone = turn * rest;
  const Measured normal = measured(cross(rest, bone));
  const bool swung = normal.length.v > 1e-9;
  const Arrow swing = swung ? normal.unit : Arrow{any_across(joint.bone), still};
  Measured twist = measured(rest + bone);
  if (!(twist.length.v > 1e-9)) twist.unit = {Vec3(swing.v.cross(joint.bone)), still};
  const Dual angle = twist_about(joint.bone, turn), opening = angle_of(normal.length, dot(rest, bone));
  freedom.ways[0] = {.axis = swing, .low = {}, .high = Dual(cone->swing), .is_round = true, .out = opening};
  freedom.ways[1] = {.axis = cross(swing, twist.unit), .low = {}, .high = {}};
  freedom.ways[2] = {twist.unit, Dual(cone->twist_low) - angle, Dual(cone->twist_high) - angle};
  return freedom;
}

Turning turned_towards(const JointChain::Joint& joint, const Turning& turn, const Arrow& from,
                       const Arrow& to) noexcept {
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
    const Arrow axis{hinge->axis, Vec3(0, 0, 0)};
    const Arrow a = across(from, axis), b = across(to, axis);
    // A direction along the axis does not define an angle.
    if (a.v.squaredNorm() < 1e-20 * from.v.squaredNorm() || b.v.squaredNorm() < 1e-20 * to.v.squaredNorm()) return turn;
    return within_limits(joint, about(hinge->axis, angle_of(dot(axis, cross(a, b)), dot(a, b))) * turn);
  }
  const Measured a = measured(from), b = measured(to);
  if (!a.any || !b.any) return turn;
  return within_limits(joint, arc(a.unit, b.unit, any_across(a.unit.v)) * turn);
}

Turning turned_by(const JointChain::Joint& joint, const Turning& turn, const Arrow& by) noexcept {
  return within_limits(joint, exp_turn(by) * turn);
}

}  // namespace tweenfall::chains
