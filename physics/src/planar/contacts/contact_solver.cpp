#include "planar/contacts/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planar/joints.h"
#include "step/softness.h"

namespace tweenfall::planar::inner {

namespace {

/// Gaps of rebounding contacts are left to the blows.
constexpr double unheld = 1e30;

BodyRow row_of(const Body& body) {
  return {body.velocity.x(), body.velocity.y(), body.spin, 0};
}

}  // namespace

void ContactSolver::color(const Scene& scene) {
  coloring_.reset(scene.bodies.size());
  const std::size_t count = scene.active.size();
  colors_.resize(count);
  places_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Meeting& meeting = scene.meetings[scene.active[k]];
    colors_[k] =
        coloring_.color(meeting.a, scene.bodies[meeting.a].movable, meeting.b, scene.bodies[meeting.b].movable);
  }
  color_counts_.assign(coloring_.end(), 0);
  for (const std::uint32_t color : colors_) ++color_counts_[color];
  next_places_.clear();
  std::uint32_t total = 0;
  for (const std::uint32_t of_color : color_counts_) {
    next_places_.push_back(total * lane_count);
    total += (of_color + lane_count - 1) / lane_count;
  }
  blocks_.resize(total);
  const auto nobody = static_cast<std::uint32_t>(scene.bodies.size());
  const auto clear = [&](std::uint32_t block) {
    blocks_[block] = {};
    for (int lane = 0; lane < lane_count; ++lane) blocks_[block].a[lane] = blocks_[block].b[lane] = nobody;
  };
  for (std::size_t c = 0; c < color_counts_.size(); ++c)
    if (color_counts_[c] % lane_count != 0) clear((next_places_[c] + color_counts_[c]) / lane_count);
  for (ContactBlock& block : blocks_) block.points = 0;
  for (std::size_t k = 0; k < count; ++k) places_[k] = next_places_[colors_[k]]++;
}

void ContactSolver::fill(const Scene& scene, std::uint32_t k) {
  const Meeting& meeting = scene.meetings[scene.active[k]];
  const Body &a = scene.bodies[meeting.a], &b = scene.bodies[meeting.b];
  ContactBlock& block = blocks_[places_[k] / lane_count];
  const int lane = static_cast<int>(places_[k] % lane_count);
  const Vec2 normal = a.turn * meeting.normal, apart = b.center - a.center;
  block.a[lane] = meeting.a;
  block.b[lane] = meeting.b;
  block.points = std::max(block.points, meeting.count);
  block.normal_x[lane] = normal.x();
  block.normal_y[lane] = normal.y();
  block.friction[lane] = meeting.friction;
  block.ahead[lane] = meeting.restitution > 0 ? unheld : scene.sub_steps / scene.dt;
  block.inverse_mass_a[lane] = a.inverse_mass;
  block.inverse_mass_b[lane] = b.inverse_mass;
  block.inverse_moment_a[lane] = a.inverse_moment;
  block.inverse_moment_b[lane] = b.inverse_moment;
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  const double skin_a = skin_of(a, scene.makeups[meeting.a], meeting.part_a),
               skin_b = skin_of(b, scene.makeups[meeting.b], meeting.part_b);
  for (int i = 0; i < 2; ++i) {
    PointRow& point = block.point[i];
    const auto n = static_cast<std::size_t>(i);
    point.total_normal[lane] = point.total_sideways[lane] = 0;
    if (i >= meeting.count) {
      point.turn_a[lane] = point.turn_b[lane] = point.slip_a[lane] = point.slip_b[lane] = 0;
      point.gap[lane] = point.mass[lane] = point.slip_mass[lane] = point.normal[lane] = point.sideways[lane] = 0;
      continue;
    }
    const Vec2 core_a = a.turn * meeting.core_a[n], core_b = b.turn * meeting.core_b[n];
    const double turn_a = cross(core_a, normal), turn_b = cross(core_b, normal);
    const double slip_a = core_a.dot(normal) + skin_a, slip_b = core_b.dot(normal) - skin_b;
    const double closing = normal.dot(a.velocity - b.velocity) + (turn_a * a.spin - turn_b * b.spin);
    given[k].approach = std::max(given[k].approach, closing);
    point.turn_a[lane] = turn_a;
    point.turn_b[lane] = turn_b;
    point.slip_a[lane] = slip_a;
    point.slip_b[lane] = slip_b;
    point.gap[lane] = normal.dot(apart + (core_b - core_a)) - (skin_a + skin_b);
    point.mass[lane] = 1 / (inverse_mass + (a.inverse_moment * turn_a * turn_a + b.inverse_moment * turn_b * turn_b));
    point.slip_mass[lane] =
        1 / (inverse_mass + (a.inverse_moment * slip_a * slip_a + b.inverse_moment * slip_b * slip_b));
    point.normal[lane] = scene.warmth * meeting.pressing[n];
    point.sideways[lane] = scene.warmth * meeting.dragging[n];
  }
}

