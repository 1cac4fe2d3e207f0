#include "islands/small/part_of_step.h"

#include <algorithm>

#include "state/world_data.h"
#include "step/solver.h"

namespace tweenfall {

namespace small {

using contacts::ContactConstraint;
using contacts::PointConstraint;

ContactConstraint looked_for_again(const ContactConstraint& before) {
  ContactConstraint next = before;
  next.count = 0;
  next.manifold.count = 0;
  next.impact_time = 0;
  next.kept = false;
  for (PointConstraint& point : next.points) point = {};
  return next;
}

void inherit(const ContactConstraint& before, ContactConstraint& next) {
  for (int i = 0; i < next.count; ++i)
    for (int k = 0; k < before.count; ++k) {
      PointConstraint& to = next.points[static_cast<std::size_t>(i)];
      const PointConstraint& from = before.points[static_cast<std::size_t>(k)];
      if (to.feature != from.feature) continue;
      to.kept_normal = from.kept_normal;
      to.kept_friction = from.kept_friction;
    }
}

collision::Passage way_of(const state::Body& body, std::uint32_t part, const forces::Load& load, double dt) {
  const collision::Passage whole = collision::passage_of(body, load, dt);
  const auto* compound = std::get_if<Compound>(&body.shape().solid);
  return compound ? collision::passage_of_part(whole, compound->parts()[part]) : whole;
}

PartsOfStep::PartsOfStep(const islands::IslandContents& island, const std::vector<state::Body>& bodies)
    : contacts_(island.contacts), sums_(island.contacts.size()) {
  for (const ContactConstraint* contact : contacts_)
    for (const std::uint32_t index : {contact->a, contact->b})
      if (!bodies[index].immovable() && !bodies[index].asleep) movable_.push_back(index);
  std::sort(movable_.begin(), movable_.end());
  movable_.erase(std::unique(movable_.begin(), movable_.end()), movable_.end());
}

PartsOfStep::Sum& PartsOfStep::sum_of(const ContactConstraint& contact) {
  return sums_[static_cast<std::size_t>(std::find(contacts_.begin(), contacts_.end(), &contact) - contacts_.begin())];
}

void PartsOfStep::add(const ContactConstraint& told, const ContactConstraint& contact) {
  Sum& sum = sum_of(told);
  for (int i = 0; i < contact.count; ++i) {
    const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    sum.normal += point.total_normal;
    sum.impulse += point.total_normal * contact.manifold.normal + point.total_friction;
    sum.approach = std::max(sum.approach, point.approach);
    sum.overlap = sum.overlap || point.start_gap <= 0;
  }
  sum.rolling += contact.total_rolling;
}

void PartsOfStep::add(const ContactConstraint& contact, const Vec3& impulse, double normal, double approach) {
  Sum& sum = sum_of(contact);
  sum.normal += normal;
  sum.impulse += impulse;
  sum.approach = std::max(sum.approach, approach);
}

void PartsOfStep::finish(double dt) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    ContactConstraint& contact = *contacts_[i];
    const Sum& sum = sums_[i];
    for (PointConstraint& point : contact.points) {
      point.total_normal = point.approach = 0;
      point.total_friction = Vec3::Zero();
      point.start_gap = sum.overlap ? std::min(point.start_gap, 0.0) : std::max(point.start_gap, 1e-300);
    }
    PointConstraint& first = contact.points[0];
    first.total_normal = sum.normal;
    first.total_friction = sum.impulse - sum.normal * contact.manifold.normal;
    first.approach = sum.approach;
    contact.total_rolling = sum.rolling;
    // Its manifold is not from the start of the step.
    contact.kept = false;
    contact.impact_time = dt;
  }
}

}  // namespace small

std::span<contacts::ContactConstraint* const> World::Implementation::find_again(const islands::IslandContents& island,
                                                                                small::PartsOfStep& parts,
                                                                                double h) const {
  parts.near.clear();
  for (contacts::ContactConstraint* contact : island.contacts) {
    const state::Body &a = bodies[contact->a], &b = bodies[contact->b];
    contacts::ContactConstraint next = small::looked_for_again(*contact);
    if (!find_manifold(next, a, b, small::way_of(a, contact->part_a, loads[contact->a], h),
                       small::way_of(b, contact->part_b, loads[contact->b], h), h, nullptr))
      continue;
    small::inherit(*contact, next);
    *contact = next;
    parts.near.push_back(contact);
  }
  return parts.near;
}

void World::Implementation::begin_part(const small::PartsOfStep& parts) {
  for (const std::uint32_t index : parts.movable()) moved[index] = 0;
}

void World::Implementation::end_part(small::PartsOfStep& parts, std::span<contacts::ContactConstraint* const> near,
                                     double h) {
  for (const contacts::ContactConstraint* contact : near) parts.add(*contact);
  for (const std::uint32_t index : parts.movable())
    if (moved[index] == 0) forces::fly(bodies[index], loads[index], settings.integrator, h);
}

}  // namespace tweenfall
