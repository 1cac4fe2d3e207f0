#include "islands/squeezed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "islands/handed_back.h"
#include "step/keyed_step.h"

namespace tweenfall::islands {

using state::Body;

namespace {

/// Bodies this many times as fast as what leads them are told of, and none gets faster than the other.
constexpr double fast = 3, fastest = 10;
/// Relative; less is no gain.
constexpr double hardly_more = 1e-6;

bool is_motored(const JointKind& kind) {
  return std::visit(
      [](const auto& its) {
        using Kind = std::decay_t<decltype(its)>;
        if constexpr (requires { its.motor; })
          if (its.motor) return true;
        if constexpr (requires { its.first_motor; })
          if (its.first_motor || its.second_motor) return true;
        if constexpr (requires { its.toward; })
          if (its.toward) return true;
        return std::is_same_v<Kind, SpringJoint>;
      },
      kind);
}

/// What in an island is led, and what each body had before the step.
class Squeeze {
 public:
  Squeeze(const IslandContents& island, const std::vector<Body>& bodies, double dt) : bodies_(bodies), dt_(dt) {
    for (const contacts::ContactConstraint* contact : island.contacts)
      for (const contacts::PointConstraint& point :
           std::span(contact->points).first(static_cast<std::size_t>(contact->count))) {
        if (!(point.total_normal > 0)) continue;
        end(contact->a, point.start_arm_a);
        end(contact->b, point.start_arm_b);
      }
    for (const joints::JointLink* link : island.joints) {
      if (link->a == joints::JointLink::world)
        firm(link->a);
      else
        end(link->a, arm_of(link->a, link->joint->settings.frame_a));
      end(link->b, arm_of(link->b, link->joint->settings.frame_b));
    }
    std::sort(free.begin(), free.end());
    free.erase(std::unique(free.begin(), free.end()), free.end());
  }

  /// Whether something presses against several bodies that do not give way.
  [[nodiscard]] bool squeezes() const { return several_; }

  double leading = 0;               ///< fastest of the points that are led, m/s
  std::vector<std::uint32_t> free;  ///< the bodies that can move, in order, each once

 private:
  [[nodiscard]] Vec3 arm_of(std::uint32_t index, const Pose& frame) const {
    return bodies_[index].motion.pose.rotation * (frame.position - bodies_[index].mass().center);
  }
  void firm(std::uint32_t index) {
    several_ = several_ || (first_ && *first_ != index);
    first_ = first_.value_or(index);
  }
  void end(std::uint32_t index, const Vec3& arm) {
    const Body& body = bodies_[index];
    if (!body.immovable()) {
      free.push_back(index);
      return;
    }
    firm(index);
    if (body.displaces()) leading = std::max(leading, velocity_at(step::keyed_course(body, dt_).mean, arm).norm());
  }

  const std::vector<Body>& bodies_;
  double dt_;
  std::optional<std::uint32_t> first_;
  bool several_ = false;
};

double energy_of(const Body& body, const Twist& twist) {
  return 0.5 * body.mass().mass * twist.linear.squaredNorm() +
         0.5 * twist.angular.dot(body.world_inertia(body.motion.pose.rotation) * twist.angular);
}

}  // namespace

void bound_squeezed(const IslandContents& island, std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                    double slowest, double dt, const std::function<const Twist&(std::uint32_t)>& start_of) {
  if (!island.springs.empty()) return;
  for (const joints::JointLink* link : island.joints)
    if (is_motored(link->joint->settings.kind)) return;
  const Squeeze squeeze(island, bodies, dt);
  if (!squeeze.squeezes()) return;
  // What a body has may be its own, what others lost, or the work of forces.
  double lost = 0;
  const auto before = [&](std::uint32_t index) {
    const Body& body = bodies[index];
    const Twist& start = start_of(index);
    const double gained = loads[index].acceleration.norm() * dt;
    return energy_of(body, start) + body.mass().mass * gained * (start.linear.norm() + gained);
  };
  for (const std::uint32_t index : squeeze.free) {
    if (bodies[index].drive.owner() == Owner::driven || loads[index].torque != Vec3::Zero()) return;
    lost += std::max(0.0, before(index) - energy_of(bodies[index], bodies[index].twist));
  }
  const double leading = std::max(squeeze.leading, slowest);
  const auto too_much = [&](std::uint32_t index, double times) {
    const Body& body = bodies[index];
    const double led = times * leading, energy = energy_of(body, body.twist);
    const double most = std::max(0.5 * body.mass().mass * (led * led), (1 + hardly_more) * (before(index) + lost));
    return energy > most ? std::sqrt(most / energy) : 1;
  };
  double least = 1;
  for (const std::uint32_t index : squeeze.free) {
    bodies[index].squeezed = too_much(index, fast) < 1;
    least = std::min(least, too_much(index, fastest));
  }
  if (least == 1) return;
  HandedBack handed_back(island, bodies);
  for (const std::uint32_t index : squeeze.free) {
    Body& body = bodies[index];
    // Jointed bodies slow down together, so that their joints hold.
    const double share = island.joints.empty() ? too_much(index, fastest) : least;
    handed_back.note(index, (share - 1) * body.mass().mass * body.twist.linear);
    body.twist.linear *= share;
    body.twist.angular *= share;
    body.follow_center(body.motion.pose.rotation);
  }
  handed_back.hand_back();
}

}  // namespace tweenfall::islands
