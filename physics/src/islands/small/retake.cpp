#include "islands/small/retake.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "collision/collide_pairs.h"
#include "collision/surfaces/convex_piece.h"
#include "collision/surfaces/surface.h"
#include "queries/rays.h"
#include "state/world_data.h"
#include "step/solver.h"

/// The contacts of a step are found for bodies that fly freely until they meet. A blow turns a body otherwise: a corner
/// or a part of a rim may then go down where no contact was expected. It shows when the step is over. A small island in
/// which something has sunk takes the step again, in halves, each of which finds its contacts again, and each half that
/// still lets something sink is halved in turn.

namespace tweenfall {

namespace small {
namespace {

using contacts::ContactConstraint;
using state::Body;

/// Greatest number of contacts of an island that takes a step again.
constexpr std::size_t most_retaken = 32;
/// Something has sunk when it gets deeper into what stands still than this part of its radius, and at most so deep, m.
constexpr double sunk = 0.04, sunk_at_most = 8e-3;
/// In parts of a step, by half as much.
constexpr double in_parts = 0.5;
/// What lies deeper already may get deeper by this part of it.
constexpr double deeper = 0.02;
/// Cosine of the angle within which two contacts face the same way.
constexpr double one_way = 0.9;
/// How often a step is halved, and sub-steps of a whole one: a part that is short enough takes one.
constexpr int most_halvings = 6, sub_steps_of_whole = 4;

/// How deep a body may get into one that stands still, m.
double allowed(const Body& a, const Body& b) {
  return std::min(sunk_at_most, sunk * (a.immovable() ? b : a).radius());
}
/// The same if they lay in each other before the step.
double allowed(double depth, double before) {
  return std::max(depth, before + deeper * depth);
}

/// About how far a body's points have gone in a time where no contact was looked for, m: it turned, and its contacts
/// were found for the turns of free flight; or impulses turned its way.
double diverted(const Body& body, const Twist& before, double time) {
  if (body.immovable() || body.asleep) return 0;
  const double turned = body.round() ? 0 : std::max(body.twist.angular.norm(), before.angular.norm()) * body.radius();
  return (turned + (body.twist.linear - before.linear).norm()) * time;
}

Pose pose_at(const Body& body, const Vec3& center, const Quat& rotation) {
  Pose pose;
  pose.rotation = rotation;
  pose.position = center - rotation * body.mass().center;
  return pose;
}

/// A body's way through a time.
struct Way {
  Pose from, to;
};

std::span<const Shape> parts_of(const Body& body) {
  const auto* compound = std::get_if<Compound>(&body.shape().solid);
  return compound ? compound->parts() : std::span(&body.shape(), 1);
}

/// Whether the middle of a part of a body went into a part of one that stands still, or through it.
bool passes(const Shape& part, const Way& way, const Shape& wall, const Pose& at) {
  const Vec3 middle = surfaces::middle_of(part.solid);
  const auto middle_at = [&](const Pose& pose) -> Vec3 {
    const shapes::Placed placed = shapes::place(part, pose);
    return placed.center + placed.axes * middle;
  };
  const Vec3 from = middle_at(way.from), along = middle_at(way.to) - from;
  const double length = along.norm();
  if (!(length > 0)) return false;
  const std::optional<RayHit> hit = queries::first_on_ray(wall, at, {from, along / length, length});
  return hit && !hit->inside;
}

/// How deep they lie in each other at the end, m; infinity if the middle of one passed into or through one that stands.
double depth_of(const Body& a, const Way& way_a, const Body& b, const Way& way_b) {
  const auto around = [](const Shape& part, const Way& way) -> Bounds {
    const Bounds from = bounds(part, way.from), to = bounds(part, way.to);
    return {from.low.cwiseMin(to.low), from.high.cwiseMax(to.high)};
  };
  double deepest = 0;
  for (const Shape& part_a : parts_of(a)) {
    const Bounds box_a = around(part_a, way_a);
    for (const Shape& part_b : parts_of(b)) {
      const Bounds box_b = around(part_b, way_b);
      if ((box_a.low.array() > box_b.high.array()).any() || (box_b.low.array() > box_a.high.array()).any()) continue;
      if ((b.immovable() && passes(part_a, way_a, part_b, way_b.to)) ||
          (a.immovable() && passes(part_b, way_b, part_a, way_a.to)))
        return std::numeric_limits<double>::infinity();
      const Manifold manifold =
          collision::collide(part_a, shapes::place(part_a, way_a.to), part_b, shapes::place(part_b, way_b.to), 0, 0);
      for (int i = 0; i < manifold.count; ++i)
        deepest = std::max(deepest, manifold.points[static_cast<std::size_t>(i)].penetration);
    }
  }
  return deepest;
}

/// Whether a contact is in a corner of a compound: another one of the same bodies faces elsewhere. Parts of the step
/// would forget which of its edges the body passes over.
bool is_cornered(const ContactConstraint& contact, std::span<ContactConstraint* const> contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const ContactConstraint* other) {
    return other->a == contact.a && other->b == contact.b &&
           other->manifold.normal.dot(contact.manifold.normal) < one_way;
  });
}

bool goes_by_itself(const Body& body) {
  return body.displaces() || body.drive.owner() == Owner::driven;
}

}  // namespace