void ContactSolver::build(const Scene& scene) {
  const std::size_t rows = scene.bodies.size() + 1;
  velocities_.assign(rows, {});
  displacements_.assign(rows, {});
  starts_.assign(rows, {});
  unpushed_.resize(rows);
  struck_at_.assign(rows, 0);
  for (const std::uint32_t i : scene.moving) velocities_[i] = starts_[i] = row_of(scene.bodies[i]);
  color(scene);
  given.assign(scene.active.size(), {});
  bouncy_.clear();
  rolling_.clear();
  for (std::uint32_t k = 0; k < scene.active.size(); ++k) {
    fill(scene, k);
    const Meeting& meeting = scene.meetings[scene.active[k]];
    if (meeting.restitution > 0) bouncy_.push_back({places_[k], k, meeting.restitution, meeting.count});
    if (meeting.rolling_friction > 0) {
      const double inverse = scene.bodies[meeting.a].inverse_moment + scene.bodies[meeting.b].inverse_moment;
      rolling_.push_back({places_[k], k, meeting.rolling_friction, 1 / inverse, scene.warmth * meeting.rolling});
    }
  }
}

/// The pull of a driven body, as it will be at the end of the sub-step.
/// Source: Catto, Soft Constraints, GDC 2011.
void ContactSolver::pull(const Body& body, Makeup& makeup, std::uint32_t index, double h, double ahead) {
  const Drive& drive = makeup.drive;
  const Motion& target = makeup.target;
  BodyRow& v = velocities_[index];
  const BodyRow& moved = displacements_[index];
  const double w = 2 * std::numbers::pi * drive.hz, damping = 2 * drive.zeta * w;
  const double stiffness = h * (damping + h * w * w), softened = 1 / (1 + stiffness);
  const Vec2 arm = Turn::of(target.angle) * makeup.mass.center;
  const Vec2 speed = target.velocity + target.spin * quarter(arm);
  const Vec2 off = (target.position + arm - speed * ahead) - (body.center + Vec2(moved.x, moved.y));
  const double off_angle = (target.angle - target.spin * ahead) - (body.angle + moved.turn);
  // What is left of it when its force is limited.
  const auto bounded = [&](const Vec2& change, double inverse, double most) -> Vec2 {
    const double allowed = most * h * inverse, size = change.norm();
    if (size <= allowed) return change;
    makeup.saturated = true;
    return change * (allowed / size);
  };
  const Vec2 velocity(v.x, v.y);
  const Vec2 wanted = softened * (velocity + h * (w * w * off + damping * speed));
  const Vec2 change = bounded(wanted - velocity, body.inverse_mass, drive.max_force);
  const double wanted_spin = softened * (v.turn + h * (w * w * off_angle + damping * target.spin));
  const Vec2 turning = bounded(Vec2(wanted_spin - v.turn, 0), body.inverse_moment, drive.max_torque);
  v.x += change.x();
  v.y += change.y();
  v.turn += turning.x();
}

/// @param again  rows stay as they are through a step: what contacts gave a body in one sub-step, they give it at the
///               start of the next
void ContactSolver::begin_sub_step(const Scene& scene, double h, int left, bool again) {
  const bool at_once = again && bouncy_.empty();
  if (again && !at_once) gifts_.resize(velocities_.size());
  for (const std::uint32_t i : scene.moving) {
    const Gain& gain = gains[i];
    BodyRow& v = velocities_[i];
    BodyRow& unpushed = unpushed_[i];
    const BodyRow start = v, gift = {v.x - unpushed.x, v.y - unpushed.y, v.turn - unpushed.turn, 0};
    starts_[i] = start;
    v = {(v.x + gain.x * h) * gain.keep, (v.y + gain.y * h) * gain.keep, (v.turn + gain.turn * h) * gain.keep_turn, 0};
    if (gain.driven) pull(scene.bodies[i], scene.makeups[i], i, h, left * h);
    if (at_once) {
      unpushed = v;
      v = {v.x + gift.x, v.y + gift.y, v.turn + gift.turn, 0};
    } else if (again) {
      gifts_[i] = gift;
    }
  }
  if (at_once) return;
  if (!bouncy_.empty()) strike(h);
  unpushed_ = velocities_;
  if (again) give_again(scene);
}

