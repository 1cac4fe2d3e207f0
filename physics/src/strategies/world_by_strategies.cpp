#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/strategies.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "collision/surfaces/surface.h"
#include "contacts/meeting.h"
#include "forces/drive_law.h"
#include "state/checks.h"
#include "state/world_data.h"
#include "step/keyed_step.h"
#include "strategies/arrived.h"
#include "strategies/detection.h"
#include "strategies/separations/separations.h"
#include "strategies/touching.h"

/// How a world's bodies go through a step if it asks for other strategies than the defaults.

namespace tweenfall {

namespace strategies {
namespace {

using contacts::ContactConstraint;
using contacts::PointConstraint;
using state::Body;

/// Overlap that counts as none, m.
constexpr double no_depth = 1e-10;
/// A time in which nothing moves by more than that, s.
constexpr double instant = 1e-12;
/// Instants of a step at which bodies meet; what still meets after them is solved with the rest.
constexpr int most_instants = 4096;
/// Blows at one instant: a wedged body would bounce back and forth forever.
constexpr int most_blows_at_once = 8;
/// What meets within this part of a step meets now.
constexpr double meets_now = 1e-7;
constexpr double never_met = std::numeric_limits<double>::infinity();

void forget_totals(ContactConstraint& contact) {
  contact.total_rolling = Vec3::Zero();
  for (PointConstraint& point : contact.points) {
    point.total_normal = point.approach = 0;
    point.total_friction = Vec3::Zero();
  }
}

Place place_of(const Body& body) {
  Place place;
  place.movable = !body.immovable() && !body.asleep;
  place.center = body.center;
  place.rotation = body.motion.pose.rotation;
  if (!place.movable) return place;
  place.inverse_mass = 1 / body.mass().mass;
  place.inverse_inertia = body.world_inverse_inertia(place.rotation);
  return place;
}

/// When the first of a contact's points meet, faster than jitter.
double time_of_blow(const ContactConstraint& contact, const std::vector<Body>& bodies,
                    const std::vector<forces::Load>& loads, double left, double step) {
  if (contact.impact_time > 0) return contact.impact_time;
  const Body &a = bodies[contact.a], &b = bodies[contact.b];
  const Vec3& normal = contact.manifold.normal;
  const contacts::Closing closing = contacts::closing_of(normal, loads[contact.a], loads[contact.b], step);
  double first = never_met;
  for (int i = 0; i < contact.count; ++i) {
    const PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec3 at_a = a.twist.linear + a.twist.angular.cross(point.start_arm_a);
    const Vec3 at_b = b.twist.linear + b.twist.angular.cross(point.start_arm_b);
    const double gap = point.start_gap > touching ? point.start_gap : 0;
    const auto [time, speed] = contacts::meeting_of(gap, normal.dot(at_a - at_b), closing.pull, left);
    if (speed > closing.tremble) first = std::min(first, time);
  }
  return first;
}

/// Adds what a contact got when it was found once more.
void add_totals(ContactConstraint& contact, const ContactConstraint& again) {
  PointConstraint& first = contact.points[0];
  for (int i = 0; i < again.count; ++i) {
    const PointConstraint& point = again.points[static_cast<std::size_t>(i)];
    first.total_normal += point.total_normal;
    first.total_friction +=
        point.total_normal * (again.manifold.normal - contact.manifold.normal) + point.total_friction;
    first.approach = std::max(first.approach, point.approach);
  }
}

/// Sums of contacts over all parts of a step.
class Sums {
 public:
  void add(std::span<ContactConstraint* const> contacts) {
    for (ContactConstraint* contact : contacts) {
      double normal = 0, approach = 0;
      Vec3 total = Vec3::Zero();
      for (int i = 0; i < contact->count; ++i) {
        const PointConstraint& point = contact->points[static_cast<std::size_t>(i)];
        normal += point.total_normal;
        total += point.total_normal * contact->manifold.normal + point.total_friction;
        approach = std::max(approach, point.approach);
      }
      forget_totals(*contact);
      if (normal == 0 && approach == 0) continue;
      Sum& sum = sums_.try_emplace(key(*contact), Sum{*contact}).first->second;
      sum.normal += normal;
      sum.total += total;
      sum.approach = std::max(sum.approach, approach);
    }
  }
  /// Reports them as if they had come from one step; contacts that have ended are added.
  /// @param gone  keeps the ended ones, and `others`, until the step has been reported
  /// @param others  contacts that were solved as usual
  void finish(std::vector<ContactConstraint*>& active, std::vector<ContactConstraint>& gone,
              std::span<const ContactConstraint> others, double dt) {
    gone.clear();
    gone.reserve(sums_.size() + others.size());
    const auto is_before = [](const ContactConstraint* a, const ContactConstraint* b) { return key(*a) < key(*b); };
    const auto present = static_cast<std::ptrdiff_t>(active.size());
    for (auto& [pair, sum] : sums_) {
      if (std::binary_search(active.begin(), active.begin() + present, &sum.contact, is_before)) continue;
      gone.push_back(sum.contact);
      active.push_back(&gone.back());
    }
    for (ContactConstraint* contact : active) {
      // Its manifold is not from the start of the step.
      contact->kept = false;
      contact->impact_time = dt;
      const auto found = sums_.find(key(*contact));
      if (found == sums_.end()) continue;
      const Sum& sum = found->second;
      PointConstraint& first = contact->points[0];
      first.total_normal = sum.normal;
      first.total_friction = sum.total - sum.normal * contact->manifold.normal;
      first.approach = sum.approach;
    }
    for (const ContactConstraint& other : others) {
      gone.push_back(other);
      active.push_back(&gone.back());
    }
    std::sort(active.begin(), active.end(), is_before);
  }

