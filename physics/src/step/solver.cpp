#include "step/solver.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "forces/drive_law.h"
#include "step/keyed_step.h"

namespace tweenfall {

namespace {

/// Frequency of soft contacts times the sub-step, and their damping ratio.
constexpr double soft_cycles = 0.125;
constexpr double soft_damping = 10;
/// Sub-steps in a step; the passes are shared out among them.
constexpr int sub_steps = 8;
/// How fast a longer step is forgotten, in seconds per second.
constexpr double forgetting = 0.02;
/// Up to this many contacts every sub-step may take all passes: few contacts are solved to the end.
constexpr std::size_t few = 24;
/// A change of velocity that no longer matters, m/s.
constexpr double settled = 1e-14;

Vec3 point_velocity(const SolverBody& body, const Vec3& arm) {
  return body.linear + body.angular.cross(arm);
}

void push(SolverBody& body, const Vec3& impulse, const Vec3& arm) {
  body.linear += body.inverse_mass * impulse;
  body.angular += body.inverse_inertia * arm.cross(impulse);
}

double mass_along(const SolverBody& a, const SolverBody& b, const PointConstraint& point, const Vec3& direction) {
  const Vec3 turn_a = point.arm_a.cross(direction);
  const Vec3 turn_b = point.arm_b.cross(direction);
  const double inverse =
      a.inverse_mass + b.inverse_mass + turn_a.dot(a.inverse_inertia * turn_a) + turn_b.dot(b.inverse_inertia * turn_b);
  return inverse > 0 ? 1 / inverse : 0;
}

struct Tangents {
  Vec3 first, second;
};

Tangents tangents_of(const Vec3& normal) {
  const Vec3 helper = std::abs(normal.x()) < 0.57 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  Tangents tangents;
  tangents.first = normal.cross(helper);
  tangents.first.normalize();
  tangents.second = normal.cross(tangents.first);
  return tangents;
}

/// Friction of one point on the circular cone: the impulse that stops the slip, or, when the cone is too narrow, a
/// step along the slip brought back to the cone's edge, so that in the end friction opposes the slip exactly.
double solve_friction(SolverBody& a, SolverBody& b, PointConstraint& point, Vec3& impulse, double limit,
                      const Vec3& normal) {
  const Tangents along = tangents_of(normal);
  const Vec3 slip = point_velocity(b, point.arm_b) - point_velocity(a, point.arm_a);
  const double slip1 = slip.dot(along.first);
  const double slip2 = slip.dot(along.second);
  const Vec3 a1 = point.arm_a.cross(along.first), a2 = point.arm_a.cross(along.second);
  const Vec3 b1 = point.arm_b.cross(along.first), b2 = point.arm_b.cross(along.second);
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  const Vec3 ia1 = a.inverse_inertia * a1, ia2 = a.inverse_inertia * a2;
  const Vec3 ib1 = b.inverse_inertia * b1, ib2 = b.inverse_inertia * b2;
  const double k11 = inverse_mass + a1.dot(ia1) + b1.dot(ib1);
  const double k22 = inverse_mass + a2.dot(ia2) + b2.dot(ib2);
  const double k12 = a1.dot(ia2) + b1.dot(ib2);
  const double determinant = k11 * k22 - k12 * k12;
  if (!(determinant > 0)) return 0;
  const double old1 = impulse.dot(along.first), old2 = impulse.dot(along.second);
  double new1 = old1 - (k22 * slip1 - k12 * slip2) / determinant;
  double new2 = old2 - (k11 * slip2 - k12 * slip1) / determinant;
  if (new1 * new1 + new2 * new2 > limit * limit) {
    const double largest = 0.5 * (k11 + k22) + std::sqrt(0.25 * (k11 - k22) * (k11 - k22) + k12 * k12);
    new1 = old1 - slip1 / largest;
    new2 = old2 - slip2 / largest;
    const double length = std::sqrt(new1 * new1 + new2 * new2);
    if (length > limit) {
      new1 *= limit / length;
      new2 *= limit / length;
    }
  }
  const Vec3 change = (new1 - old1) * along.first + (new2 - old2) * along.second;
  impulse = new1 * along.first + new2 * along.second;
  push(a, -change, point.arm_a);
  push(b, change, point.arm_b);
  return std::max(std::abs(new1 - old1), std::abs(new2 - old2)) * std::max(k11, k22);
}

/// Resistance to rolling and spinning: a torque against the relative spin, at most `limit`.
void solve_rolling(SolverBody& a, SolverBody& b, Vec3& impulse, double limit) {
  const Mat3 inverse = a.inverse_inertia + b.inverse_inertia;
  const Vec3 wanted = impulse - inverse.inverse() * (b.angular - a.angular);
  Vec3 next = wanted;
  if (next.norm() > limit) {
    next = impulse - (b.angular - a.angular) / inverse.trace();
    if (next.norm() > limit) next *= limit / next.norm();
  }
  const Vec3 change = next - impulse;
  impulse = next;
  a.angular -= a.inverse_inertia * change;
  b.angular += b.inverse_inertia * change;
}

/// Step of one normal row toward relative speed `wanted`, total impulse not negative.
double solve_normal(SolverBody& a, SolverBody& b, const PointConstraint& point, double& impulse, double wanted,
                    const Vec3& normal, double firm = 1, double giving = 0) {
  const double speed = normal.dot(point_velocity(b, point.arm_b) - point_velocity(a, point.arm_a));
  const double next = std::max(0.0, (1 - giving) * impulse - firm * point.normal_mass * (speed - wanted));
  const double change = next - impulse;
  impulse = next;
  if (change != 0) {
    push(a, -change * normal, point.arm_a);
    push(b, change * normal, point.arm_b);
  }
  return point.normal_mass > 0 ? std::abs(change) / point.normal_mass : 0;
}

}  // namespace

void Solver::gather(const std::vector<Body>& bodies, std::vector<ContactConstraint>& constraints, double dt) {
  bodies_.clear();
  slots_.assign(bodies.size(), 0xffffffffu);
  const auto add = [&](std::uint32_t index) {
    if (slots_[index] != 0xffffffffu) return;
    slots_[index] = static_cast<std::uint32_t>(bodies_.size());
    const Body& body = bodies[index];
    SolverBody entry;
    entry.index = index;
    entry.round = body.spherical && std::holds_alternative<Sphere>(body.shape.solid);
    entry.movable = !body.immovable() && !body.asleep;
    entry.roundness = body.roundness;
    entry.center = entry.start_center = body.center;
    entry.rotation = entry.start_rotation = body.motion.pose.rotation;
    entry.turn = Quat::Identity();
    entry.drive_impulse = entry.drive_angular_impulse = Vec3::Zero();
    entry.push_linear = entry.push_angular = Vec3::Zero();
    if (entry.movable) {
      entry.inverse_mass = 1 / body.mass.mass;
      entry.inverse_inertia = body.world_inverse_inertia(body.motion.pose.rotation);
      entry.linear = body.twist.linear;
      entry.angular = body.twist.angular;
    } else {
      const Twist rate = body.asleep ? Twist{} : displacement_rate(body, dt);
      entry.linear = rate.linear;
      entry.angular = rate.angular;
    }
    bodies_.push_back(entry);
  };
  for (const ContactConstraint& constraint : constraints) {
    add(constraint.a);
    add(constraint.b);
  }
  before_linear_.resize(bodies_.size());
  before_angular_.resize(bodies_.size());
}

void Solver::foresee(const std::vector<Load>& loads, ContactConstraint& constraint, double dt) const {
  const SolverBody& a = at(constraint.a);
  const SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.manifold.normal;
  // Closing acceleration, free of contacts.
  const double pull = normal.dot(loads[constraint.a].acceleration - loads[constraint.b].acceleration);
  // Two bodies that fall together do not close, but what lies under them makes them tremble all the same.
  const double weight = std::max(std::abs(normal.dot(loads[constraint.a].acceleration)),
                                 std::abs(normal.dot(loads[constraint.b].acceleration)));
  constraint.impact = false;
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point.arm_a = point.start_arm_a;
    point.arm_b = point.start_arm_b;
    point.gap = point.start_gap;
    point.total_normal = 0;
    point.total_friction = Vec3::Zero();
    point.rebound = point.rebound_time = 0;
    const double closing = normal.dot(point_velocity(a, point.arm_a) - point_velocity(b, point.arm_b));
    double speed = closing;
    double time = 0;
    if (point.gap > 0) {
      const double square = closing * closing + 2 * pull * point.gap;
      const double root = square > 0 ? std::sqrt(square) : 0;
      time = square >= 0 && closing + root > 0 ? 2 * point.gap / (closing + root) : dt;
      speed = time < dt ? root : 0;
    }
    point.approach = std::max(0.0, speed);
    // Slower than what gravity makes of a step or two, a rebound would only be a tremble.
    if (point.approach <= std::max(1e-7, 2 * weight * whole_)) continue;
    constraint.impact = true;
    const double left = dt - time;
    const double back = constraint.restitution * point.approach;
    const double speed_at_end = back - pull * left;
    if (back <= 0 || speed_at_end <= 0) continue;
    point.rebound = speed_at_end;
    point.rebound_time = left * (back - 0.5 * pull * left) / speed_at_end;
  }
  constraint.total_rolling = Vec3::Zero();
}

