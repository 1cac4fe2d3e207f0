#include "islands/pinched.h"

#include <algorithm>
#include <cmath>

#include "islands/handed_back.h"
#include "step/keyed_step.h"
#include "step/softness.h"
#include "step/solver.h"

namespace tweenfall::islands {

using contacts::ContactConstraint;
using contacts::PointConstraint;
using state::Body;

namespace {

/// A contact that cannot be satisfied still closes with at least this part of the leading speed: in a row the speed is
/// shared among all contacts.
constexpr double unsatisfied = 0.02;
/// A blow that springs back gives twice the momentum that there was.
constexpr double beyond_blows = 3;

/// Speeds and momenta in an island.
struct Pinch {
  double leading = 0;   ///< fastest of the points that are led, m/s
  double fastest = 0;   ///< of all centers before the step, including what forces added, m/s
  double spinning = 0;  ///< fastest surface speed from the bodies' spins, m/s
  double momentum = 0;  ///< of all bodies in contacts, at these speeds, plus the pull of drives, N s
  double closing = 0;   ///< fastest of the pressing contacts, m/s
  double depth = 0;     ///< deepest of the pressing contacts, m
};

std::span<PointConstraint> points_of(ContactConstraint& contact) {
  return std::span(contact.points).first(static_cast<std::size_t>(contact.count));
}

double impulse_of(ContactConstraint& contact) {
  double sum = 0;
  for (const PointConstraint& point : points_of(contact)) sum += point.total_normal;
  return sum;
}

Pinch pinch_of(const IslandContents& island, const std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
               const WorldSettings& settings, double dt, const std::function<const Twist&(std::uint32_t)>& start_of) {
  Pinch pinch;
  const auto twist_of = [&](const Body& body) {
    return body.immovable() ? step::keyed_course(body, dt).mean : body.twist;
  };
  const auto lead = [&](std::uint32_t index, const Vec3& arm) {
    if (!bodies[index].displaces()) return;
    pinch.leading = std::max(pinch.leading, velocity_at(twist_of(bodies[index]), arm).norm());
  };
  for (const joints::JointLink* link : island.joints) {
    const auto end = [&](std::uint32_t index, const Pose& frame) {
      if (index != joints::JointLink::world)
        lead(index, bodies[index].motion.pose.rotation * (frame.position - bodies[index].mass().center));
    };
    end(link->a, link->joint->settings.frame_a);
    end(link->b, link->joint->settings.frame_b);
  }
  double mass = 0, pull = 0;
  for (ContactConstraint* contact : island.contacts) {
    const Twist a = twist_of(bodies[contact->a]), b = twist_of(bodies[contact->b]);
    for (const PointConstraint& point : points_of(*contact)) {
      lead(contact->a, point.start_arm_a);
      lead(contact->b, point.start_arm_b);
      if (!(point.total_normal > 0)) continue;
      pinch.depth = std::max(pinch.depth, -point.start_gap);
      const Vec3 apart = velocity_at(b, point.start_arm_b) - velocity_at(a, point.start_arm_a);
      pinch.closing = std::max(pinch.closing, -contact->manifold.normal.dot(apart));
    }
    for (const std::uint32_t end : {contact->a, contact->b}) {
      const Body& body = bodies[end];
      if (body.immovable()) continue;
      const Twist& start = start_of(end);
      mass += body.mass().mass;
      pinch.fastest = std::max(pinch.fastest, start.linear.norm() + loads[end].acceleration.norm() * dt);
      pinch.spinning = std::max(pinch.spinning, start.angular.norm() * body.radius());
      if (body.drive.owner() != Owner::driven) continue;
      pull += body.drive.max_force * dt;
    }
  }
  const double slowest = std::max(pinch.leading, settings.push_out_speed);
  pinch.fastest = std::max(pinch.fastest, slowest);
  pinch.spinning = std::max(pinch.spinning, slowest);
  pinch.momentum = beyond_blows * mass * (pinch.fastest + pinch.spinning) + pull;
  return pinch;
}

}  // namespace

bool is_wedged(std::span<ContactConstraint* const> contacts, const std::vector<Body>& bodies, double deep) {
  constexpr std::uint32_t nobody = 0xffffffffu;
  std::uint32_t first = nobody;
  for (const ContactConstraint* contact : contacts) {
    const std::uint32_t firm = bodies[contact->a].immovable()   ? contact->a
                               : bodies[contact->b].immovable() ? contact->b
                                                                : nobody;
    if (firm == nobody || firm == first) continue;
    const auto points = std::span(contact->points).first(static_cast<std::size_t>(contact->count));
    if (std::none_of(points.begin(), points.end(),
                     [&](const PointConstraint& point) { return point.start_gap < -deep; }))
      continue;
    if (first != nobody) return true;
    first = firm;
  }
  return false;
}

void tame_pinched(const IslandContents& island, std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                  const WorldSettings& settings, double dt,
                  const std::function<const Twist&(std::uint32_t)>& start_of) {
  const Pinch pinch = pinch_of(island, bodies, loads, settings, dt, start_of);
  // What holds it may well bear more: a lever, or something that a motor presses.
  const double deep = step::soft_contacts(settings.push_out_speed, dt, step::Solver::usual_sub_steps).deep();
  const bool holds = pinch.leading > 0 ? !(pinch.closing > unsatisfied * pinch.leading || pinch.depth > deep)
                                       : !island.joints.empty() || !island.springs.empty();
  if (holds) return;
  bool pinched = false;
  for (ContactConstraint* contact : island.contacts) {
    const double impulse = impulse_of(*contact);
    if (!(impulse > pinch.momentum)) continue;
    pinched = true;
    const double kept = pinch.momentum / impulse;
    for (PointConstraint& point : points_of(*contact)) {
      point.kept_normal *= kept;
      point.kept_friction *= kept;
    }
    contact->kept_rolling *= kept;
    contact->kept_spin *= kept;
    contact->kept_twist *= kept;
  }
  if (!pinched) return;
  HandedBack handed_back(island, bodies);
  const auto bound = [&](std::uint32_t index) {
    Body& body = bodies[index];
    if (body.immovable()) return;
    const Vec3 before = body.twist.linear;
    const double speed = body.twist.linear.norm(), spin = body.twist.angular.norm() * body.radius();
    if (speed > pinch.fastest) body.twist.linear *= pinch.fastest / speed;
    if (spin > pinch.spinning) body.twist.angular *= pinch.spinning / spin;
    if (!(speed > pinch.fastest || spin > pinch.spinning)) return;
    handed_back.note(index, body.mass().mass * (body.twist.linear - before));
    body.follow_center(body.motion.pose.rotation);
  };
  for (const ContactConstraint* contact : island.contacts) {
    bound(contact->a);
    bound(contact->b);
  }
  for (const joints::JointLink* link : island.joints) {
    if (link->a != joints::JointLink::world) bound(link->a);
    bound(link->b);
  }
  handed_back.hand_back();
}

}  // namespace tweenfall::islands
