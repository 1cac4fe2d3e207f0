#include "islands/blocks/block_solver.h"

#include <algorithm>

#include "contacts/meeting.h"
#include "state/prefetch.h"

/// Gathers what the rows need of bodies and contacts, before the sub-steps.

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using forces::Load;
using state::Body;

/// Gives all bodies of islands their places.
void BlockSolver::number(std::span<const islands::IslandContents> islands) {
  for (const std::uint32_t index : indices_)
    if (index < places_.size()) places_[index] = 0;
  indices_.assign(1, 0xffffffffu);
  island_of_.assign(1, 0);
  std::uint32_t number = 0;
  const auto add = [&](std::uint32_t index) {
    if (places_[index] != 0) return;
    places_[index] = static_cast<std::uint32_t>(indices_.size());
    indices_.push_back(index);
    island_of_.push_back(number);
  };
  for (const islands::IslandContents& island : islands) {
    for (const ContactConstraint* contact : island.contacts) {
      add(contact->a);
      add(contact->b);
    }
    for (const joints::JointLink* link : island.joints)
      for (const std::uint32_t end : {link->a, link->b})
        if (end != joints::JointLink::world) add(end);
    for (const step::SpringRow* spring : island.springs)
      for (const std::uint32_t end : {spring->a, spring->b})
        if (end != step::SpringRow::world) add(end);
    ++number;
  }
}

void BlockSolver::take(std::size_t place, const Body& body, const Load& load, Integrator integrator) {
  IslandBody& entry = bodies_[place] = {};
  BodyPace& pace = paces_[place] = {};
  BodyLanes& velocity = velocities_[place] = {};
  displacements_[place] = {};
  turns_[place] = {};
  lags_[place] = {};
  Traits& traits = traits_[place] = {};
  entry.index = indices_[place];
  entry.round = body.round();
  entry.movable = pace.movable = !body.immovable() && !body.asleep;
  entry.conveys = body.conveys;
  if (body.conveys) {
    entry.surface = body.surface();
    traits.conveys = true;
  }
  entry.center = body.center;
  entry.rotation = entry.start_rotation = body.motion.pose.rotation;
  traits.immovable = body.immovable();
  if (!entry.movable) return;
  entry.inverse_mass = 1 / body.mass().mass;
  entry.drag = load.drag;
  entry.isotropic = body.spherical();
  entry.inverse_moment = body.spherical() ? body.inverse_inertia()(0, 0) : 0;
  entry.inverse_inertia =
      body.spherical() ? body.inverse_inertia() : body.world_inverse_inertia(body.motion.pose.rotation);
  pace.mass = body.mass().mass;
  pace.moment = body.mass().inertia(0, 0);
  set(pace.acceleration, integrator == Integrator::exact_quadratic
                             ? Vec3(0.5 * (load.acceleration + load.end_acceleration))
                             : load.acceleration);
  pace.even = body.spherical() && load.torque == Vec3::Zero() && !(load.angular_drag > 0 || load.angular_damping > 0);
  pace.slender = body.slender();
  pace.steady = pace.even && !(load.drag > 0);
  pace.unturned = pace.steady && entry.round;
  traits.uneven = !body.spherical();
  traits.driven = body.drive.owner() == Owner::driven;
  set(velocity.linear, without_sign_of_zero(body.twist.linear));
  set(velocity.angular, without_sign_of_zero(body.twist.angular));
}

void BlockSolver::gather(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                         std::span<const islands::IslandContents> islands, Integrator integrator, double dt) {
  number(islands);
  const std::size_t count = indices_.size();
  bodies_.resize(count);
  paces_.resize(count);
  turns_.resize(count);
  velocities_.resize(count);
  displacements_.resize(count);
  lags_.resize(count);
  starts_.resize(count);
  begun_.resize(count);
  ended_.resize(count);
  sub_starts_.resize(count);
  traits_.resize(count);
  bodies_[0] = {};
  bodies_[0].index = indices_[0];
  paces_[0] = {};
  velocities_[0] = displacements_[0] = {};
  turns_[0] = {};
  lags_[0] = {};
  each_body([&](std::size_t i) {
    constexpr std::size_t ahead = 4;
    if (i + ahead < count) {
      state::fetch(&bodies[indices_[i + ahead]]);
      state::fetch(&loads[indices_[i + ahead]]);
    }
    take(i, bodies[indices_[i]], loads[indices_[i]], integrator);
  });
  uneven_.clear();
  rebounds_.clear();  // of the island before
  led_.clear();
  bouncy_ = meets_ = rolls_ = conveyed_ = any_stale_ = driven_ = rebounded_ = false;
  for (std::uint32_t i = 1; i < count; ++i) {
    conveyed_ = conveyed_ || traits_[i].conveys;
    driven_ = driven_ || traits_[i].driven;
    if (traits_[i].uneven) uneven_.push_back(i);
    if (!traits_[i].immovable) continue;
    const step::KeyedCourse course = step::keyed_course(bodies[indices_[i]], dt);
    if (course.still()) continue;
    bodies_[i].led = static_cast<std::uint32_t>(led_.size());
    const Twist start = course.velocity(0, dt);
    led_.push_back({i, course, start, start});
    set(velocities_[i].linear, start.linear);
    set(velocities_[i].angular, start.angular);
  }
  for (const islands::IslandContents& island : islands)
    for (const joints::JointLink* link : island.joints)
      for (const std::uint32_t end : {link->a, link->b})
        if (end != joints::JointLink::world) bodies_[places_[end]].jointed = true;
}

/// @param trembling  a heap passes weight on to all sides: the speed that gravity gives in this time counts as jitter
/// in any direction, s
void BlockSolver::foresee(std::span<ContactConstraint* const> contacts, const std::vector<Load>& loads,
                          double trembling, double dt) {
  closings_.resize(contacts.size());
  marks_.resize(contacts.size());
  work_.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      constexpr std::size_t ahead = 4;
      if (i + ahead < end) contacts::fetch(*contacts[i + ahead]);
      ContactConstraint& contact = *contacts[i];
      const std::uint32_t a = places_[contact.a], b = places_[contact.b];
      closings_[i] = contacts::closing_of(contact.manifold.normal, loads[contact.a], loads[contact.b], dt * parts_);
      if (trembling > 0)
        closings_[i].tremble =
            std::max(closings_[i].tremble,
                     trembling * std::max(loads[contact.a].acceleration.norm(), loads[contact.b].acceleration.norm()));
      contacts::foresee(contact, {linear_of(velocities_[a]), angular_of(velocities_[a])},
                        {linear_of(velocities_[b]), angular_of(velocities_[b])}, closings_[i], dt);
      marks_[i] = {contact.impact, contact.restitution > 0,
                   contact.rolling_friction > 0 || contact.spinning_friction > 0, false};
    }
  });
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    bouncy_ = bouncy_ || marks_[i].springs_back;
    rolls_ = rolls_ || marks_[i].rolls;
    meets_ = meets_ || marks_[i].impact;
    if (marks_[i].impact) paces_[places_[contacts[i]->a]].impact = paces_[places_[contacts[i]->b]].impact = true;
  }
}

}  // namespace tweenfall::blocks
