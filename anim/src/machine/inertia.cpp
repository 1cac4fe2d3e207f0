#include "machine/inertia.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/settle.h>

namespace tweenfall::graphs {

namespace {

// How long a spring is followed: after that the remainder is less than rounding.
constexpr double half_lives = 128;

Offset offset_of(const Motion& shown, const Motion& next, bool dead_blend) {
  Offset offset;
  // shown = exp(turn) next; differentiated: w_shown = J_left(turn) turn' + exp(turn) w_next, and J_left(r) =
  // J_right(-r). Nodes that neither state moves keep their bits.
  const bool turns = shown.pose.rotation.coeffs() != next.pose.rotation.coeffs();
  Quat turned(1, 0, 0, 0);
  if (turns) turned = shown.pose.rotation * next.pose.rotation.conjugate();
  offset.turn = log_map(turned);
  offset.turn_rate = right_jacobian_inverse(-offset.turn) * Vec3(shown.twist.angular - turned * next.twist.angular);
  offset.position = shown.pose.position;
  offset.velocity = shown.twist.linear;
  offset.scale = shown.pose.scale;
  offset.scale_rate = shown.scale_rate;
  if (dead_blend) return offset;
  offset.position -= next.pose.position;
  offset.velocity -= next.twist.linear;
  offset.scale -= next.pose.scale;
  offset.scale_rate -= next.scale_rate;
  return offset;
}

Sample<double> left_of(const GraphChange& change, double offset, double rate, double since) noexcept {
  if (offset == 0 && rate == 0) return {0, 0, 0};
  if (change.kind == GraphChange::Kind::half_life) return SpringDecay{offset, rate, change.seconds}.sample(since);
  return QuinticDecay(offset, rate, change.seconds).sample(since);
}

// Adds the remainder of an offset, component by component.
void add_left(const GraphChange& change, const Vec3& offset, const Vec3& rate, double since, Vec3& value,
              Vec3& value_rate) noexcept {
  for (int i = 0; i < 3; ++i) {
    const Sample<double> left = left_of(change, offset[i], rate[i], since);
    value[i] += left.value;
    value_rate[i] += left.rate;
  }
}

// Fades from the straight continuation of the old motion, which still has the weight `fade`.
void fade_out(const Vec3& from, const Vec3& from_rate, double since, double fade, double fade_rate, Vec3& value,
              Vec3& rate) noexcept {
  const Vec3 apart = from + since * from_rate - value;
  rate += fade * (from_rate - rate) + fade_rate * apart;
  value += fade * apart;
}

void turn_by(const Vec3& turn, const Vec3& turn_rate, Motion& motion) noexcept {
  if (turn.isZero(0) && turn_rate.isZero(0)) return;
  const Quat relative = exp_map(turn);
  motion.pose.rotation = relative * motion.pose.rotation;
  motion.pose.rotation.normalize();
  motion.twist.angular = right_jacobian(-turn) * turn_rate + relative * motion.twist.angular;
}

}  // namespace

std::vector<Offset> offsets_of(const GraphChange& change, std::span<const Motion> shown, std::span<const Motion> next) {
  std::vector<Offset> offsets;
  offsets.reserve(shown.size());
  for (std::size_t i = 0; i < shown.size(); ++i)
    offsets.push_back(offset_of(shown[i], next[i], change.kind == GraphChange::Kind::dead_blend));
  return offsets;
}

double settling_time(const GraphChange& change) noexcept {
  return change.kind == GraphChange::Kind::half_life ? half_lives * change.seconds : change.seconds;
}

void settle(const GraphChange& change, std::span<const Offset> offsets, double since,
            std::span<Motion> motions) noexcept {
  // Source of the dead blend: Holden, "Dead Blending", 2023.
  const double u = since / change.seconds, fade = 1 - u * u * (3 - 2 * u),
               fade_rate = -6 * u * (1 - u) / change.seconds;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Offset& offset = offsets[i];
    Motion& motion = motions[i];
    Vec3 turn{0, 0, 0}, turn_rate{0, 0, 0};
    if (change.kind == GraphChange::Kind::dead_blend) {
      fade_out(offset.position, offset.velocity, since, fade, fade_rate, motion.pose.position, motion.twist.linear);
      fade_out(offset.scale, offset.scale_rate, since, fade, fade_rate, motion.pose.scale, motion.scale_rate);
      turn = fade * (offset.turn + since * offset.turn_rate);
      turn_rate = fade * offset.turn_rate + fade_rate * (offset.turn + since * offset.turn_rate);
    } else {
      add_left(change, offset.position, offset.velocity, since, motion.pose.position, motion.twist.linear);
      add_left(change, offset.scale, offset.scale_rate, since, motion.pose.scale, motion.scale_rate);
      add_left(change, offset.turn, offset.turn_rate, since, turn, turn_rate);
    }
    turn_by(turn, turn_rate, motion);
  }
}

}  // namespace tweenfall::graphs
