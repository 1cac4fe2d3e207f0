#include "islands/blocks/contact_blocks.h"

#include <algorithm>
#include <cmath>

#include "step/contact_rows.h"
#include "step/softness.h"

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using contacts::PointConstraint;

namespace {

/// In a part shorter than half of a step, the impulses of contacts are mostly their own settling, and in a step far
/// shorter than the one before mostly rounding: the earlier impulses are kept, unless they are older than this many
/// sub-steps, and this part is long enough.
constexpr double most_parts = 2, long_enough = 0.15, old_after = 24;

void put(Lanes3& lanes, int lane, const Vec3& value) {
  lanes.x[lane] = value.x();
  lanes.y[lane] = value.y();
  lanes.z[lane] = value.z();
}

void put(MeetingRow& row, int lane, const contacts::Closing& closing, bool heeded) {
  row.pull[lane] = closing.pull;
  row.tremble[lane] = closing.tremble;
  row.heeded[lane] = heeded ? 1 : 0;
}

template <class Visit>
void each_lane(const Uncleared<ContactBlocks::Origin>& origins, const threads::Workers& work, const Visit& visit) {
  constexpr std::size_t worth_a_part = 16;
  work.ranges(origins.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int lane = 0; lane < lane_count; ++lane)
        if (ContactConstraint* contact = origins[i][static_cast<std::size_t>(lane)]) visit(i, lane, *contact);
  });
}

}  // namespace

void ContactBlocks::build(std::span<ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
                          const std::vector<IslandBody>& bodies, std::span<const contacts::Closing> closings, double h,
                          const threads::Workers& work) {
  find_keys(contacts, places, bodies, work);
  sort_by_key();
  drifting_ =
      std::ranges::any_of(bodies, [](const IslandBody& body) { return body.conveys || body.led != step::not_led; });
  room = static_cast<std::uint32_t>(bodies.size());
  lay_out();
  find_phases();
  constexpr std::size_t worth_a_part = 16;
  work.ranges(fillings_.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Filling& filling = fillings_[i];
      clear(filling);
      if (!filling.of_balls) clear_rows(blocks[filling.index], filling, contacts);
      for (std::uint32_t lane = 0; lane < filling.count; ++lane) {
        const std::uint32_t number = sorted_[filling.first + lane];
        if (filling.of_balls)
          fill_ball(filling.index, static_cast<int>(lane), *contacts[number], bodies, ends[number], closings[number],
                    h);
        else
          fill(filling.index, static_cast<int>(lane), *contacts[number], bodies, ends[number], closings[number], h);
      }
      const auto to_nobody = [&filling](auto& block) {
        for (std::uint32_t* to : {block.to_a, block.to_b})
          for (int lane = 0; lane < lane_count; ++lane)
            if (to[lane] == 0) to[lane] = filling.room;
      };
      if (filling.of_balls)
        to_nobody(balls[filling.index]);
      else
        to_nobody(blocks[filling.index]);
    }
  });
}

void ContactBlocks::clear(const Filling& filling) {
  if (filling.of_balls) {
    balls[filling.index] = {};
    ball_meetings[filling.index] = {};
    ball_origins[filling.index] = {};
    return;
  }
  ContactBlock& block = blocks[filling.index];
  const BlockMakeup makeup = block;
  block = {makeup};
  meetings[filling.index] = {};
  origins[filling.index] = {};
}

/// Rows keep what an earlier step left in them. What is filled in for every lane needs no clearing.
void ContactBlocks::clear_rows(const ContactBlock& block, const Filling& filling,
                               std::span<ContactConstraint* const> contacts) {
  const std::span its_points = std::span(points).subspan(block.point, static_cast<std::size_t>(block.points));
  const std::span its_frictions =
      std::span(frictions).subspan(block.friction, static_cast<std::size_t>(block.frictions));
  bool full = filling.count == lane_count;
  for (std::uint32_t lane = 0; lane < filling.count; ++lane)
    full = full && contacts[sorted_[filling.first + lane]]->count == block.points;
  if (!full) {
    std::ranges::fill(its_points, PointRow{});
    std::ranges::fill(its_frictions, FrictionRow{});
    return;
  }
  for (PointRow& row : its_points) row.total = row.back = all(0);
  for (FrictionRow& row : its_frictions) row.total_first = row.total_second = all(0);
}

