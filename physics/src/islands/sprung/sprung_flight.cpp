#include "islands/sprung/sprung_flight.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tweenfall::sprung {

namespace {

using state::Body;

/// How far the fastest swing advances in a sub-step, rad: its energy then sways by half a hundredth. And how far a body
/// turns that is no ball.
constexpr double followed_swing = 0.2, followed_turn = 0.06;
constexpr int fewest = 4, most = 1024;
/// Bodies and springs times sub-steps that one island may take, unless it is a single pair.
constexpr double most_work = 4096;
constexpr std::size_t most_springs = 128;
/// A spring swings no faster across its line than if it were as long as this part of its length at rest: a body that
/// passes its other end is there for an instant only.
constexpr double shortest = 0.1;
/// A swing that advances farther than this in a step is one that nobody sees: it fades.
constexpr double shown = std::numbers::pi;

}  // namespace

double SprungFlight::Pull::force_of(double stretched) const {
  const double bound = most_per_meter / (straight + std::abs(stretched) * swinging);
  return std::min(stiffness, bound) * stretched;
}

bool SprungFlight::takes(const islands::IslandContents& island, const std::vector<Body>& bodies, Integrator integrator,
                         double dt) {
  if (!island.contacts.empty() || integrator != Integrator::exact_quadratic) return false;
  if (island.joints.size() + island.springs.size() > most_springs) return false;
  for (const joints::JointLink* link : island.joints) {
    if (!std::holds_alternative<SpringJoint>(link->joint->settings.kind)) return false;
    for (const std::uint32_t end : {link->a, link->b})
      if (end != joints::JointLink::world && bodies[end].drive.owner() == Owner::driven) return false;
  }
  for (const step::SpringRow* spring : island.springs)
    for (const std::uint32_t end : {spring->a, spring->b})
      if (end != step::SpringRow::world && bodies[end].drive.owner() == Owner::driven) return false;
  gather(island, bodies, dt);
  choose_pace(dt);
  if (followed_) return true;
  // What hangs on a spring that is made softer would sink: nothing does if all join the same two ends.
  return std::all_of(pulls_.begin(), pulls_.end(),
                     [&](const Pull& pull) { return pull.a == pulls_.front().a && pull.b == pulls_.front().b; });
}

std::uint32_t SprungFlight::place_of(std::uint32_t index, const std::vector<Body>& bodies, double dt) {
  for (std::uint32_t i = 1; i < bodies_.size(); ++i)
    if (bodies_[i].index == index) return i;
  bodies_.push_back(SprungBody::of(bodies[index], index, dt));
  return static_cast<std::uint32_t>(bodies_.size()) - 1;
}

void SprungFlight::gather(const islands::IslandContents& island, const std::vector<Body>& bodies, double dt) {
  bodies_.assign(1, {});
  pulls_.clear();
  static_assert(step::SpringRow::world == joints::JointLink::world);
  const auto add = [&](std::uint32_t a, std::uint32_t b, Pull pull) {
    pull.a = a == step::SpringRow::world ? 0 : place_of(a, bodies, dt);
    pull.b = b == step::SpringRow::world ? 0 : place_of(b, bodies, dt);
    const auto local = [&](std::uint32_t place, const Vec3& on_node) {
      return Vec3(bodies_[place].axes.conjugate() * on_node);
    };
    pull.local_a = local(pull.a, pull.local_a);
    pull.local_b = local(pull.b, pull.local_b);
    pulls_.push_back(pull);
  };
  for (const joints::JointLink* link : island.joints) {
    const JointSettings& settings = link->joint->settings;
    const auto& spring = std::get<SpringJoint>(settings.kind);
    const auto arm = [&](std::uint32_t end, const Pose& frame) {
      return end == joints::JointLink::world ? frame.position : Vec3(frame.position - bodies[end].mass().center);
    };
    Pull pull;
    pull.local_a = arm(link->a, settings.frame_a);
    pull.local_b = arm(link->b, settings.frame_b);
    pull.length = spring.length;
    pull.stiffness = spring.stiffness;
    pull.damping = spring.damping;
    pull.joint = link->joint;
    if (link->joint->side != Vec3::Zero()) pull.side = link->joint->side;
    add(link->a, link->b, pull);
  }
  for (const step::SpringRow* row : island.springs) {
    Pull pull;
    pull.local_a = row->local_a;
    pull.local_b = row->local_b;
    pull.length = row->rest_length;
    pull.stiffness = row->stiffness;
    pull.damping = row->damping;
    add(row->a, row->b, pull);
  }
}

