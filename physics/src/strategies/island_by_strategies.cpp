#include "strategies/island_by_strategies.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/strategies.h>

#include <algorithm>

#include "contacts/meeting.h"
#include "step/keyed_step.h"
#include "strategies/detection.h"
#include "strategies/solvers/solvers.h"
#include "strategies/touching.h"

namespace tweenfall::strategies {

using contacts::ContactConstraint;
using contacts::PointConstraint;
using state::Body;

namespace {

constexpr std::uint32_t no_party = 0xffffffffu;

}  // namespace

bool chosen(const WorldSettings& settings) {
  return settings.solver != ContactSolver::iterative || settings.separation != Parting::soft ||
         settings.collision != Detection::ahead;
}

std::uint32_t IslandByStrategies::party_of(const std::vector<Body>& bodies, std::uint32_t index, const Part& part) {
  if (places_[index] != no_party) return places_[index];
  const Body& body = bodies[index];
  Party party;
  party.index = index;
  party.movable = !body.immovable() && !body.asleep;
  if (party.movable) {
    party.inverse_mass = 1 / body.mass().mass;
    party.inverse_inertia = body.world_inverse_inertia(body.motion.pose.rotation);
    party.linear = body.twist.linear;
    party.angular = body.twist.angular;
  } else if (body.immovable() && part.left > 0) {
    const step::KeyedCourse course = step::keyed_course(body, part.left);
    const Twist led = part.h > 0 ? course.mean_between(0, part.h / part.left, part.left)
                                 : course.velocity(part.late ? 1 : 0, part.left);
    party.linear = led.linear;
    party.angular = led.angular;
  }
  places_[index] = static_cast<std::uint32_t>(island_.parties.size());
  island_.parties.push_back(party);
  return places_[index];
}

void IslandByStrategies::gather(const std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                                std::span<ContactConstraint* const> contacts, const WorldSettings& settings,
                                const Part& part) {
  island_.parties.clear();
  island_.touches.clear();
  island_.passes = settings.iterations;
  island_.complementarity = 0;
  places_.resize(bodies.size(), no_party);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    ContactConstraint& contact = *contacts[k];
    const std::uint32_t a = party_of(bodies, contact.a, part), b = party_of(bodies, contact.b, part);
    const contacts::Closing closing =
        contacts::closing_of(contact.manifold.normal, loads[contact.a], loads[contact.b], part.step);
    const bool blows = part.blows || detection_of(bodies[contact.a], bodies[contact.b], settings.collision) !=
                                         Detection::time_of_impact;
    for (int i = 0; i < contact.count; ++i) {
      PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
      Touch touch;
      touch.a = a;
      touch.b = b;
      touch.normal = contact.manifold.normal;
      touch.arm_a = point.start_arm_a;
      touch.arm_b = point.start_arm_b;
      touch.friction = contact.friction;
      touch.contact = static_cast<std::uint32_t>(k);
      touch.point = static_cast<std::uint32_t>(i);
      const double gap = point.start_gap > touching ? point.start_gap : 0;
      if (gap > 0 && part.h == 0) continue;
      if (gap > 0) touch.wanted = -gap / part.h;
      // Bodies that meet in a later part are handled there.
      const double span = blows ? part.h : (1 + 1e-6) * part.left;
      const double speed =
          contacts::meeting_of(gap, -island_.parting(touch), part.h > 0 ? closing.pull : 0, span).speed;
      if (speed > closing.tremble) {
        if (!blows && gap > 0) continue;
        point.approach = std::max(point.approach, speed);
        if (blows && contact.restitution > 0) touch.wanted = contact.restitution * speed;
      }
      if (contact.kept_step > 0 && part.h > 0) touch.kept = point.kept_normal * (part.h / contact.kept_step);
      island_.touches.push_back(touch);
    }
  }
}

double IslandByStrategies::respond(std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                                   std::span<ContactConstraint* const> contacts, const WorldSettings& settings,
                                   const Part& part, std::vector<char>& moved) {
  gather(bodies, loads, contacts, settings, part);
  for (Party& party : island_.parties) {
    if (!party.movable || part.h == 0) continue;
    const Body& body = bodies[party.index];
    const forces::Load& load = loads[party.index];
    party.linear = forces::accelerated(party.linear, load, settings.integrator, part.h);
    party.angular = forces::turned(body, {body.motion.pose.rotation, party.angular}, load, part.h).angular;
  }
  solver_of(settings.solver)(island_);
  for (const Touch& touch : island_.touches) {
    ContactConstraint& contact = *contacts[touch.contact];
    PointConstraint& point = contact.points[touch.point];
    point.total_normal += touch.impulse;
    point.total_friction += touch.rubbing;
  }
  if (part.h > 0) {
    for (ContactConstraint* contact : contacts) {
      static_cast<state::KeptImpulses&>(*contact) = {};
      contact->kept_step = part.h;
      for (PointConstraint& point : contact->points) {
        point.kept_normal = 0;
        point.kept_friction = Vec3::Zero();
      }
    }
    for (const Touch& touch : island_.touches) contacts[touch.contact]->points[touch.point].kept_normal = touch.impulse;
  }
  for (const Party& party : island_.parties) {
    places_[party.index] = no_party;
    if (!party.movable || !party.touched) continue;
    Body& body = bodies[party.index];
    body.twist = {party.linear, party.angular};
    body.center += part.h * party.linear;
    Quat rotation = exp_map(part.h * party.angular) * body.motion.pose.rotation;
    rotation.normalize();
    body.follow_center(rotation);
    if (part.h > 0) moved[party.index] = 1;
  }
  return island_.complementarity;
}

}  // namespace tweenfall::strategies
