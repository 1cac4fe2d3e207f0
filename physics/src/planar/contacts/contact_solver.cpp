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
  const auto nobody = row_length * static_cast<std::uint32_t>(scene.bodies.size());
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
  ContactBlock& block = blocks_[places_[k] / lane_count];
  const int lane = static_cast<int>(places_[k] % lane_count);
  block.a[lane] = row_length * meeting.a;
  block.b[lane] = row_length * meeting.b;
  block.points = std::max(block.points, meeting.count);
  block.normal_x[lane] = meeting.normal.x();
  block.normal_y[lane] = meeting.normal.y();
  block.skin_a[lane] = skin_of(scene.bodies[meeting.a], scene.makeups[meeting.a], meeting.part_a);
  block.skin_b[lane] = skin_of(scene.bodies[meeting.b], scene.makeups[meeting.b], meeting.part_b);
  block.friction[lane] = meeting.friction;
  block.ahead[lane] = meeting.restitution > 0 ? unheld : scene.sub_steps / scene.dt;
  for (int i = 0; i < 2; ++i) {
    PointRow& point = block.point[i];
    const auto n = static_cast<std::size_t>(i);
    const bool there = i < meeting.count;
    point.mass[lane] = there ? 1 : 0;
    point.turn_a[lane] = there ? meeting.core_a[n].x() : 0;
    point.turn_b[lane] = there ? meeting.core_a[n].y() : 0;
    point.slip_a[lane] = there ? meeting.core_b[n].x() : 0;
    point.slip_b[lane] = there ? meeting.core_b[n].y() : 0;
    point.normal[lane] = there ? scene.warmth * meeting.pressing[n] : 0;
    point.sideways[lane] = there ? scene.warmth * meeting.dragging[n] : 0;
  }
}

void ContactSolver::build(const Scene& scene) {
  const std::size_t rows = scene.bodies.size() + 1;
  velocities_.assign(rows, {});
  displacements_.assign(rows, {});
  starts_.assign(rows, {});
  unpushed_.resize(rows);
  struck_at_.resize(rows);
  poses_.assign(rows, {});
  masses_.assign(rows, {});
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    poses_[i] = {body.center.x(), body.center.y(), body.turn.cos, body.turn.sin};
    masses_[i] = {body.inverse_mass, body.inverse_moment, 0, 0};
  }
  plain_.clear();
  special_.clear();
  for (const std::uint32_t i : scene.moving) {
    const Body& body = scene.bodies[i];
    velocities_[i] = starts_[i] = row_of(body);
    (body.driven || (body.damped && body.movable) ? special_ : plain_).push_back(i);
  }
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
  kernels().prepare(blocks_.data(), blocks_.size(), {velocities_.data(), poses_.data(), masses_.data()});
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

BodyRows ContactSolver::rows() {
  return {velocities_.data(), starts_.data(), unpushed_.data(), displacements_.data(), gains.data()};
}

/// What a body that is damped or driven does by itself.
void ContactSolver::begin(const Scene& scene, std::uint32_t index, double h, int left) {
  const Body& body = scene.bodies[index];
  const BodyRow& gain = gains[index];
  BodyRow& v = velocities_[index];
  starts_[index] = v;
  const Damped keep = body.damped && body.movable ? damped[index] : Damped{};
  v = {(v.x + gain.x * h) * keep.linear, (v.y + gain.y * h) * keep.linear, (v.turn + gain.turn * h) * keep.angular, 0};
  if (body.driven) pull(body, scene.makeups[index], index, h, left * h);
}

/// @param again  rows stay as they are through a step: what contacts gave a body in one sub-step, they give it at the
///               start of the next
void ContactSolver::begin_sub_step(const Scene& scene, double h, int left, bool again) {
  if (!bouncy_.empty()) return begin_between_blows(scene, h, left, again);
  kernels().begin(rows(), plain_, h, again);
  for (const std::uint32_t i : special_) {
    BodyRow& v = velocities_[i];
    BodyRow& unpushed = unpushed_[i];
    const BodyRow gift = {v.x - unpushed.x, v.y - unpushed.y, v.turn - unpushed.turn, 0};
    begin(scene, i, h, left);
    unpushed = v;
    if (again) v = {v.x + gift.x, v.y + gift.y, v.turn + gift.turn, 0};
  }
}

void ContactSolver::begin_between_blows(const Scene& scene, double h, int left, bool again) {
  if (again) gifts_.resize(velocities_.size());
  for (const std::uint32_t i : scene.moving) {
    const BodyRow &v = velocities_[i], &unpushed = unpushed_[i];
    if (again) gifts_[i] = {v.x - unpushed.x, v.y - unpushed.y, v.turn - unpushed.turn, 0};
    begin(scene, i, h, left);
  }
  strike(h);
  unpushed_ = velocities_;
  if (!again) return;
  for (const std::uint32_t i : scene.moving) {
    BodyRow& v = velocities_[i];
    const BodyRow& gift = gifts_[i];
    v.x += gift.x;
    v.y += gift.y;
    v.turn += gift.turn;
  }
}

void ContactSolver::move(const Scene& scene, double h) {
  kernels().move(rows(), plain_, h);
  for (const std::uint32_t i : special_) move(scene, i, h);
}

void ContactSolver::move(const Scene& scene, std::uint32_t index, double h) {
  const BodyRow &v = velocities_[index], &unpushed = unpushed_[index], &start = starts_[index];
  BodyRow& moved = displacements_[index];
  const bool flies = v.x == unpushed.x && v.y == unpushed.y && v.turn == unpushed.turn && !scene.bodies[index].driven;
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

/// From one sub-step to the next, where nothing comes between them.
void ContactSolver::move_on(const Scene& scene, double h, int left) {
  kernels().move_on(rows(), plain_, h);
  for (const std::uint32_t i : special_) {
    move(scene, i, h);
    BodyRow& v = velocities_[i];
    BodyRow& unpushed = unpushed_[i];
    const BodyRow gift = {v.x - unpushed.x, v.y - unpushed.y, v.turn - unpushed.turn, 0};
    begin(scene, i, h, left);
    unpushed = v;
    v = {v.x + gift.x, v.y + gift.y, v.turn + gift.turn, 0};
  }
}

void ContactSolver::store(const Scene& scene) {
  for (std::uint32_t k = 0; k < scene.active.size(); ++k) {
    Meeting& meeting = scene.meetings[scene.active[k]];
    const ContactBlock& block = blocks_[places_[k] / lane_count];
    const auto lane = static_cast<std::int64_t>(places_[k] % lane_count);
    given[k].approach = block.approach[lane];
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
  bool begun = false;
  for (int sub_step = 0; sub_step < scene.sub_steps; ++sub_step) {
    const bool again = contacts_alone && sub_step > 0;
    const int left = scene.sub_steps - 1 - sub_step;
    if (!begun) begin_sub_step(scene, h, left, again);
    joints.begin_sub_step(displacements_, velocities_);
    if (!again) kernel.warm_start(blocks_.data(), blocks_.size(), velocities_.data());
    warm_start_rolling();
    joints.solve(velocities_, true);
    resist_rolling();
    const bool relaxes = scene.relaxes_each || left == 0;
    soft.sum_up = !relaxes;
    kernel.solve(blocks_.data(), blocks_.size(), velocities_.data(), displacements_.data(), soft);
    begun = contacts_alone && bouncy_.empty() && !relaxes;
    if (begun) {
      move_on(scene, h, left - 1);
      continue;
    }
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
