#include "planar/joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::planar::inner {

namespace {

// How a joint that is apart is drawn together: frequency times the sub-step, and damping ratio.
constexpr double joint_cycles = 0.25;
constexpr double joint_damping = 2;

}  // namespace

JointRows::JointRows(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Joint>& joints,
                     double h, double warmth)
    : h_(h) {
  const double turn = 2 * std::numbers::pi * joint_cycles, stiffness = turn * (2 * joint_damping + turn);
  rate_ = turn / (h * (2 * joint_damping + turn));
  firm_ = stiffness / (1 + stiffness);
  giving_ = 1 / (1 + stiffness);
  const auto nobody = static_cast<std::uint32_t>(bodies.size());
  for (Joint& joint : joints) {
    if (!joint.alive) continue;
    Row row;
    row.joint = &joint;
    const auto end = [&](const BodyId& id, const Vec2& anchor, std::uint32_t& index, double& inverse_mass,
                         double& inverse_moment, Vec2& center, double& angle, Vec2& local) {
      index = nobody;
      center = anchor;
      if (id == BodyId{}) return false;
      index = id.index;
      const Body& body = bodies[index];
      inverse_mass = body.inverse_mass;
      inverse_moment = body.inverse_moment;
      center = body.center;
      angle = body.angle;
      local = anchor - makeups[index].mass.center;
      return body.under_way;
    };
    const JointSettings& its = joint.settings;
    const bool a_moves = end(its.a, its.anchor_a, row.a, row.inverse_mass_a, row.inverse_moment_a, row.center_a,
                             row.angle_a, row.local_a);
    const bool b_moves = end(its.b, its.anchor_b, row.b, row.inverse_mass_b, row.inverse_moment_b, row.center_b,
                             row.angle_b, row.local_b);
    joint.total = Vec2(0, 0);
    if (!(a_moves || b_moves) || row.inverse_mass_a + row.inverse_mass_b == 0) continue;
    joint.impulse *= warmth;
    for (double* one : {&joint.pull, &joint.push, &joint.motor, &joint.lower, &joint.upper}) *one *= warmth;
    rows_.push_back(row);
  }
}

void JointRows::push(const Row& row, const Vec2& impulse, std::vector<BodyRow>& velocities) const {
  BodyRow &a = velocities[row.a], &b = velocities[row.b];
  a.x -= row.inverse_mass_a * impulse.x();
  a.y -= row.inverse_mass_a * impulse.y();
  a.turn -= row.inverse_moment_a * cross(row.arm_a, impulse);
  b.x += row.inverse_mass_b * impulse.x();
  b.y += row.inverse_mass_b * impulse.y();
  b.turn += row.inverse_moment_b * cross(row.arm_b, impulse);
}

void JointRows::twist(const Row& row, double impulse, std::vector<BodyRow>& velocities) const {
  velocities[row.a].turn -= row.inverse_moment_a * impulse;
  velocities[row.b].turn += row.inverse_moment_b * impulse;
}

Vec2 JointRows::parting(const Row& row, const std::vector<BodyRow>& velocities) const {
  const BodyRow &a = velocities[row.a], &b = velocities[row.b];
  return Vec2(b.x - a.x, b.y - a.y) + b.turn * quarter(row.arm_b) - a.turn * quarter(row.arm_a);
}

void JointRows::begin_sub_step(const std::vector<BodyRow>& displacements, std::vector<BodyRow>& velocities) {
  for (Row& row : rows_) {
    Joint& joint = *row.joint;
    const BodyRow &moved_a = displacements[row.a], &moved_b = displacements[row.b];
    row.arm_a = Turn::of(row.angle_a + moved_a.turn) * row.local_a;
    row.arm_b = Turn::of(row.angle_b + moved_b.turn) * row.local_b;
    if (joint.settings.a == BodyId{}) row.arm_a = Vec2(0, 0);
    if (joint.settings.b == BodyId{}) row.arm_b = Vec2(0, 0);
    row.apart =
        (row.center_b - row.center_a) + Vec2(moved_b.x - moved_a.x, moved_b.y - moved_a.y) + (row.arm_b - row.arm_a);
    row.turned = (row.angle_b - row.angle_a) + (moved_b.turn - moved_a.turn);
    if (std::holds_alternative<Hinge>(joint.settings.kind)) {
      push(row, joint.impulse, velocities);
      twist(row, joint.motor + joint.lower - joint.upper, velocities);
      continue;
    }
    row.length = row.apart.norm();
    row.along = row.length > 0 ? Vec2(row.apart / row.length) : Vec2(1, 0);
    const double turn_a = cross(row.arm_a, row.along), turn_b = cross(row.arm_b, row.along);
    row.mass = 1 / (row.inverse_mass_a + row.inverse_mass_b + row.inverse_moment_a * turn_a * turn_a +
                    row.inverse_moment_b * turn_b * turn_b);
    push(row, (joint.push - joint.pull) * row.along, velocities);
  }
}