Retake::Retake(const islands::IslandContents& island, const std::vector<Body>& bodies)
    : contacts_(island.contacts), parts_(island, bodies) {
  for (ContactConstraint* contact : contacts_) {
    pairs_.emplace_back(contact->a, contact->b);
    // After parts of a step, 0 would mean that its manifold is from the start.
    impact_times_.push_back(std::max(contact->impact_time, std::numeric_limits<double>::min()));
    static_cast<state::KeptImpulses&>(*contact) = {};
    for (contacts::PointConstraint& point : contact->points) {
      point.kept_normal = 0;
      point.kept_friction = Vec3::Zero();
    }
  }
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

ContactConstraint& Retake::told(const ContactConstraint& contact) const {
  ContactConstraint* best = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  for (ContactConstraint* one : contacts_) {
    if (one->a != contact.a || one->b != contact.b) continue;
    const bool same = one->part_a == contact.part_a && one->part_b == contact.part_b;
    const double alike = one->manifold.normal.dot(contact.manifold.normal) + (same ? 1 : 0);
    if (!(alike > most)) continue;
    most = alike;
    best = one;
  }
  return *best;
}

void Retake::inherit() {
  for (ContactConstraint& contact : found.contacts.all())
    for (const ContactConstraint& before : known_) {
      if (before.a != contact.a || before.b != contact.b || before.part_a != contact.part_a ||
          before.part_b != contact.part_b)
        continue;
      static_cast<state::KeptImpulses&>(contact) = before;
      small::inherit(before, contact);
    }
}

void Retake::accept() {
  known_.assign(found.contacts.all().begin(), found.contacts.all().end());
  for (const ContactConstraint& contact : known_) {
    ContactConstraint& its = told(contact);
    parts_.add(its, contact);
    const contacts::ContactHead head = its;
    its = contact;
    static_cast<contacts::PairInContact&>(its) = head;
    its.began = head.began;
    its.within = head.within;
  }
}

void Retake::finish(double dt) {
  parts_.finish(dt);
  for (std::size_t i = 0; i < contacts_.size(); ++i) contacts_[i]->impact_time = impact_times_[i];
}

}  // namespace small

double World::Implementation::depth_at_start(const pairs::Pair& pair) const {
  const state::Body &a = bodies[pair.first], &b = bodies[pair.second];
  const step::Start &at_a = starts[pair.first], &at_b = starts[pair.second];
  const Pose from_a = small::pose_at(a, at_a.center, at_a.rotation),
             from_b = small::pose_at(b, at_b.center, at_b.rotation);
  return small::depth_of(a, {from_a, from_a}, b, {from_b, from_b});
}

bool World::Implementation::has_sunk(const islands::IslandContents& island, double dt) const {
  if (island.contacts.size() > small::most_retaken || !island.springs.empty() || !island.joints.empty()) return false;
  // What no impulse moved has yet to fly.
  const auto at_end = [&](std::uint32_t index) {
    state::Body body = bodies[index];
    if (!body.immovable() && !body.asleep && moved[index] == 0)
      forces::fly(body, loads[index], settings.integrator, dt);
    return body.motion.pose;
  };
  const auto start_of = [&](std::uint32_t index) {
    return small::pose_at(bodies[index], starts[index].center, starts[index].rotation);
  };
  bool any = false;
  for (const contacts::ContactConstraint* contact : island.contacts) {
    const state::Body &a = bodies[contact->a], &b = bodies[contact->b];
    if (small::goes_by_itself(a) || small::goes_by_itself(b)) return false;
    const bool compound =
        std::holds_alternative<Compound>(a.shape().solid) || std::holds_alternative<Compound>(b.shape().solid);
    if (compound && small::is_cornered(*contact, island.contacts)) return false;
    if (any) continue;
    if (!a.immovable() && !b.immovable()) continue;
    const double most = small::allowed(a, b);
    if (!(small::diverted(a, starts[contact->a].twist, dt) + small::diverted(b, starts[contact->b].twist, dt) > most))
      continue;
    const double depth =
        small::depth_of(a, {start_of(contact->a), at_end(contact->a)}, b, {start_of(contact->b), at_end(contact->b)});
    any = depth > most && depth > small::allowed(most, depth_at_start({contact->a, contact->b}));
  }
  return any;
}