void ContactBlocks::fill_ball(std::size_t ball, int lane, ContactConstraint& contact,
                              const std::vector<IslandBody>& bodies, const Ends& own, const contacts::Closing& closing,
                              double h) {
  BallBlock& block = balls[ball];
  const IslandBody& a = bodies[block.a[lane] = own.a];
  const IslandBody& b = bodies[block.b[lane] = own.b];
  if (a.movable) block.to_a[lane] = block.a[lane];
  if (b.movable) block.to_b[lane] = block.b[lane];
  const Vec3& normal = contact.manifold.normal;
  const PointConstraint& point = contact.points[0];
  const double ratio = contact.kept_step > h ? h / contact.kept_step : 1;
  const double arm_a = a.movable ? normal.dot(point.start_arm_a) : 0;
  const double arm_b = b.movable ? -normal.dot(point.start_arm_b) : 0;
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  put(block.normal, lane, normal);
  block.inverse_mass_a[lane] = a.inverse_mass;
  block.inverse_mass_b[lane] = b.inverse_mass;
  block.arm_a[lane] = arm_a;
  block.arm_b[lane] = arm_b;
  block.spin_a[lane] = arm_a * a.inverse_moment;
  block.spin_b[lane] = arm_b * b.inverse_moment;
  block.mass[lane] = 1 / inverse_mass;
  block.slip_mass[lane] = 1 / (inverse_mass + arm_a * arm_a * a.inverse_moment + arm_b * arm_b * b.inverse_moment);
  block.coefficient[lane] = contact.friction;
  block.hard[lane] = contact.impact || contact.eased > 0 || a.pulled || b.pulled ? -1 : 0;
  block.base[lane] = contacts::eased_gap(contact, point);
  block.impulse[lane] = ratio * point.kept_normal;
  put(block.friction, lane, ratio * (point.kept_friction - normal * normal.dot(point.kept_friction)));
  put(ball_meetings[ball], lane, closing, contact.restitution > 0 || (contact.impact && (a.jointed || b.jointed)));
  ball_origins[ball][static_cast<std::size_t>(lane)] = &contact;
}

void ContactBlocks::fill(std::size_t index, int lane, ContactConstraint& contact, const std::vector<IslandBody>& bodies,
                         const Ends& own, const contacts::Closing& closing, double h) {
  ContactBlock& block = blocks[index];
  const IslandBody& a = bodies[block.a[lane] = own.a];
  const IslandBody& b = bodies[block.b[lane] = own.b];
  if (a.movable) block.to_a[lane] = block.a[lane];
  if (b.movable) block.to_b[lane] = block.b[lane];
  origins[index][static_cast<std::size_t>(lane)] = &contact;
  const Vec3& normal = contact.manifold.normal;
  const step::Tangents along = step::tangents_of(normal);
  put(block.normal, lane, normal);
  put(block.tangent1, lane, along.first);
  put(block.tangent2, lane, along.second);
  block.round_a[lane] = a.round ? -1 : 0;
  block.round_b[lane] = b.round ? -1 : 0;
  block.inverse_mass_a[lane] = a.inverse_mass;
  block.inverse_mass_b[lane] = b.inverse_mass;
  block.inverse_moment_a[lane] = a.inverse_moment;
  block.inverse_moment_b[lane] = b.inverse_moment;
  block.coefficient[lane] = contact.friction;
  put(meetings[index], lane, closing, contact.restitution > 0 || (contact.impact && (a.jointed || b.jointed)));
  block.hard[lane] = contact.impact || contact.eased > 0 || a.pulled || b.pulled ? -1 : 0;
  const double ratio = contact.kept_step > h ? h / contact.kept_step : 1;
  block.twist[lane] = block.central() ? ratio * contact.kept_twist : 0;
  Vec3 friction = Vec3::Zero();
  for (int i = 0; i < contact.count; ++i) {
    const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    PointRow& row = points[block.point + static_cast<std::uint32_t>(i)];
    row.base[lane] = contacts::eased_gap(contact, point);
    row.impulse[lane] = ratio * point.kept_normal;
    friction += point.kept_friction;
    if (block.frictions != block.points) continue;
    FrictionRow& grip = frictions[block.friction + static_cast<std::uint32_t>(i)];
    grip.first[lane] = ratio * along.first.dot(point.kept_friction);
    grip.second[lane] = ratio * along.second.dot(point.kept_friction);
  }
  if (block.central()) {
    frictions[block.friction].first[lane] = ratio * along.first.dot(friction);
    frictions[block.friction].second[lane] = ratio * along.second.dot(friction);
  }
}