void Solver::refresh(ContactConstraint& constraint) const {
  const SolverBody& a = at(constraint.a);
  const SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.manifold.normal;
  const Vec3 drift = (b.center - b.start_center) - (a.center - a.start_center);
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point.arm_a = carried(a.turn, point.start_arm_a, a.roundness * normal);
    point.arm_b = carried(b.turn, point.start_arm_b, -b.roundness * normal);
    const Vec3 swing = (point.arm_b - point.start_arm_b) - (point.arm_a - point.start_arm_a);
    point.gap = point.start_gap + normal.dot(drift + swing);
  }
}

void Solver::begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                            const WorldSettings& settings, double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& entry = bodies_[i];
    before_linear_[i] = entry.linear;
    before_angular_[i] = entry.angular;
    entry.pressed = false;
    if (!entry.movable) continue;
    const Body& body = bodies[entry.index];
    const Load& load = loads[entry.index];
    entry.linear = accelerated(entry.linear, load, settings.integrator, h);
    entry.angular = turned(body, {entry.rotation, entry.angular}, load, h).angular;
  }
}

void Solver::warm_start(ContactConstraint& constraint, double ratio) {
  SolverBody& a = at(constraint.a);
  SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.manifold.normal;
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point.normal_mass = mass_along(a, b, point, normal);
    point.normal_impulse *= ratio;
    point.friction_impulse = (ratio * (point.friction_impulse - normal * normal.dot(point.friction_impulse))).eval();
    const Vec3 impulse = point.normal_impulse * normal + point.friction_impulse;
    if (impulse == Vec3::Zero()) continue;
    push(a, -impulse, point.arm_a);
    push(b, impulse, point.arm_b);
  }
  constraint.rolling_impulse *= ratio;
  a.angular -= a.inverse_inertia * constraint.rolling_impulse;
  b.angular += b.inverse_inertia * constraint.rolling_impulse;
}