/// Most of what a spring may be stretched by: all energy but that of the motion as a whole.
double SprungFlight::energy() const {
  double mass = 0, energy = 0;
  Vec3 momentum = Vec3::Zero();
  bool held = false;
  for (const SprungBody& body : bodies_) {
    if (!body.movable) {
      held = held || body.index != SprungBody::nobody;
      continue;
    }
    mass += 1 / body.inverse_mass;
    momentum += body.linear / body.inverse_mass;
    energy += 0.5 * (body.linear.squaredNorm() / body.inverse_mass + body.momentum.dot(body.spin()));
  }
  for (const Pull& pull : pulls_) {
    held = held || pull.a == 0 || pull.b == 0;
    const double stretched = pull.force / pull.stiffness;
    if (pull.stiffness > 0) energy += 0.5 * pull.force * stretched;
  }
  return held || !(mass > 0) ? energy : std::max(0.0, energy - 0.5 * momentum.squaredNorm() / mass);
}

/// Bounds of how fast everything may swing and turn say how many sub-steps follow it: bounds that stay as they are
/// while energy only goes to and fro, since sub-steps that change their length change its sway, too.
void SprungFlight::choose_pace(double dt) {
  for (SprungBody& body : bodies_) body.stiffness = 0;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  for (Pull& pull : pulls_) {
    pull.most_per_meter = unbounded;
    pull.straight = 1;
    aim(pull);
    pull.straight = 0;
  }
  const double all = energy();
  double turning = 0;
  for (Pull& pull : pulls_) {
    const SprungBody &a = bodies_[pull.a], &b = bodies_[pull.b];
    pull.stretch = pull.stiffness > 0 ? std::sqrt(2 * all / pull.stiffness) : 0;
    const double least = std::max(pull.length - pull.stretch, shortest * pull.length);
    const auto swing = [&](const SprungBody& body, const Vec3& arm) {
      const double moment = body.inverse_moments.maxCoeff(), reach = arm.norm();
      pull.straight += body.inverse_mass + moment * reach * reach;
      pull.swinging += moment * reach;
      // Stretched by s to the length r it swings across with k s / r, which is never more than k however short it was.
      if (pull.length > 0)
        pull.swinging +=
            (body.inverse_mass + moment * reach * reach) / std::max(least, pull.stretch / (1 / shortest - 1));
    };
    swing(a, pull.arm_a);
    swing(b, pull.arm_b);
    for (const SprungBody* body : {&a, &b})
      if (body->movable && !body->spherical) turning = std::max(turning, body->spin().norm());
    if (!(pull.straight > 0 && pull.stiffness > 0)) continue;
    const double frequency = pull.stiffness * (pull.straight + pull.stretch * pull.swinging);
    bodies_[pull.a].stiffness += a.movable ? frequency : 0;
    bodies_[pull.b].stiffness += b.movable ? frequency : 0;
    const double own = std::sqrt(pull.stiffness * pull.straight);
    const double push = pull.stiffness * pull.stretch * (own * dt > 1 ? 1 / own : dt);
    for (const auto& [body, arm] : {std::pair(&a, &pull.arm_a), std::pair(&b, &pull.arm_b)})
      if (body->movable && !body->spherical)
        turning = std::max(turning, body->spin().norm() + push * arm->norm() * body->inverse_moments.maxCoeff());
  }
  double fastest = 0;
  for (const Pull& pull : pulls_) fastest = std::max({fastest, bodies_[pull.a].stiffness, bodies_[pull.b].stiffness});
  const double wanted = std::max(std::sqrt(fastest) * dt / followed_swing, turning * dt / followed_turn);
  const double work = static_cast<double>(bodies_.size() - 1 + pulls_.size());
  const double allowed = std::clamp(most_work / work, double{fewest}, double{most});
  sub_steps_ = fewest;
  while (sub_steps_ < wanted && 2 * sub_steps_ <= allowed) sub_steps_ *= 2;
  followed_ = wanted <= sub_steps_;
  const double h = dt / sub_steps_;
  resists_ = false;
  for (Pull& pull : pulls_) {
    if (!(pull.straight > 0)) continue;
    if (!followed_) pull.most_per_meter = followed_swing * followed_swing / (h * h);
    // What nobody could see swing goes straight back within some steps, so slowly that levers do not turn its energy
    // into spins, which would stay.
    const double advance = pull.stretch > 0 ? pull.force_of(pull.stretch) / pull.stretch * pull.straight * dt * dt : 0;
    if (advance > shown * shown) pull.fading = (advance - shown * shown) / dt;
    resists_ = resists_ || pull.fading > 0 || pull.damping > 0;
    aim(pull);
  }
}