bool World::Implementation::has_sunk(const small::Retake& retake, std::span<const small::Before> before,
                                     std::span<const std::uint32_t> movable, double h) const {
  const auto before_of = [&](std::uint32_t index) -> const small::Before* {
    const auto at = std::lower_bound(movable.begin(), movable.end(), index);
    return at == movable.end() || *at != index ? nullptr : &before[static_cast<std::size_t>(at - movable.begin())];
  };
  const auto diverted = [&](std::uint32_t index) {
    const small::Before* its = before_of(index);
    return its ? small::diverted(bodies[index], its->twist, h) : 0.0;
  };
  const auto way_of = [&](std::uint32_t index) -> small::Way {
    const small::Before* its = before_of(index);
    const Pose& now = bodies[index].motion.pose;
    return {its ? small::pose_at(bodies[index], its->center, its->rotation) : now, now};
  };
  for (const pairs::Pair& pair : retake.pairs()) {
    const state::Body &a = bodies[pair.first], &b = bodies[pair.second];
    if (!a.immovable() && !b.immovable()) continue;
    const double most = small::in_parts * small::allowed(a, b);
    if (!(diverted(pair.first) + diverted(pair.second) > most)) continue;
    const double depth = small::depth_of(a, way_of(pair.first), b, way_of(pair.second));
    if (depth > most && depth > small::allowed(most, depth_at_start(pair))) return true;
  }
  return false;
}

void World::Implementation::take_part_again(small::Retake& retake, double h, int halvings, step::Solver& solver) {
  const std::span<const std::uint32_t> movable = retake.parts().movable();
  std::vector<small::Before> before;
  for (const std::uint32_t index : movable) {
    const state::Body& body = bodies[index];
    before.push_back({body.center, body.motion.pose.rotation, body.twist});
    passages[index] = collision::passage_of(body, loads[index], h);
    moved[index] = 0;
  }
  retake.found.contacts.clear();
  for (const pairs::Pair& pair : retake.pairs()) find_pair_again(pair, h, retake.found);
  retake.inherit();
  std::vector<contacts::ContactConstraint*> near;
  for (contacts::ContactConstraint& contact : retake.found.contacts.all()) near.push_back(&contact);
  const int sub_steps = std::max(1, small::sub_steps_of_whole >> halvings);
  if (!near.empty()) solver.solve(bodies, loads, near, {}, settings, h, moved, sub_steps, true);
  for (const std::uint32_t index : movable)
    if (moved[index] == 0) forces::fly(bodies[index], loads[index], settings.integrator, h);
  if (halvings == small::most_halvings || !has_sunk(retake, before, movable, h)) {
    retake.accept();
    return;
  }
  for (std::size_t i = 0; i < movable.size(); ++i) {
    state::Body& body = bodies[movable[i]];
    body.center = before[i].center;
    body.twist = before[i].twist;
    body.follow_center(before[i].rotation);
  }
  for (int half = 0; half < 2; ++half) take_part_again(retake, 0.5 * h, halvings + 1, solver);
}

void World::Implementation::take_again(const islands::IslandContents& island, double dt, step::Solver& solver) {
  small::Retake retake(island, bodies);
  const std::span<const std::uint32_t> movable = retake.parts().movable();
  std::vector<collision::Passage> ways;
  for (const std::uint32_t index : movable) {
    state::Body& body = bodies[index];
    const step::Start& start = starts[index];
    body.center = start.center;
    body.twist = start.twist;
    body.follow_center(start.rotation);
    ways.push_back(passages[index]);
  }
  for (int half = 0; half < 2; ++half) take_part_again(retake, 0.5 * dt, 1, solver);
  retake.finish(dt);
  for (std::size_t i = 0; i < movable.size(); ++i) {
    passages[movable[i]] = ways[i];
    moved[movable[i]] = 1;
  }
}

void World::Implementation::take_again_where_sunk(const std::vector<islands::IslandContents>& all, std::size_t shares,
                                                  double dt) {
  std::vector<std::uint32_t> deep;  // hardly ever any
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (!goes_by_strategies(all[i]) && has_sunk(all[i], dt)) deep.push_back(i);
  if (deep.empty()) return;
  std::atomic<std::size_t> next{0};
  workers().parts(std::min(shares, deep.size()), [&](std::size_t share) {
    for (std::size_t i = next.fetch_add(1); i < deep.size(); i = next.fetch_add(1))
      take_again(all[deep[i]], dt, solvers[share].few);
  });
}

}  // namespace tweenfall