void ContactBlocks::store(double h, double dt, double parts, const threads::Workers& work) {
  /// Share of the greatest friction from which on a contact counts as sliding.
  constexpr double sliding = 0.999;
  const double whole = step::kept_as_whole(parts);
  const auto begin = [&](ContactConstraint& contact) {
    contact.slid = false;
    if (contact.kept_step > 0 && (parts > most_parts || h < long_enough * contact.kept_step)) {
      contact.passed_over += dt;
      if (contact.passed_over < old_after * contact.kept_step || whole < parts) return false;
    }
    contact.kept_step = whole * h;
    contact.passed_over = 0;
    contact.kept_twist = 0;
    return true;
  };
  each_lane(ball_origins, work, [&](std::size_t i, int lane, ContactConstraint& contact) {
    const BallBlock& block = balls[i];
    const bool keeps = begin(contact);
    PointConstraint& point = contact.points[0];
    const double normal = block.impulse[lane];
    const Vec3 friction = lane_of(block.friction, lane);
    point.total_normal = block.total[lane];
    point.total_friction = lane_of(block.total_friction, lane);
    const double most = sliding * contact.friction * normal;
    contact.slid = most > 0 && friction.squaredNorm() >= most * most;
    if (!keeps) return;
    point.kept_normal = whole * normal;
    point.kept_friction = whole * friction;
  });
  each_lane(origins, work, [&](std::size_t i, int lane, ContactConstraint& contact) {
    const ContactBlock& block = blocks[i];
    const bool keeps = begin(contact);
    if (keeps) contact.kept_twist = whole * block.twist[lane];
    const Vec3 along1 = lane_of(block.tangent1, lane), along2 = lane_of(block.tangent2, lane);
    double pressing = 0, twisting = 0;
    for (int k = 0; k < contact.count; ++k) {
      PointConstraint& point = contact.points[static_cast<std::size_t>(k)];
      const PointRow& row = points[block.point + static_cast<std::uint32_t>(k)];
      const double normal = row.impulse[lane];
      point.total_normal = row.total[lane];
      point.total_friction = Vec3::Zero();
      pressing += normal;
      twisting += normal * row.lever[lane];
      if (keeps) {
        point.kept_normal = whole * normal;
        point.kept_friction = Vec3::Zero();
      }
      if (block.frictions == 0) continue;
      // Friction at the middle is distributed evenly.
      const double share = block.central() ? 1.0 / contact.count : 1;
      const FrictionRow& grip = frictions[block.friction + (block.central() ? 0u : static_cast<std::uint32_t>(k))];
      const Vec3 friction = share * (grip.first[lane] * along1 + grip.second[lane] * along2) + Vec3::Zero();
      point.total_friction =
          share * (grip.total_first[lane] * along1 + grip.total_second[lane] * along2) + Vec3::Zero();
      if (keeps) point.kept_friction = whole * friction;
      const double most = sliding * contact.friction * normal;
      if (!block.central() && normal > 0 && friction.squaredNorm() >= most * most) contact.slid = true;
    }
    if (!block.central() || !(pressing > 0)) return;
    const FrictionRow& grip = frictions[block.friction];
    const double most = sliding * contact.friction * pressing;
    const double turning = sliding * contact.friction * twisting;
    contact.slid = grip.first[lane] * grip.first[lane] + grip.second[lane] * grip.second[lane] >= most * most ||
                   (turning > 0 && std::abs(block.twist[lane]) >= turning);
  });
}

}  // namespace tweenfall::blocks