 private:
  struct Sum {
    ContactConstraint contact;
    double normal = 0, approach = 0;
    Vec3 total{0, 0, 0};
  };
  /// Two bodies, and a part of each.
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  static Key key(const ContactConstraint& contact) { return {contact.a, contact.b, contact.part_a, contact.part_b}; }

  std::map<Key, Sum> sums_;
};

}  // namespace
}  // namespace strategies

bool World::Implementation::goes_by_strategies() const {
  return strategies::chosen(settings) || other_detections > 0;
}

Detection World::Implementation::detection_of(const contacts::PairInContact& pair) const {
  return strategies::detection_of(bodies[pair.a], bodies[pair.b], settings.collision);
}

bool World::Implementation::goes_by_strategies(const islands::IslandContents& island) const {
  if (!goes_by_strategies() || !island.springs.empty() || !island.joints.empty()) return false;
  const auto asks = [&](std::uint32_t body) { return state::asks_for_other_detection(*bodies[body].makeup); };
  if (!strategies::chosen(settings) &&
      std::none_of(island.contacts.begin(), island.contacts.end(),
                   [&](const auto* contact) { return asks(contact->a) || asks(contact->b); }))
    return false;
  return std::none_of(island.contacts.begin(), island.contacts.end(), [&](const auto* contact) {
    return bodies[contact->a].drive.owner() == Owner::driven || bodies[contact->b].drive.owner() == Owner::driven;
  });
}

double World::Implementation::solve_by_strategies(const islands::IslandContents& island, double dt,
                                                  strategies::IslandByStrategies& by) {
  for (contacts::ContactConstraint* contact : island.contacts) strategies::forget_totals(*contact);
  const auto fly_all = [&] {
    for (const contacts::ContactConstraint* contact : island.contacts)
      for (const std::uint32_t index : {contact->a, contact->b}) fly_alone(index, dt, dt);
  };
  double off = by.respond(bodies, loads, foreseen(island.contacts), settings,
                          {.h = dt, .left = dt, .step = dt * part_count}, moved);
  fly_all();
  off = std::max(off, respond_late(island.contacts, starts, dt, dt, by));
  separate(island.contacts, starts);
  return off;
}

std::vector<contacts::ContactConstraint*> World::Implementation::foreseen(
    std::span<contacts::ContactConstraint* const> contacts) const {
  std::vector<contacts::ContactConstraint*> those;
  std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(those),
               [this](const auto* contact) { return detection_of(*contact) != Detection::discrete; });
  return those;
}

