#include <utility>

#include "islands/blocks/contact_blocks.h"
#include "step/contact_rows.h"

/// Surfaces that move, and bodies carried by a led one.

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using contacts::PointConstraint;

namespace {

struct Arms {
  Vec3 a, b;            ///< from the centers to the contact
  Vec3 core_a, core_b;  ///< without the round skins
};

Arms arms_of(const ContactConstraint& contact, std::size_t i, const IslandBody& a, const IslandBody& b) {
  const PointConstraint& point = contact.points[i];
  const Vec3 skin_a = point.skin_a * contact.manifold.normal, skin_b = -point.skin_b * contact.manifold.normal;
  const Quat turn_a = a.rotation * a.start_rotation.conjugate(), turn_b = b.rotation * b.start_rotation.conjugate();
  return {state::carried(turn_a, point.start_arm_a, skin_a), state::carried(turn_b, point.start_arm_b, skin_b),
          turn_a * (point.start_arm_a - skin_a), turn_b * (point.start_arm_b - skin_b)};
}

Arms middle_of(const ContactConstraint& contact, const IslandBody& a, const IslandBody& b) {
  Arms middle{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double share = 1.0 / contact.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
    const Arms arms = arms_of(contact, i, a, b);
    middle.a += share * arms.a;
    middle.b += share * arms.b;
    middle.core_a += share * arms.core_a;
    middle.core_b += share * arms.core_b;
  }
  return middle;
}

/// Where the rows of a contact were prepared.
std::pair<Vec3, Vec3> arms_of_rows(const ContactConstraint& contact, std::size_t i, const IslandBody& a,
                                   const IslandBody& b) {
  const PointConstraint& point = contact.points[i];
  const Vec3 normal = contact.manifold.normal;
  return {state::carried(a.turn.quaternion(), point.start_arm_a, point.skin_a * normal),
          state::carried(b.turn.quaternion(), point.start_arm_b, -point.skin_b * normal)};
}

}  // namespace

void ContactBlocks::prepare_drifts(const std::vector<IslandBody>& bodies, bool again) {
  if (!drifting_) return;
  const auto moves = [](const IslandBody& body) { return body.conveys || body.led != step::not_led; };
  for (std::size_t index = 0; index < blocks.size(); ++index)
    for (int lane = 0; lane < lane_count; ++lane) {
      const ContactConstraint* contact = origins[index][static_cast<std::size_t>(lane)];
      if (!contact) continue;
      ContactBlock& block = blocks[index];
      const IslandBody &a = bodies[block.a[lane]], &b = bodies[block.b[lane]];
      if ((!moves(a) && !moves(b)) || (again && !a.stale && !b.stale)) continue;
      block.drifts = true;
      const auto put = [&](DriftRow& row, const Vec3& arm_a, const Vec3& arm_b) {
        const Vec3 drift = step::drift_at(a.surface, arm_a, b.surface, arm_b);
        row.first[lane] = row.later_first[lane] = lane_of(block.tangent1, lane).dot(drift);
        row.second[lane] = row.later_second[lane] = lane_of(block.tangent2, lane).dot(drift);
        row.twist[lane] = lane_of(block.normal, lane).dot(b.surface.angular - a.surface.angular);
      };
      Vec3 middle_a = Vec3::Zero(), middle_b = Vec3::Zero();
      const double share = 1.0 / contact->count;
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(contact->count); ++i) {
        const auto [arm_a, arm_b] = arms_of_rows(*contact, i, a, b);
        middle_a += share * arm_a;
        middle_b += share * arm_b;
        if (block.frictions == block.points) put(drifts[block.friction + i], arm_a, arm_b);
      }
      if (block.central()) put(drifts[block.friction], middle_a, middle_b);
    }
}

void ContactBlocks::ride(const std::vector<IslandBody>& bodies, std::span<const step::LedBody> led,
                         const std::vector<BodyLanes>& starts, double h) {
  for (std::size_t index = 0; index < blocks.size(); ++index) {
    const ContactBlock& block = blocks[index];
    if (!block.drifts) continue;
    for (int lane = 0; lane < lane_count; ++lane) {
      const ContactConstraint* contact = origins[index][static_cast<std::size_t>(lane)];
      if (!contact) continue;
      const IslandBody &a = bodies[block.a[lane]], &b = bodies[block.b[lane]];
      const bool on_a = a.led != step::not_led;
      if (!on_a && b.led == step::not_led) continue;
      const IslandBody &body = on_a ? b : a, &carrier = on_a ? a : b;
      const BodyLanes& start = starts[on_a ? block.b[lane] : block.a[lane]];
      const bool rolls = body.round && block.hard[lane] == 0 && !body.jointed && !body.held;
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(block.frictions); ++i) {
        if (!block.central() && i >= static_cast<std::uint32_t>(contact->count)) break;
        const Arms arms = block.central() ? middle_of(*contact, a, b) : arms_of(*contact, i, a, b);
        const step::Rider rider{{linear_of(start), angular_of(start)},
                                on_a ? arms.core_b : arms.core_a,
                                body.center + (on_a ? arms.b : arms.a) - carrier.center,
                                rolls};
        const step::SlipOfRider slip = step::slip_of_rider(led[carrier.led], on_a ? arms.a : arms.b, rider, h);
        const Vec3 surface = step::drift_at(a.surface, arms.a, b.surface, arms.b);
        const Vec3 moving = surface + (on_a ? slip.moving : Vec3(-slip.moving));
        const Vec3 after = surface + (on_a ? slip.after : Vec3(-slip.after));
        DriftRow& row = drifts[block.friction + i];
        const Vec3 along1 = lane_of(block.tangent1, lane), along2 = lane_of(block.tangent2, lane);
        row.first[lane] = along1.dot(moving);
        row.second[lane] = along2.dot(moving);
        row.later_first[lane] = along1.dot(after);
        row.later_second[lane] = along2.dot(after);
      }
    }
  }
}

void ContactBlocks::end_ride() {
  for (DriftRow& row : drifts) {
    row.first = row.later_first;
    row.second = row.later_second;
  }
}

}  // namespace tweenfall::blocks
