#include <algorithm>
#include <cmath>

#include "state/world_data.h"
#include "step/solver.h"
#include "surfaces/surface.h"

/// Small islands in which something turns so fast, or is about to, that contacts found once for a step say nothing
/// about its end: they go through it in pieces, and every piece looks for its contacts anew.

namespace tweenfall {

namespace small {
namespace {

using contacts::ContactConstraint;
using state::Body;

/// Contacts of an island that is taken to pieces, at most.
constexpr std::size_t most_contacts = 32;
/// What may turn in a step by more than this is taken to pieces in which it turns by less, rad.
constexpr double much = 1.5;
constexpr double little = 0.15;
constexpr int most_pieces = 600;
constexpr int least_sub_steps = 8;

bool round(const Body& body) {
  return std::holds_alternative<Sphere>(body.shape.solid);
}

/// By how much the bodies of a contact may turn in a step, against each other and by the blow that they give each
/// other, rad.
double turn_of(const ContactConstraint& contact, const std::vector<Body>& bodies, double dt) {
  const Body &a = bodies[contact.a], &b = bodies[contact.b];
  if (round(a) && round(b)) return 0;
  double size = std::numeric_limits<double>::infinity(), turn = 0;
  for (const Body* body : {&a, &b}) {
    if (body->immovable() || round(*body)) continue;
    size = std::min(size, body->radius);
    turn += body->twist.angular.norm();
  }
  if (std::isinf(size)) return 0;
  const Vec3& normal = contact.manifold.normal;
  const double closing = std::max(0.0, normal.dot(a.twist.linear - b.twist.linear));
  return (turn + closing / size) * dt;
}

/// What came of a contact in the pieces so far.
struct Sum {
  Vec3 impulse{0, 0, 0}, rolling{0, 0, 0};
  double normal = 0, approach = 0;
  bool overlap = false;
};

void add(const ContactConstraint& contact, Sum& sum) {
  for (int i = 0; i < contact.count; ++i) {
    const contacts::PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    sum.normal += point.total_normal;
    sum.impulse += point.total_normal * contact.manifold.normal + point.total_friction;
    sum.approach = std::max(sum.approach, point.approach);
    sum.overlap = sum.overlap || point.start_gap <= 0;
  }
  sum.rolling += contact.total_rolling;
}

/// A contact that has none of its points yet.
ContactConstraint looked_for_again(const ContactConstraint& before) {
  ContactConstraint next = before;
  next.count = 0;
  next.manifold.count = 0;
  next.impact_time = 0;
  next.kept = false;
  for (contacts::PointConstraint& point : next.points) point = {};
  return next;
}

void inherit(const ContactConstraint& before, ContactConstraint& next) {
  for (int i = 0; i < next.count; ++i)
    for (int k = 0; k < before.count; ++k) {
      contacts::PointConstraint& to = next.points[static_cast<std::size_t>(i)];
      const contacts::PointConstraint& from = before.points[static_cast<std::size_t>(k)];
      if (to.feature != from.feature) continue;
      to.kept_normal = from.kept_normal;
      to.kept_friction = from.kept_friction;
    }
}

collision::Passage way_of(const Body& body, std::uint32_t part, const forces::Load& load, double dt) {
  const collision::Passage whole = collision::passage_of(body, load, dt);
  const auto* compound = std::get_if<Compound>(&body.shape.solid);
  return compound ? collision::passage_of_part(whole, compound->parts()[part]) : whole;
}

}  // namespace
}  // namespace small

int World::Implementation::pieces_of(const islands::IslandContents& island, double dt) const {
  if (island.contacts.size() > small::most_contacts || !island.springs.empty() || !island.joints.empty()) return 1;
  double turn = 0;
  for (const contacts::ContactConstraint* contact : island.contacts) {
    turn = std::max(turn, small::turn_of(*contact, bodies, dt));
    for (const std::uint32_t index : {contact->a, contact->b})
      if (bodies[index].displaces() || bodies[index].drive.owner() == Owner::driven ||
          surfaces::surface_of(bodies[index].shape.solid))
        return 1;
  }
  if (!(turn > small::much)) return 1;
  return static_cast<int>(std::min<double>(std::ceil(turn / small::little), small::most_pieces));
}

void World::Implementation::solve_in_pieces(const islands::IslandContents& island, int pieces, double dt,
                                            step::Solver& solver) {
  using contacts::ContactConstraint;
  const double h = dt / pieces;
  const int sub_steps = std::max(1, (small::least_sub_steps + pieces - 1) / pieces);
  std::vector<std::uint32_t> movable;
  for (const ContactConstraint* contact : island.contacts)
    for (const std::uint32_t index : {contact->a, contact->b})
      if (!bodies[index].immovable() && !bodies[index].asleep) movable.push_back(index);
  std::sort(movable.begin(), movable.end());
  movable.erase(std::unique(movable.begin(), movable.end()), movable.end());
  std::vector<small::Sum> sums(island.contacts.size());
  std::vector<ContactConstraint*> near;
  for (int piece = 0; piece < pieces; ++piece) {
    near.clear();
    for (ContactConstraint* contact : island.contacts) {
      const state::Body &a = bodies[contact->a], &b = bodies[contact->b];
      ContactConstraint next = small::looked_for_again(*contact);
      if (!find_manifold(next, a, b, small::way_of(a, contact->part_a, loads[contact->a], h),
                         small::way_of(b, contact->part_b, loads[contact->b], h), h, nullptr))
        continue;
      small::inherit(*contact, next);
      *contact = next;
      near.push_back(contact);
    }
    for (const std::uint32_t index : movable) moved[index] = 0;
    if (!near.empty()) solver.solve(bodies, loads, near, {}, settings, h, moved, sub_steps);
    for (std::size_t i = 0, next = 0; i < sums.size() && next < near.size(); ++i)
      if (island.contacts[i] == near[next]) {
        small::add(*near[next], sums[i]);
        ++next;
      }
    for (const std::uint32_t index : movable)
      if (moved[index] == 0) forces::fly(bodies[index], loads[index], settings.integrator, h);
  }
  for (const std::uint32_t index : movable) moved[index] = 1;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    ContactConstraint& contact = *island.contacts[i];
    for (contacts::PointConstraint& point : contact.points) {
      point.total_normal = point.approach = 0;
      point.total_friction = Vec3::Zero();
      point.start_gap = sums[i].overlap ? std::min(point.start_gap, 0.0) : std::max(point.start_gap, 1e-300);
    }
    contacts::PointConstraint& first = contact.points[0];
    first.total_normal = sums[i].normal;
    first.total_friction = sums[i].impulse - sums[i].normal * contact.manifold.normal;
    first.approach = sums[i].approach;
    contact.total_rolling = sums[i].rolling;
    // Its manifold is not of the start of the step.
    contact.kept = false;
    contact.impact_time = dt;
  }
}

}  // namespace tweenfall