void Solver::keep_impulses(ContactConstraint& constraint, double ratio) {
  constraint.rolling_impulse *= ratio;
  constraint.kept_rolling = constraint.rolling_impulse;
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point.normal_impulse *= ratio;
    point.friction_impulse *= ratio;
    point.kept_normal = point.normal_impulse;
    point.kept_friction = point.friction_impulse;
  }
}

void Solver::blend_impulses(ContactConstraint& constraint, double share) {
  constraint.rolling_impulse += share * constraint.kept_rolling;
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point.normal_impulse += share * point.kept_normal;
    point.friction_impulse += share * point.kept_friction;
  }
}

double Solver::solve_contact(ContactConstraint& constraint, const Softness& softness, double h) {
  SolverBody& a = at(constraint.a);
  SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.manifold.normal;
  double change = 0;
  if (constraint.rolling_friction > 0) {
    double sum = 0;
    for (int i = 0; i < constraint.count; ++i) sum += constraint.points[static_cast<std::size_t>(i)].normal_impulse;
    solve_rolling(a, b, constraint.rolling_impulse, constraint.rolling_friction * sum);
  }
  if (constraint.friction > 0) {
    for (int i = 0; i < constraint.count; ++i) {
      PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      if (point.normal_impulse == 0 && point.friction_impulse == Vec3::Zero()) continue;
      change = std::max(change, solve_friction(a, b, point, point.friction_impulse,
                                               constraint.friction * point.normal_impulse, normal));
    }
  }
  for (int i = 0; i < constraint.count; ++i) {
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    // A gap may close within the sub-step, but not further.
    const bool soft = point.gap <= 0 && !constraint.impact;
    const double wanted = point.gap > 0 ? -point.gap / h : std::min(-softness.rate * point.gap, softness.speed);
    change = std::max(change, solve_normal(a, b, point, point.normal_impulse, wanted, normal, soft ? softness.firm : 1,
                                           soft ? softness.giving : 0));
  }
  return change;
}