contacts::ContactConstraint World::Implementation::overlap_now(const contacts::ContactConstraint& contact,
                                                               const state::Body& a, const state::Body& b,
                                                               const step::Start& from_a,
                                                               const step::Start& from_b) const {
  if (!surfaces::surface_of(a.shape().solid) && !surfaces::surface_of(b.shape().solid)) {
    contacts::ContactConstraint now = small::looked_for_again(contact);
    if (!find_manifold(now, a, b, small::way_of(a, contact.part_a, {}, strategies::instant),
                       small::way_of(b, contact.part_b, {}, strategies::instant), strategies::instant, nullptr))
      now.count = 0;
    return now;
  }
  // For a mesh or a field, the triangle is known: it is treated as a plane.
  contacts::ContactConstraint now = contact;
  for (int i = 0; i < now.count; ++i) {
    contacts::PointConstraint& point = now.points[static_cast<std::size_t>(i)];
    const Vec3 arm_a = a.motion.pose.rotation * (from_a.rotation.conjugate() * point.start_arm_a);
    const Vec3 arm_b = b.motion.pose.rotation * (from_b.rotation.conjugate() * point.start_arm_b);
    point.start_gap += now.manifold.normal.dot(b.center + arm_b - from_b.center - point.start_arm_b - a.center - arm_a +
                                               from_a.center + point.start_arm_a);
    point.start_arm_a = arm_a;
    point.start_arm_b = arm_b;
  }
  return now;
}

double World::Implementation::respond_late(std::span<contacts::ContactConstraint* const> contacts,
                                           std::span<const step::Start> found_at, double left, double dt,
                                           strategies::IslandByStrategies& by) {
  const auto is_late = [this](const auto* contact) { return detection_of(*contact) == Detection::discrete; };
  if (std::none_of(contacts.begin(), contacts.end(), is_late)) return 0;
  std::vector<contacts::ContactConstraint> again;  // of what has responded already
  std::vector<contacts::ContactConstraint*> responded, met;
  again.reserve(contacts.size());
  const strategies::Arrived arrived(bodies, contacts);
  for (contacts::ContactConstraint* contact : contacts) {
    const bool late = is_late(contact);
    contacts::ContactConstraint now =
        overlap_now(*contact, arrived[contact->a], arrived[contact->b], found_at[contact->a], found_at[contact->b]);
    now.kept = false;
    now.impact_time = dt;
    if (late) {
      contact->kept = false;
      contact->impact_time = dt;
    }
    if (now.count == 0) continue;
    if (late) {
      *contact = now;
      met.push_back(contact);
    } else {
      strategies::forget_totals(now);
      again.push_back(now);
      responded.push_back(contact);
      met.push_back(&again.back());
    }
  }
  const double off =
      by.respond(bodies, loads, met, settings, {.h = 0, .left = left, .step = dt * part_count, .late = true}, moved);
  for (std::size_t i = 0; i < again.size(); ++i) strategies::add_totals(*responded[i], again[i]);
  return off;
}

void World::Implementation::fly_alone(std::uint32_t index, double h, double dt) {
  state::Body& body = bodies[index];
  if (body.immovable() || body.asleep || moved[index] != 0) return;
  if (h == dt && forces::asking(settings.integrator))
    flight.land(index, body, dt);
  else
    forces::fly(body, loads[index], settings.integrator, h);
  moved[index] = 1;
}