void SprungFlight::aim(Pull& pull) const {
  const SprungBody &a = bodies_[pull.a], &b = bodies_[pull.b];
  pull.arm_a = a.rotation * pull.local_a;
  pull.arm_b = b.rotation * pull.local_b;
  const Vec3 between = (b.center - a.center) + (pull.arm_b - pull.arm_a);
  const double length = between.norm();
  // With both ends at one place it pulls in its last direction.
  if (length > 0) pull.side = between / length;
  pull.force = pull.force_of(length - pull.length);
}

void SprungFlight::push(Pull& pull, double impulse) {
  const Vec3 given = impulse * pull.side;
  bodies_[pull.a].push(given, pull.arm_a);
  bodies_[pull.b].push(-given, pull.arm_b);
  pull.impulse -= given;
}

void SprungFlight::pull_all(double h) {
  for (Pull& pull : pulls_) push(pull, h * pull.force);
}

/// The speed along a spring decays like (1 + x + x^2 / 2)^-1, which is close to an exponential and never negative: so
/// it takes energy, and no more than there is. What fades does so like (1 + x)^-1, which leaves a strong pull its
/// speed.
void SprungFlight::resist(double h, bool backward) {
  for (std::size_t i = 0; i < pulls_.size(); ++i) {
    Pull& pull = pulls_[backward ? pulls_.size() - 1 - i : i];
    if (!(pull.damping > 0 || pull.fading > 0)) continue;
    const SprungBody &a = bodies_[pull.a], &b = bodies_[pull.b];
    const auto felt = [&](const SprungBody& body, const Vec3& arm) {
      if (!body.movable) return 0.0;
      const Vec3 lever = arm.cross(pull.side);
      return body.inverse_mass + lever.dot(body.turned_by(lever));
    };
    const double inverse_mass = felt(a, pull.arm_a) + felt(b, pull.arm_b);
    if (!(inverse_mass > 0)) continue;
    const double speed = pull.side.dot(b.velocity_at(pull.arm_b) - a.velocity_at(pull.arm_a));
    const double decay = h * pull.damping * inverse_mass;
    push(pull, speed * (1 - 1 / (1 + decay + 0.5 * decay * decay + h * pull.fading)) / inverse_mass);
  }
}

/// A led body goes on along its path.
void SprungFlight::lead(int sub_step, double dt) {
  const double from = static_cast<double>(sub_step) / sub_steps_, to = static_cast<double>(sub_step + 1) / sub_steps_;
  for (SprungBody& body : bodies_) {
    if (!body.led) continue;
    const Twist mean = body.course.mean_between(from, to, dt), end = body.course.velocity(to, dt);
    const double h = dt / sub_steps_;
    body.center += h * mean.linear;
    body.rotation = exp_map(h * mean.angular) * body.rotation;
    body.rotation.normalize();
    body.linear = end.linear;
    body.angular = end.angular;
  }
}

void SprungFlight::solve(std::vector<Body>& bodies, const std::vector<forces::Load>& loads, double dt,
                         std::vector<char>& moved) {
  for (SprungBody& body : bodies_) {
    if (body.led) {
      const Twist start = body.course.velocity(0, dt);
      body.linear = start.linear;
      body.angular = start.angular;
    }
    if (!body.movable) continue;
    const forces::Load& load = loads[body.index];
    body.acceleration = 0.5 * (load.acceleration + load.end_acceleration);
    body.torque = load.torque;
    body.drag = load.drag;
    body.angular_drag = load.angular_drag;
    body.angular_damping = load.angular_damping;
  }
  const double h = dt / sub_steps_;
  // What resists acts next to the flight: it also slows what the pull has just given, so that a strong one takes energy
  // whatever the pull does.
  for (int sub_step = 0; sub_step < sub_steps_; ++sub_step) {
    for (SprungBody& body : bodies_) body.load(0.5 * h);
    pull_all(0.5 * h);
    if (resists_) resist(0.5 * h, false);
    for (SprungBody& body : bodies_) body.fly(h);
    lead(sub_step, dt);
    for (Pull& pull : pulls_) aim(pull);
    if (resists_) resist(0.5 * h, true);
    pull_all(0.5 * h);
    for (SprungBody& body : bodies_) body.load(0.5 * h);
  }
  for (const SprungBody& body : bodies_) {
    if (!body.movable) continue;
    body.put_back(bodies[body.index]);
    moved[body.index] = 1;
  }
  for (const Pull& pull : pulls_) {
    if (!pull.joint) continue;
    pull.joint->force = pull.impulse / dt;
    pull.joint->torque = Vec3::Zero();
    pull.joint->side = pull.side;
    pull.joint->kept.fill(0);
    pull.joint->kept_step = 0;
    pull.joint->passed_over = 0;
  }
}

}  // namespace tweenfall::sprung