double Solver::solve_drive(const std::vector<Body>& bodies, SolverBody& entry, double h, double remaining) {
  const Body& body = bodies[entry.index];
  if (!entry.movable || body.drive.owner() != Owner::driven) return 0;
  const DriveLaw law = drive_law(body, entry.center, entry.rotation, h, remaining);
  // Velocity as it would be without the pull: contacts included, the drive's own impulse taken out.
  const Vec3 linear = entry.linear - entry.inverse_mass * entry.drive_impulse;
  Vec3 impulse = ((linear + law.linear) / (1 + law.stiffness) - linear) / entry.inverse_mass;
  const double most = body.drive.max_force * h;
  if (impulse.norm() > most) impulse *= most / impulse.norm();
  const double change = entry.inverse_mass * (impulse - entry.drive_impulse).norm();
  entry.drive_impulse = impulse;
  entry.linear = linear + entry.inverse_mass * impulse;

  const Vec3 angular = entry.angular - entry.inverse_inertia * entry.drive_angular_impulse;
  const Mat3 inertia = body.world_inertia(entry.start_rotation);
  Vec3 turning = inertia * ((angular + law.angular) / (1 + law.stiffness) - angular);
  const double most_turning = body.drive.max_torque * h;
  if (turning.norm() > most_turning) turning *= most_turning / turning.norm();
  entry.drive_angular_impulse = turning;
  entry.angular = angular + entry.inverse_inertia * turning;
  return change;
}

double Solver::pass(std::vector<ContactConstraint>& constraints, const Softness& softness, double h, bool backward) {
  double change = 0;
  const std::size_t count = constraints.size();
  for (std::size_t i = 0; i < count; ++i)
    change = std::max(change, solve_contact(constraints[backward ? count - 1 - i : i], softness, h));
  return change;
}

void Solver::add_totals(std::vector<ContactConstraint>& constraints) {
  for (ContactConstraint& constraint : constraints) {
    for (int i = 0; i < constraint.count; ++i) {
      PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      point.total_normal += point.normal_impulse;
      point.total_friction += point.friction_impulse;
    }
    constraint.total_rolling += constraint.rolling_impulse;
  }
}