void JointRows::hold(Row& row, const Hinge& hinge, std::vector<BodyRow>& velocities, bool soft) const {
  Joint& joint = *row.joint;
  const double inverse_moment = row.inverse_moment_a + row.inverse_moment_b;
  const auto spin = [&] { return velocities[row.b].turn - velocities[row.a].turn; };
  if (hinge.motor_torque > 0 && inverse_moment > 0) {
    const double most = hinge.motor_torque * h_;
    const double next = std::clamp(joint.motor + (hinge.motor_speed - spin()) / inverse_moment, -most, most);
    twist(row, next - joint.motor, velocities);
    joint.motor = next;
  }
  // Room that is left may be used up within the sub-step; what is too much is taken back softly.
  const auto limit = [&](double& impulse, double room, double sign) {
    if (!(inverse_moment > 0)) return;
    const double wanted = room > 0 ? room / h_ : soft ? rate_ * room : 0;
    const double firm = room > 0 || !soft ? 1 : firm_, giving = room > 0 || !soft ? 0 : giving_;
    const double next = std::max(0.0, (1 - giving) * impulse - firm * (sign * spin() + wanted) / inverse_moment);
    twist(row, sign * (next - impulse), velocities);
    impulse = next;
  };
  if (std::isfinite(hinge.lower)) limit(joint.lower, row.turned - hinge.lower, 1);
  if (std::isfinite(hinge.upper)) limit(joint.upper, hinge.upper - row.turned, -1);
  const Vec2 &ra = row.arm_a, &rb = row.arm_b;
  const double masses = row.inverse_mass_a + row.inverse_mass_b;
  const double ia = row.inverse_moment_a, ib = row.inverse_moment_b;
  const double xx = masses + ia * ra.y() * ra.y() + ib * rb.y() * rb.y();
  const double yy = masses + ia * ra.x() * ra.x() + ib * rb.x() * rb.x();
  const double xy = -(ia * ra.x() * ra.y() + ib * rb.x() * rb.y());
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return;
  Vec2 speed = parting(row, velocities);
  if (soft) speed += rate_ * row.apart;
  const Vec2 solved = Vec2(yy * speed.x() - xy * speed.y(), xx * speed.y() - xy * speed.x()) / determinant;
  const Vec2 change = soft ? Vec2(-firm_ * solved - giving_ * joint.impulse) : Vec2(-solved);
  push(row, change, velocities);
  joint.impulse += change;
}

void JointRows::hold(Row& row, const Distance& distance, std::vector<BodyRow>& velocities, bool soft) const {
  Joint& joint = *row.joint;
  const bool rod = distance.shortest == distance.longest;
  const auto bound = [&](double& impulse, double room, double sign) {
    const bool free = room > 0 && !rod;
    const double wanted = free ? room / h_ : soft ? rate_ * room : 0;
    const double firm = free || !soft ? 1 : firm_, giving = free || !soft ? 0 : giving_;
    const double speed = sign * row.along.dot(parting(row, velocities));
    double next = (1 - giving) * impulse - firm * row.mass * (speed + wanted);
    if (!rod) next = std::max(0.0, next);
    push(row, sign * (next - impulse) * row.along, velocities);
    impulse = next;
  };
  bound(joint.push, row.length - distance.shortest, 1);
  if (!rod) bound(joint.pull, distance.longest - row.length, -1);
}

void JointRows::solve(std::vector<BodyRow>& velocities, bool soft) {
  for (Row& row : rows_)
    std::visit([&](const auto& kind) { hold(row, kind, velocities, soft); }, row.joint->settings.kind);
}

void JointRows::end_sub_step() {
  for (Row& row : rows_) {
    Joint& joint = *row.joint;
    const bool hinge = std::holds_alternative<Hinge>(joint.settings.kind);
    joint.total += hinge ? joint.impulse : Vec2((joint.push - joint.pull) * row.along);
  }
}

}  // namespace tweenfall::planar::inner
