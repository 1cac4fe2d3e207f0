#include <algorithm>

#include "planar/contacts/manifold.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

using inner::Body;
using inner::Makeup;
using inner::Meeting;

/// @param given  null for a sleeping pair
void World::Implementation::report(Meeting& meeting, const inner::Given* given) {
  const Body &a = bodies[meeting.a], &b = bodies[meeting.b];
  Contact& contact = contacts.emplace_back();
  contact.a = handle(meeting.a);
  contact.b = handle(meeting.b);
  contact.part_a = meeting.part_a;
  contact.part_b = meeting.part_b;
  const Vec2 normal = a.turn * meeting.normal, tangent = inner::quarter(normal), apart = b.center - a.center;
  contact.manifold.normal = normal;
  contact.manifold.count = meeting.count;
  bool touches = false;
  double sideways = 0;
  const double skin_a = inner::skin_of(a, makeups[meeting.a], meeting.part_a),
               skin_b = inner::skin_of(b, makeups[meeting.b], meeting.part_b);
  for (int i = 0; i < meeting.count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const Vec2 on_a = a.turn * meeting.core_a[n] + skin_a * normal;
    const Vec2 on_b = apart + b.turn * meeting.core_b[n] - skin_b * normal;
    const double gap = normal.dot(on_b - on_a);
    contact.manifold.points[n] = {a.center + 0.5 * (on_a + on_b), -gap, meeting.feature[n]};
    touches = touches || gap <= 0;
    if (!given) continue;
    contact.impulse += given->normal[i];
    sideways += given->sideways[i];
  }
  touches = touches || contact.impulse > 0;
  if (!given) touches = meeting.touching;
  contact.total_impulse = contact.impulse * normal + sideways * tangent;
  contact.approach_speed = given ? given->approach : 0;
  contact.began = !meeting.touching;
  meeting.touching = touches;
  if (!touches) {
    contacts.pop_back();
    return;
  }
  if (!a.movable) makeups[meeting.a].reaction -= contact.total_impulse;
  if (!b.movable) makeups[meeting.b].reaction += contact.total_impulse;
}

void World::Implementation::report() {
  contacts_before.swap(contacts);
  contacts.clear();
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < meetings.size(); ++k) {
    Meeting& meeting = meetings[k];
    const bool solved = next < active.size() && active[next] == k;
    if (solved)
      report(meeting, &solver.given[next++]);
    else if (looked_at[k])
      meeting.touching = false;
    else if (meeting.touching && !meeting.sensing)
      report(meeting, nullptr);
  }
  ended.clear();
  auto now = contacts.begin();
  for (const Contact& contact : contacts_before) {
    // If several parts touched, all of them have separated.
    if (!ended.empty() && ended.back().a == contact.a && ended.back().b == contact.b) continue;
    const auto key = [](const Contact& its) { return std::pair(its.a.index, its.b.index); };
    while (now != contacts.end() && key(*now) < key(contact)) ++now;
    if (now == contacts.end() || now->a != contact.a || now->b != contact.b) ended.push_back({contact.a, contact.b});
  }
  sense();
}

void World::Implementation::sense() {
  std::vector<SensorOverlap> before;
  before.swap(overlaps);
  for (Meeting& meeting : meetings) {
    if (!meeting.sensing) continue;
    const auto placed = [this](std::uint32_t index, std::uint32_t part) {
      return inner::Placed{&makeups[index].plates[part], bodies[index].center, bodies[index].turn};
    };
    if (inner::find_manifold(placed(meeting.a, meeting.part_a), placed(meeting.b, meeting.part_b), 0).count == 0)
      continue;
    const bool first = makeups[meeting.a].sensor;
    overlaps.push_back({handle(first ? meeting.a : meeting.b), handle(first ? meeting.b : meeting.a), false});
  }
  const auto key = [](const SensorOverlap& overlap) {
    return std::tuple(overlap.sensor.index, overlap.body.index, overlap.sensor.generation, overlap.body.generation);
  };
  const auto order = [&](const SensorOverlap& one, const SensorOverlap& other) { return key(one) < key(other); };
  std::sort(overlaps.begin(), overlaps.end(), order);
  // Whichever of their parts overlap.
  const auto same = [&](const SensorOverlap& one, const SensorOverlap& other) { return key(one) == key(other); };
  overlaps.erase(std::unique(overlaps.begin(), overlaps.end(), same), overlaps.end());
  for (SensorOverlap& overlap : overlaps)
    overlap.began = !std::binary_search(before.begin(), before.end(), overlap, order);
}

}  // namespace tweenfall::planar