void Solver::end_sub_step(double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& entry = bodies_[i];
    // Under steady forces the mean velocity is exact. Where a contact holds the body, the velocity after the
    // impulses counts: a mean would leave every tremble undamped.
    const Vec3 linear = entry.linear + entry.lag;
    Vec3 angular = entry.angular;
    if (entry.movable && (!entry.pressed || (entry.round && !entry.impact)))
      angular = 0.5 * (angular + before_angular_[i]);
    entry.center += linear * h;
    if (angular == Vec3::Zero()) continue;
    const Quat turn = exp_map(angular * h);
    entry.rotation = turn * entry.rotation;
    entry.rotation.normalize();
    entry.turn = turn * entry.turn;
    entry.turn.normalize();
  }
}

void Solver::rebound(std::vector<ContactConstraint>& constraints, Islands& islands, int passes) {
  flags_.assign(slots_.size(), 0);
  bool any = false;
  const auto island = [&](const ContactConstraint& constraint) {
    return islands.of(at(constraint.a).movable ? constraint.a : constraint.b);
  };
  for (const ContactConstraint& constraint : constraints)
    for (int i = 0; i < constraint.count; ++i)
      if (const auto& point = constraint.points[static_cast<std::size_t>(i)];
          point.rebound > 0 && point.total_normal > 0) {
        flags_[island(constraint)] = 1;
        any = true;
      }
  if (!any) return;
  for (ContactConstraint& constraint : constraints) {
    refresh(constraint);
    for (int i = 0; i < constraint.count; ++i) {
      PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      point.before_rebound = point.total_normal;
      point.speed_before_rebound = constraint.manifold.normal.dot(point_velocity(at(constraint.b), point.arm_b) -
                                                                  point_velocity(at(constraint.a), point.arm_a));
      if (flags_[island(constraint)])
        point.normal_mass = mass_along(at(constraint.a), at(constraint.b), point, constraint.manifold.normal);
    }
  }
  for (int k = 0; k < passes; ++k) {
    double change = 0;
    for (std::size_t n = 0; n < constraints.size(); ++n) {
      ContactConstraint& constraint = constraints[k % 2 == 1 ? constraints.size() - 1 - n : n];
      if (!flags_[island(constraint)]) continue;
      SolverBody& a = at(constraint.a);
      SolverBody& b = at(constraint.b);
      for (int i = 0; i < constraint.count; ++i) {
        PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
        if (constraint.friction > 0 && constraint.impact)
          change =
              std::max(change, solve_friction(a, b, point, point.total_friction,
                                              constraint.friction * point.total_normal, constraint.manifold.normal));
        if (point.total_normal == 0 && point.gap > 0) continue;
        change =
            std::max(change, solve_normal(a, b, point, point.total_normal, point.rebound, constraint.manifold.normal));
      }
    }
    if (change < settled) break;
  }
  for (ContactConstraint& constraint : constraints) {
    SolverBody& a = at(constraint.a);
    SolverBody& b = at(constraint.b);
    for (int i = 0; i < constraint.count; ++i) {
      const PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      // The rebound began inside the step: what is left of the step, it moved.
      if (!(point.rebound > 0)) continue;
      // Bodies still closing when it was solved are on the surface already: stopping them moves nothing.
      const double part = point.rebound / (point.rebound - std::min(0.0, point.speed_before_rebound));
      // A rebound that gravity nearly uses up lasts long and takes little impulse: what neighbors pass on through the
      // point is none of it.
      const double most = point.normal_mass * point.rebound;
      const double own = std::clamp((point.total_normal - point.before_rebound) * part, -most, most);
      const Vec3 moved = own * point.rebound_time * constraint.manifold.normal;
      if (moved == Vec3::Zero()) continue;
      a.push_linear -= a.inverse_mass * moved;
      a.push_angular -= a.inverse_inertia * point.arm_a.cross(moved);
      b.push_linear += b.inverse_mass * moved;
      b.push_angular += b.inverse_inertia * point.arm_b.cross(moved);
    }
  }
}