void ContactSolver::give_again(const Scene& scene) {
  for (const std::uint32_t i : scene.moving) {
    BodyRow& v = velocities_[i];
    const BodyRow& gift = gifts_[i];
    v.x += gift.x;
    v.y += gift.y;
    v.turn += gift.turn;
  }
}

/// A body that was not pushed flies by the mean of its velocities, exactly; others move by what the pushes left.
void ContactSolver::move(const Scene& scene, double h) {
  for (const std::uint32_t i : scene.moving) {
    const BodyRow &v = velocities_[i], &unpushed = unpushed_[i], &start = starts_[i];
    BodyRow& moved = displacements_[i];
    const bool flies = v.x == unpushed.x && v.y == unpushed.y && v.turn == unpushed.turn && !gains[i].driven;
    if (flies) {
      moved.x += 0.5 * (start.x + v.x) * h;
      moved.y += 0.5 * (start.y + v.y) * h;
      moved.turn += 0.5 * (start.turn + v.turn) * h;
    } else {
      moved.x += v.x * h;
      moved.y += v.y * h;
      moved.turn += v.turn * h;
    }
  }
}

void ContactSolver::store(const Scene& scene) {
  for (std::uint32_t k = 0; k < scene.active.size(); ++k) {
    Meeting& meeting = scene.meetings[scene.active[k]];
    const ContactBlock& block = blocks_[places_[k] / lane_count];
    const auto lane = static_cast<std::int64_t>(places_[k] % lane_count);
    for (int i = 0; i < meeting.count; ++i) {
      const auto n = static_cast<std::size_t>(i);
      if (scene.kept > 0) {
        meeting.pressing[n] = scene.kept * block.point[i].normal[lane];
        meeting.dragging[n] = scene.kept * block.point[i].sideways[lane];
      }
      given[k].normal[i] += block.point[i].total_normal[lane];
      given[k].sideways[i] += block.point[i].total_sideways[lane];
    }
  }
  if (!(scene.kept > 0)) return;
  for (const Rolling& rolling : rolling_)
    scene.meetings[scene.active[rolling.active]].rolling = scene.kept * rolling.impulse;
}

void ContactSolver::finish(const Scene& scene) {
  for (const std::uint32_t i : scene.moving) {
    Body& body = scene.bodies[i];
    if (!body.movable) continue;
    const BodyRow &v = velocities_[i], &moved = displacements_[i];
    body.velocity = Vec2(v.x, v.y);
    body.spin = v.turn;
    body.center += Vec2(moved.x, moved.y);
    if (moved.turn == 0) continue;
    body.angle += moved.turn;
    body.turn = Turn::of(body.angle);
  }
}

void ContactSolver::solve(Scene scene) {
  const double h = scene.dt / scene.sub_steps;
  const step::Softness softness = step::soft_contacts(scene.push_out_speed, scene.dt, scene.sub_steps, scene.parts);
  PassRule soft{softness.rate, softness.speed, softness.firm, 1 - softness.giving, 1 / h, false};
  const PassRule hard{.inverse_h = 1 / h, .sum_up = true};
  parts_ = scene.parts;
  build(scene);
  JointRows joints(scene.bodies, scene.makeups, scene.joints, h, scene.warmth, scene.parts);
  const Kernels& kernel = kernels();
  const bool contacts_alone = joints.empty() && rolling_.empty();
  for (int sub_step = 0; sub_step < scene.sub_steps; ++sub_step) {
    const bool again = contacts_alone && sub_step > 0;
    begin_sub_step(scene, h, scene.sub_steps - 1 - sub_step, again);
    joints.begin_sub_step(displacements_, velocities_);
    if (!again) kernel.warm_start(blocks_.data(), blocks_.size(), velocities_.data());
    warm_start_rolling();
    joints.solve(velocities_, true);
    resist_rolling();
    const bool relaxes = scene.relaxes_each || sub_step + 1 == scene.sub_steps;
    soft.sum_up = !relaxes;
    kernel.solve(blocks_.data(), blocks_.size(), velocities_.data(), displacements_.data(), soft);
    move(scene, h);
    joints.solve(velocities_, false);
    if (relaxes) kernel.solve(blocks_.data(), blocks_.size(), velocities_.data(), displacements_.data(), hard);
    resist_rolling();
    joints.end_sub_step();
  }
  joints.end_step(displacements_);
  joints.keep(scene.kept);
  store(scene);
  finish(scene);
}

}  // namespace tweenfall::planar::inner
