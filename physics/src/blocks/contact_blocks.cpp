#include "blocks/contact_blocks.h"

#include <algorithm>
#include <cmath>

#include "step/contact_rows.h"

namespace tweenfall::blocks {

using step::ContactConstraint;
using step::PointConstraint;

namespace {

void put(Lanes3& lanes, int lane, const Vec3& value) {
  lanes.x[lane] = value.x();
  lanes.y[lane] = value.y();
  lanes.z[lane] = value.z();
}

void put(LanesSymmetric& lanes, int lane, const Mat3& value) {
  lanes.xx[lane] = value(0, 0);
  lanes.yy[lane] = value(1, 1);
  lanes.zz[lane] = value(2, 2);
  lanes.xy[lane] = value(0, 1);
  lanes.xz[lane] = value(0, 2);
  lanes.yz[lane] = value(1, 2);
}

Vec3 vector_from(const double (&values)[4]) {
  return {values[0], values[1], values[2]};
}

enum class Grip { none, central, points };

/// A contact that slides is held point by point, for only so does the spin of what slides die with its slide.
Grip grip_of(const ContactConstraint& contact) {
  if (!(contact.friction > 0)) return Grip::none;
  return contact.count > 1 && !contact.slid && !contact.began ? Grip::central : Grip::points;
}

constexpr std::uint32_t kinds = 12;  // up to four points, three grips
std::uint32_t kind_of(const ContactConstraint& contact) {
  return 3 * static_cast<std::uint32_t>(contact.count - 1) + static_cast<std::uint32_t>(grip_of(contact));
}

/// One row of friction at an arm from each body.
void prepare_friction(FrictionRow& row, int lane, const step::Tangents& along, const IslandBody& a, const IslandBody& b,
                      const Vec3& arm_a, const Vec3& arm_b) {
  const Vec3 a1 = arm_a.cross(along.first), a2 = arm_a.cross(along.second);
  const Vec3 b1 = arm_b.cross(along.first), b2 = arm_b.cross(along.second);
  put(row.first_a, lane, a1);
  put(row.second_a, lane, a2);
  put(row.first_b, lane, b1);
  put(row.second_b, lane, b2);
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  const Vec3 ia1 = a.inverse_inertia * a1, ib1 = b.inverse_inertia * b1;
  const double k11 = inverse_mass + a1.dot(ia1) + b1.dot(ib1);
  const double k22 = inverse_mass + a2.dot(a.inverse_inertia * a2) + b2.dot(b.inverse_inertia * b2);
  const double k12 = a2.dot(ia1) + b2.dot(ib1);
  const double determinant = k11 * k22 - k12 * k12;
  const bool solvable = determinant > 0;
  row.inverse11[lane] = solvable ? k22 / determinant : 0;
  row.inverse12[lane] = solvable ? -k12 / determinant : 0;
  row.inverse22[lane] = solvable ? k11 / determinant : 0;
  row.firm[lane] = solvable ? 1 / (0.5 * (k11 + k22) + std::sqrt(0.25 * (k11 - k22) * (k11 - k22) + k12 * k12)) : 0;
}

}  // namespace

void ContactBlocks::build(std::span<ContactConstraint* const> contacts, const std::vector<std::uint32_t>& places,
                          const std::vector<IslandBody>& bodies, const std::vector<forces::Load>& loads, double h,
                          double dt) {
  coloring_.reset(bodies.size());
  keys_.clear();
  counts_.assign((Coloring::none + 1) * kinds + 1, 0);
  for (const ContactConstraint* contact : contacts) {
    const std::uint32_t a = places[contact->a];
    const std::uint32_t b = places[contact->b];
    const std::uint32_t color = coloring_.color(a, bodies[a].movable, b, bodies[b].movable);
    const std::uint32_t key = color * kinds + kind_of(*contact);
    keys_.push_back(key);
    ++counts_[key + 1];
  }
  for (std::size_t i = 1; i < counts_.size(); ++i) counts_[i] += counts_[i - 1];
  sorted_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) sorted_[counts_[keys_[i]]++] = contacts[i];