void Solver::solve(std::vector<Body>& bodies, const std::vector<Load>& loads,
                   std::vector<ContactConstraint>& constraints, Islands& islands, const WorldSettings& settings,
                   double dt) {
  // What a short piece of a step leaves over must not be taken for what a whole one would: softness and kept impulses
  // refer to the longest step of late, and no ratio of lengths ever multiplies anything by more than 1.
  const double before = whole_ > 0 ? whole_ : dt;
  whole_ = std::max(dt, before - forgetting * dt);
  const double shorter = std::min(1.0, whole_ / before);
  const double part = dt / whole_;
  moved_.assign(bodies.size(), 0);
  gather(bodies, constraints, dt);
  for (ContactConstraint& constraint : constraints) {
    foresee(loads, constraint, dt);
    keep_impulses(constraint, shorter);
    if (!constraint.impact) continue;
    at(constraint.a).impact = true;
    at(constraint.b).impact = true;
  }
  const double h = dt / sub_steps;
  const bool thorough = constraints.size() <= few;
  const int share = thorough ? settings.iterations : settings.iterations / sub_steps;
  const int relaxing = std::max(1, share / 2);
  const int passes = std::max(1, share - relaxing);
  const double turn = 2 * std::numbers::pi * soft_cycles;
  const double cycles = turn * part;
  const double stiffness = cycles * (2 * soft_damping + cycles);
  const Softness hard;
  const Softness soft{turn * sub_steps / (whole_ * (2 * soft_damping + cycles)), settings.push_out_speed,
                      stiffness / (1 + stiffness), 1 / (1 + stiffness)};
  for (int sub_step = 0; sub_step < sub_steps; ++sub_step) {
    begin_sub_step(bodies, loads, settings, h);
    for (ContactConstraint& constraint : constraints) {
      if (sub_step > 0) refresh(constraint);
      warm_start(constraint, sub_step > 0 ? 1 : part);
    }
    const double remaining = dt - (sub_step + 1) * h;
    for (SolverBody& body : bodies_) body.drive_impulse = body.drive_angular_impulse = Vec3::Zero();
    const auto run = [&](const Softness& softness, int count) {
      for (int k = 0; k < count; ++k) {
        double change = 0;
        for (SolverBody& body : bodies_) change = std::max(change, solve_drive(bodies, body, h, remaining));
        change = std::max(change, pass(constraints, softness, h, k % 2 == 1));
        if (change < settled) break;
      }
    };
    run(soft, passes);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      bodies_[i].lag = bodies_[i].movable ? Vec3(0.5 * (before_linear_[i] - bodies_[i].linear)) : Vec3(0, 0, 0);
    for (ContactConstraint& constraint : constraints) {
      for (int i = 0; i < constraint.count; ++i) {
        PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
        if (point.normal_impulse == 0) continue;
        const double grip = constraint.friction * point.normal_impulse;
        const bool slides = point.friction_impulse.squaredNorm() >= 0.999 * grip * grip;
        for (SolverBody* body : {&at(constraint.a), &at(constraint.b)}) {
          body->pressed = body->touched = true;
          if (slides || body->round)
            body->lag -= constraint.manifold.normal * constraint.manifold.normal.dot(body->lag);
          else
            body->lag = Vec3::Zero();
        }
      }
    }
    for (SolverBody& body : bodies_)
      if (body.impact && body.pressed) body.lag = Vec3::Zero();
    end_sub_step(h);
    run(hard, relaxing);
    add_totals(constraints);
  }
  if (part < 1)
    for (ContactConstraint& constraint : constraints) blend_impulses(constraint, 1 - part);
  rebound(constraints, islands, settings.iterations);

  for (SolverBody& entry : bodies_) {
    if (!entry.movable || !entry.touched) continue;
    Body& body = bodies[entry.index];
    body.center = entry.center + entry.push_linear;
    body.twist = {entry.linear, entry.angular};
    Quat rotation = entry.rotation;
    if (entry.push_angular != Vec3::Zero()) {
      rotation = exp_map(entry.push_angular) * rotation;
      rotation.normalize();
    }
    body.follow_center(rotation);
    moved_[entry.index] = 1;
  }
}

}  // namespace tweenfall