void World::Implementation::separate(std::span<contacts::ContactConstraint* const> overlapping,
                                     std::span<const step::Start> found_at) {
  const strategies::Arrived arrived(bodies, overlapping);
  // What is looked for late has been found for the present places.
  std::vector<step::Start> places;
  places.reserve(2 * overlapping.size());
  for (const contacts::ContactConstraint* contact : overlapping)
    for (const std::uint32_t index : {contact->a, contact->b}) {
      const state::Body& body = arrived[index];
      places.push_back(detection_of(*contact) == Detection::discrete
                           ? step::Start{body.center, body.motion.pose.rotation, {}, false}
                           : found_at[index]);
    }
  strategies::Separates* const part = strategies::separation_of(settings.separation);
  const int passes = settings.solver == ContactSolver::sequential ? 1 : settings.iterations;
  for (int pass = 0; pass < passes; ++pass) {
    bool moved_apart = false;
    for (std::size_t k = 0; k < overlapping.size(); ++k) {
      const contacts::ContactConstraint* const contact = overlapping[k];
      strategies::Overlap overlap;
      overlap.a = strategies::place_of(arrived[contact->a]);
      overlap.b = strategies::place_of(arrived[contact->b]);
      if (!overlap.a.movable && !overlap.b.movable) continue;
      const contacts::ContactConstraint now =
          overlap_now(*contact, arrived[contact->a], arrived[contact->b], places[2 * k], places[2 * k + 1]);
      if (now.count == 0) continue;
      overlap.normal = now.manifold.normal;
      overlap.count = now.count;
      for (std::size_t i = 0; i < static_cast<std::size_t>(now.count); ++i)
        overlap.points[i] = {now.points[i].start_arm_a, now.points[i].start_arm_b, -now.points[i].start_gap};
      if (!(overlap.depth() > strategies::no_depth)) continue;
      moved_apart = true;
      part(overlap);
      for (const auto& [index, place] : {std::pair(contact->a, &overlap.a), std::pair(contact->b, &overlap.b)}) {
        if (!place->movable) continue;
        bodies[index].center = place->center;
        bodies[index].follow_center(place->rotation);
      }
    }
    if (!moved_apart) return;
  }
}

bool World::Implementation::goes_by_impacts() const {
  if (settings.collision == Detection::time_of_impact) return true;
  return other_detections > 0 && std::any_of(active.begin(), active.end(), [this](const auto* contact) {
           return detection_of(*contact) == Detection::time_of_impact;
         });
}

std::vector<contacts::ContactConstraint> World::Implementation::solve_as_usual(double dt, std::vector<char>& usual) {
  usual.assign(bodies.size(), 0);
  // Where only some bodies ask for it, all islands are solved as usual but those of these bodies.
  const bool all_ask = strategies::chosen(settings);
  std::vector<char> marks(bodies.size(), all_ask ? 0 : 1);  // by island: solved as usual
  bool any = !all_ask;
  const auto set = [&](std::uint32_t a, std::uint32_t b, bool as_usual) {
    for (const std::uint32_t index : {a, b}) {
      if (index == joints::JointLink::world || bodies[index].immovable()) continue;
      marks[islands.of(index)] = as_usual ? 1 : 0;
      any = any || as_usual;
    }
  };
  const auto mark = [&](std::uint32_t a, std::uint32_t b) { set(a, b, true); };
  if (!all_ask)
    for (const std::uint32_t index : watched)
      if (state::asks_for_other_detection(*bodies[index].makeup)) set(index, index, false);
  for (const islands::IslandContents& island :
       island_sorter.sort(bodies, islands, active, stiff_springs, links, workers())) {
    if (goes_by_strategies(island)) {
      for (const contacts::ContactConstraint* contact : island.contacts) set(contact->a, contact->b, false);
      continue;
    }
    for (const contacts::ContactConstraint* contact : island.contacts) mark(contact->a, contact->b);
    for (const step::SpringRow* spring : island.springs) mark(spring->a, spring->b);
    for (const joints::JointLink* link : island.joints) mark(link->a, link->b);
  }
  for (const std::uint32_t index : watched)
    if (bodies[index].drive.owner() == Owner::driven) mark(index, index);
  if (!any) return {};
  const auto is_usual = [&](const contacts::ContactConstraint* contact) {
    return marks[islands.of(bodies[contact->a].immovable() ? contact->b : contact->a)] != 0;
  };
  std::vector<contacts::ContactConstraint*> others;
  std::copy_if(active.begin(), active.end(), std::back_inserter(others), std::not_fn(is_usual));
  std::erase_if(active, std::not_fn(is_usual));
  solve_islands(dt);
  for (const std::uint32_t index : watched) {
    state::Body& body = bodies[index];
    if (body.immovable() || marks[islands.of(index)] == 0) continue;
    usual[index] = 1;
  }
  std::vector<contacts::ContactConstraint> solved;
  solved.reserve(active.size());
  for (const contacts::ContactConstraint* contact : active) solved.push_back(*contact);
  active = others;
  return solved;
}

