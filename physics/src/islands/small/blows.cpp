#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "collision/surfaces/surface.h"
#include "contacts/combine.h"
#include "contacts/meeting.h"
#include "islands/small/part_of_step.h"
#include "state/world_data.h"
#include "step/solver.h"

/// Small islands in which a body that is struck strikes another: the step is cut where bodies meet, and there each blow
/// is between two bodies alone, the hardest first, as long as any two still close. So a row of touching balls
/// passes a blow on like one whose balls stand apart.

namespace tweenfall {

namespace small {
namespace {

using contacts::ContactConstraint;
using state::Body;

constexpr std::size_t most_contacts_of_blows = 24;
/// What meets within this part of a step meets now.
constexpr double soon = 1e-6;
/// In shorter steps than this, jitter is no faster than in a step of this length, s.
constexpr double unhurried = 1e-3;
/// Cuts of a step; what still meets after them is solved with the rest.
constexpr int most_cuts = 64;
/// Strikes without progress: a wedged body would bounce back and forth forever.
constexpr int most_strikes = 4;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr int usual_sub_steps = step::Solver::usual_sub_steps;

/// When the first of a contact's points meet within `left` seconds, faster than jitter.
double time_of_blow(const ContactConstraint& contact, const std::vector<Body>& bodies,
                    const std::vector<forces::Load>& loads, double left, double dt) {
  const Body &a = bodies[contact.a], &b = bodies[contact.b];
  const Vec3& normal = contact.manifold.normal;
  const contacts::Closing closing =
      contacts::closing_of(normal, loads[contact.a], loads[contact.b], std::max(dt, unhurried));
  double first = never;
  for (int i = 0; i < contact.count; ++i) {
    const contacts::PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec3 at_a = a.twist.linear + a.twist.angular.cross(point.start_arm_a);
    const Vec3 at_b = b.twist.linear + b.twist.angular.cross(point.start_arm_b);
    const auto [time, speed] = contacts::meeting_of(point.start_gap, normal.dot(at_a - at_b), closing.pull, left);
    if (speed > closing.tremble) first = std::min(first, time);
  }
  return first;
}

}  // namespace
}  // namespace small

bool World::Implementation::hands_on_blows(const islands::IslandContents& island, double dt) const {
  if (island.contacts.size() < 2 || island.contacts.size() > small::most_contacts_of_blows || !island.springs.empty() ||
      !island.joints.empty())
    return false;
  const bool bounces = std::any_of(island.contacts.begin(), island.contacts.end(), [&](const auto* contact) {
    return contact->restitution > contacts::dull &&
           small::time_of_blow(*contact, bodies, loads, (1 + small::soon) * dt, dt * part_count) < small::never;
  });
  if (!bounces) return false;
  for (const contacts::ContactConstraint* contact : island.contacts)
    for (const std::uint32_t index : {contact->a, contact->b}) {
      const state::Body& body = bodies[index];
      if (body.displaces() || body.conveys || body.drive.owner() == Owner::driven ||
          surfaces::surface_of(body.shape().solid))
        return false;
    }
  return true;
}

void World::Implementation::solve_by_blows(const islands::IslandContents& island, double dt, step::Solvers& by) {
  using contacts::ContactConstraint;
  small::PartsOfStep parts(island, bodies);
  const double soon = small::soon * dt;
  // Between blows nothing bounces: speeds below a blow would only jitter.
  const auto calmly = [&](std::span<ContactConstraint* const> blown, double h) {
    std::vector<double> restitutions;
    restitutions.reserve(blown.size());
    for (ContactConstraint* contact : blown) restitutions.push_back(std::exchange(contact->restitution, 0));
    begin_part(parts);
    const int sub_steps = std::max(1, static_cast<int>(std::ceil(small::usual_sub_steps * h / dt)));
    if (!blown.empty()) by.few.solve(bodies, loads, blown, {}, settings, h, moved, sub_steps);
    end_part(parts, blown, h);
    for (std::size_t i = 0; i < blown.size(); ++i) blown[i]->restitution = restitutions[i];
  };
  std::vector<ContactConstraint*> slow;
  double left = dt;
  int strikes = 0;  // since the last cut
  for (int cut = 0; cut < small::most_cuts && strikes < small::most_strikes; ++cut) {
    // What meets exactly at the end of the step still belongs to it.
    const double span = left + soon;
    double first = small::never;
    slow.clear();
    for (ContactConstraint* contact : find_again(island, parts, span)) {
      const double meeting = small::time_of_blow(*contact, bodies, loads, span, dt * part_count);
      if (meeting == small::never) slow.push_back(contact);
      first = std::min(first, meeting);
    }
    if (first == small::never) break;
    if (first <= soon) {
      for (const step::Blow& blow :
           by.few.strike(bodies, loads, parts.near, std::max(dt * part_count, small::unhurried)))
        parts.add(*blow.contact, blow.impulse, blow.normal, blow.approach);
      ++strikes;
      continue;
    }
    strikes = 0;
    const double h = std::min(first - 0.5 * soon, left);
    calmly(slow, h);
    left -= h;
  }
  if (left > soon)
    calmly(find_again(island, parts, left), left);
  else
    calmly({}, left);
  parts.finish(dt);
  for (const std::uint32_t index : parts.movable()) moved[index] = 1;
}

}  // namespace tweenfall