  // Each count is now where its key ends.
  blocks.clear();
  points.clear();
  frictions.clear();
  std::size_t next = 0;
  for (std::uint32_t key = 0; key + 1 < counts_.size(); ++key) {
    const std::size_t width = key >= Coloring::none * kinds ? 1 : lane_count;
    while (next < counts_[key]) {
      ContactBlock& block = blocks.emplace_back();
      block.points = static_cast<std::int32_t>(key % kinds / 3) + 1;
      const auto grip = static_cast<Grip>(key % 3);
      block.frictions = grip == Grip::none ? 0 : grip == Grip::central ? 1 : block.points;
      block.point = static_cast<std::uint32_t>(points.size());
      block.friction = static_cast<std::uint32_t>(frictions.size());
      points.resize(points.size() + static_cast<std::size_t>(block.points));
      frictions.resize(frictions.size() + static_cast<std::size_t>(block.frictions));
      const std::size_t end = std::min<std::size_t>(counts_[key], next + width);
      for (int lane = 0; next < end; ++next, ++lane) {
        ContactConstraint& contact = *sorted_[next];
        fill(block, lane, contact, places, bodies,
             step::closing_of(contact.manifold.normal, loads[contact.a], loads[contact.b], dt), h);
      }
    }
  }
}

void ContactBlocks::fill(ContactBlock& block, int lane, ContactConstraint& contact,
                         const std::vector<std::uint32_t>& places, const std::vector<IslandBody>& bodies,
                         const step::Closing& closing, double h) {
  block.a[lane] = places[contact.a];
  block.b[lane] = places[contact.b];
  block.contacts[lane] = &contact;
  const Vec3& normal = contact.manifold.normal;
  const step::Tangents along = step::tangents_of(normal);
  put(block.normal, lane, normal);
  put(block.tangent1, lane, along.first);
  put(block.tangent2, lane, along.second);
  block.inverse_mass_a[lane] = bodies[block.a[lane]].inverse_mass;
  block.inverse_mass_b[lane] = bodies[block.b[lane]].inverse_mass;
  block.coefficient[lane] = contact.friction;
  block.restitution[lane] = contact.restitution;
  block.pull[lane] = closing.pull;
  block.tremble[lane] = closing.tremble;
  block.hard[lane] = contact.impact || bodies[block.a[lane]].pulled || bodies[block.b[lane]].pulled ? -1 : 0;
  const double ratio = contact.kept_step > h ? h / contact.kept_step : 1;
  block.twist[lane] = block.central() ? ratio * contact.kept_twist : 0;
  Vec3 friction = Vec3::Zero();
  for (int i = 0; i < contact.count; ++i) {
    const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    PointRow& row = points[block.point + static_cast<std::uint32_t>(i)];
    row.base[lane] = point.start_gap;
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
  prepare(block, lane, bodies, nullptr);
}

void ContactBlocks::prepare(ContactBlock& block, int lane, const std::vector<IslandBody>& bodies,
                            const BodyLanes* displacements) {
  const ContactConstraint& contact = *block.contacts[lane];
  const IslandBody& a = bodies[block.a[lane]];
  const IslandBody& b = bodies[block.b[lane]];
  const Vec3& normal = contact.manifold.normal;
  put(block.inverse_inertia_a, lane, a.inverse_inertia);
  put(block.inverse_inertia_b, lane, b.inverse_inertia);
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  const Vec3 drift = (b.center - b.start_center) - (a.center - a.start_center);
  const Quat turn_a = a.rotation * a.start_rotation.conjugate();
  const Quat turn_b = b.rotation * b.start_rotation.conjugate();
  Vec3 middle_a = Vec3::Zero(), middle_b = Vec3::Zero();
  std::array<Vec3, 4> arms;
  const step::Tangents along = step::tangents_of(normal);
  for (int i = 0; i < contact.count; ++i) {
    const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    PointRow& row = points[block.point + static_cast<std::uint32_t>(i)];
    Vec3 arm_a = point.start_arm_a, arm_b = point.start_arm_b;
    double gap = point.start_gap;
    if (displacements) {
      arm_a = state::carried(turn_a, arm_a, a.roundness * normal);
      arm_b = state::carried(turn_b, arm_b, -b.roundness * normal);
      gap += normal.dot(drift + (arm_b - point.start_arm_b) - (arm_a - point.start_arm_a));
    }
    const Vec3 across_a = arm_a.cross(normal), across_b = arm_b.cross(normal);
    put(row.turn_a, lane, across_a);
    put(row.turn_b, lane, across_b);
    const double inverse =
        inverse_mass + across_a.dot(a.inverse_inertia * across_a) + across_b.dot(b.inverse_inertia * across_b);
    row.mass[lane] = inverse > 0 ? 1 / inverse : 0;
    if (displacements) {
      // The rows add the whole displacement of the step to it.
      const BodyLanes& moved_a = displacements[block.a[lane]];
      const BodyLanes& moved_b = displacements[block.b[lane]];
      row.base[lane] = gap - (normal.dot(vector_from(moved_b.linear) - vector_from(moved_a.linear)) +
                              across_b.dot(vector_from(moved_b.angular)) - across_a.dot(vector_from(moved_a.angular)));
    }
    if (block.frictions == block.points)
      prepare_friction(frictions[block.friction + static_cast<std::uint32_t>(i)], lane, along, a, b, arm_a, arm_b);
    arms[static_cast<std::size_t>(i)] = arm_b;
    middle_a += arm_a / contact.count;
    middle_b += arm_b / contact.count;
  }
  if (!block.central()) return;
  for (int i = 0; i < contact.count; ++i)
    points[block.point + static_cast<std::uint32_t>(i)].lever[lane] =
        (arms[static_cast<std::size_t>(i)] - middle_b).norm();
  prepare_friction(frictions[block.friction], lane, along, a, b, middle_a, middle_b);
  const double inverse = normal.dot((a.inverse_inertia + b.inverse_inertia) * normal);
  block.twist_mass[lane] = inverse > 0 ? 1 / inverse : 0;
}

void ContactBlocks::store(double h) {
  /// Parts of the grip from which a contact counts as sliding.
  constexpr double sliding = 0.999;
  for (const ContactBlock& block : blocks)
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!block.contacts[lane]) continue;
      ContactConstraint& contact = *block.contacts[lane];
      const step::Tangents along = step::tangents_of(contact.manifold.normal);
      contact.kept_step = h;
      contact.passed_over = 0;
      contact.kept_twist = block.twist[lane];
      contact.slid = false;
      double pressing = 0, twisting = 0;
      for (int i = 0; i < contact.count; ++i) {
        PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
        const PointRow& row = points[block.point + static_cast<std::uint32_t>(i)];
        point.kept_normal = row.impulse[lane];
        point.total_normal = row.total[lane];
        point.kept_friction = point.total_friction = Vec3::Zero();
        pressing += point.kept_normal;
        twisting += point.kept_normal * row.lever[lane];
        if (block.frictions == 0) continue;
        // Friction at the middle is shared out evenly.
        const double share = block.central() ? 1.0 / contact.count : 1;
        const FrictionRow& grip = frictions[block.friction + (block.central() ? 0u : static_cast<std::uint32_t>(i))];
        point.kept_friction = share * (grip.first[lane] * along.first + grip.second[lane] * along.second);
        point.total_friction = share * (grip.total_first[lane] * along.first + grip.total_second[lane] * along.second);
        const double most = sliding * contact.friction * point.kept_normal;
        if (!block.central() && point.kept_normal > 0 && point.kept_friction.squaredNorm() >= most * most)
          contact.slid = true;
      }
      if (!block.central() || !(pressing > 0)) continue;
      const FrictionRow& grip = frictions[block.friction];
      const double most = sliding * contact.friction * pressing;
      const double turning = sliding * contact.friction * twisting;
      contact.slid = grip.first[lane] * grip.first[lane] + grip.second[lane] * grip.second[lane] >= most * most ||
                     (turning > 0 && std::abs(contact.kept_twist) >= turning);
    }
}

}  // namespace tweenfall::blocks