void World::Implementation::solve_by_impacts(double dt) {
  std::vector<char> usual;
  const std::vector<contacts::ContactConstraint> solved = solve_as_usual(dt, usual);
  // What is solved as usual ends its step by what the start of it told, whatever is found for the others meanwhile.
  const std::vector<char> moved_as_usual = moved;
  std::vector<forces::Load> first_loads = loads;
  std::vector<collision::Passage> first_passages = passages;
  forces::Flight later;
  // Only now: what is solved as usual by more threads makes more solvers.
  solvers.resize(std::max<std::size_t>(1, solvers.size()));
  strategies::IslandByStrategies& by = solvers[0].strategies;
  strategies::Sums sums;
  complementarity = 0;
  const double soon = strategies::meets_now * dt;
  double left = dt;
  int at_once = 0;
  std::vector<step::Start> found_at = starts;
  const auto go = [&](double h, bool blows) {
    moved = usual;
    for (contacts::ContactConstraint* contact : active) strategies::forget_totals(*contact);
    complementarity =
        std::max(complementarity, by.respond(bodies, loads, foreseen(active), settings,
                                             {.h = h, .left = left, .step = dt * part_count, .blows = blows}, moved));
    if (h == 0) return;
    for (const std::uint32_t index : watched) fly_alone(index, h, dt);
    if (h < left) lead_on(h, left);
  };
  for (int i = 0;; ++i) {
    double first = strategies::never_met;
    for (const contacts::ContactConstraint* contact : active)
      if (detection_of(*contact) == Detection::time_of_impact)
        first = std::min(first, strategies::time_of_blow(*contact, bodies, loads, left, dt * part_count));
    if (first > left || i == strategies::most_instants || at_once == strategies::most_blows_at_once) {
      go(left, first <= left);
      sums.add(active);
      complementarity = std::max(complementarity, respond_late(active, found_at, left, dt, by));
      separate(active, found_at);
      break;
    }
    const double h = first <= soon ? 0 : std::min(first, left);
    at_once = h == 0 ? at_once + 1 : 0;
    go(h, h == 0);
    sums.add(active);
    left = std::max(left - h, soon);
    do {
      forces::gather_loads(bodies, watched, forces, settings, time + dt - left, left, workers(), loads, stiff_springs,
                           later);
      find_constraints(left);
      // What has been through the whole step is met in the next.
      std::erase_if(active, [&](const auto* contact) { return usual[contact->a] != 0 || usual[contact->b] != 0; });
    } while (wake_islands());
    for (const std::uint32_t index : watched) {
      found_at[index].center = bodies[index].center;
      found_at[index].rotation = bodies[index].motion.pose.rotation;
    }
  }
  sums.add(active);
  sums.finish(active, struck, solved, dt);
  static_cast<void>(wake_islands());
  loads = std::move(first_loads);
  passages = std::move(first_passages);
  by_strategies.assign(bodies.size(), 0);
  for (const std::uint32_t index : watched) {
    const bool as_usual = usual[index] != 0;
    by_strategies[index] = as_usual ? 0 : 1;
    moved[index] = as_usual ? moved_as_usual[index] : bodies[index].immovable() || bodies[index].asleep ? 0 : 1;
  }
}

void World::Implementation::lead_on(double h, double left) {
  for (const std::uint32_t index : watched) {
    state::Body& body = bodies[index];
    if (!body.immovable() || !body.has_target) continue;
    const step::KeyedCourse course = step::keyed_course(body, left);
    const Twist mean = course.mean_between(0, h / left, left);
    body.twist = course.velocity(h / left, left);
    body.center += h * mean.linear;
    Quat rotation = exp_map(h * mean.angular) * body.motion.pose.rotation;
    rotation.normalize();
    body.follow_center(rotation);
  }
}

}  // namespace tweenfall
