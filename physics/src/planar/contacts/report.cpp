#include <algorithm>

#include "planar/contacts/manifold.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

using inner::Body;
using inner::Makeup;
using inner::Meeting;

namespace inner {
namespace {

/// Where two bodies of a meeting touch, or nearly.
struct Touching {
  Vec2 normal, middle[2];  ///< world; the middles from the center of a, m
  double gap[2];           ///< m

  Touching(const Meeting& meeting, const Body& a, double skin_a, const Body& b, double skin_b)
      : normal(a.turn * meeting.normal) {
    const Vec2 apart = b.center - a.center;
    for (int i = 0; i < meeting.count; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const Vec2 on_a = a.turn * meeting.core_a[n] + skin_a * normal;
      const Vec2 on_b = apart + b.turn * meeting.core_b[n] - skin_b * normal;
      gap[i] = normal.dot(on_b - on_a);
      middle[i] = 0.5 * (on_a + on_b);
    }
  }
};

}  // namespace
}  // namespace inner

/// @param solved  in this step; else a sleeping pair
/// @param given   then, of the solver's
void World::Implementation::report(std::uint32_t index, bool solved, std::uint32_t given) {
  Meeting& meeting = meetings[index];
  const bool before = meeting.touching;
  if (solved) {
    const inner::Given& its = solver.given[given];
    double pressed = 0, dragged = 0;
    for (int i = 0; i < meeting.count; ++i) {
      pressed += its.normal[i];
      dragged += its.sideways[i];
    }
    const Body &a = bodies[meeting.a], &b = bodies[meeting.b];
    meeting.touching = pressed > 0;
    if (!meeting.touching) {
      const inner::Touching touching(meeting, a, inner::skin_of(a, makeups[meeting.a], meeting.part_a), b,
                                     inner::skin_of(b, makeups[meeting.b], meeting.part_b));
      for (int i = 0; i < meeting.count; ++i) meeting.touching = meeting.touching || touching.gap[i] <= 0;
      if (!meeting.touching) return;
    }
    if (!a.movable || !b.movable) {
      const Vec2 normal = a.turn * meeting.normal, total = pressed * normal + dragged * inner::quarter(normal);
      if (!a.movable) makeups[meeting.a].reaction -= total;
      if (!b.movable) makeups[meeting.b].reaction += total;
    }
  }
  touches.push_back({handle(meeting.a), handle(meeting.b), index, given, solved, !before});
}

Contact World::Implementation::contact_of(const inner::Touch& touch) const {
  const Meeting& meeting = meetings[touch.meeting];
  const Body &a = bodies[meeting.a], &b = bodies[meeting.b];
  const inner::Touching touching(meeting, a, inner::skin_of(a, makeups[meeting.a], meeting.part_a), b,
                                 inner::skin_of(b, makeups[meeting.b], meeting.part_b));
  Contact contact;
  contact.a = touch.a;
  contact.b = touch.b;
  contact.part_a = meeting.part_a;
  contact.part_b = meeting.part_b;
  contact.manifold.normal = touching.normal;
  contact.manifold.count = meeting.count;
  double sideways = 0;
  for (int i = 0; i < meeting.count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    contact.manifold.points[n] = {a.center + touching.middle[i], -touching.gap[i], meeting.feature[n]};
    if (!touch.solved) continue;
    contact.impulse += solver.given[touch.given].normal[i];
    sideways += solver.given[touch.given].sideways[i];
  }
  contact.total_impulse = contact.impulse * touching.normal + sideways * inner::quarter(touching.normal);
  if (touch.solved) contact.approach_speed = solver.given[touch.given].approach;
  contact.began = touch.began;
  return contact;
}

const std::vector<Contact>& World::Implementation::contacts() const {
  return told.get([this](std::vector<Contact>& all) {
    all.clear();
    all.reserve(touches.size());
    for (const inner::Touch& touch : touches) all.push_back(contact_of(touch));
  });
}

void World::Implementation::recall(const std::vector<Contact>& contacts) {
  touches.clear();
  for (const Contact& contact : contacts) touches.push_back({.a = contact.a, .b = contact.b});
  told.forget();
  static_cast<void>(told.get([&](std::vector<Contact>& all) { all = contacts; }));
}

void World::Implementation::report() {
  told.forget();
  touches_before.swap(touches);
  touches.clear();
  std::uint32_t next = 0;
  for (std::uint32_t k = 0; k < meetings.size(); ++k) {
    Meeting& meeting = meetings[k];
    if (next < active.size() && active[next] == k)
      report(k, true, next++);
    else if (looked_at[k])
      meeting.touching = false;
    else if (meeting.touching && !meeting.sensing)
      report(k, false, 0);
  }
  ended.clear();
  auto now = touches.begin();
  for (const inner::Touch& touch : touches_before) {
    // If several parts touched, all of them have separated.
    if (now != touches.end() && now->a == touch.a && now->b == touch.b) continue;
    if (!ended.empty() && ended.back().a == touch.a && ended.back().b == touch.b) continue;
    const auto key = [](const inner::Touch& its) { return std::pair(its.a.index, its.b.index); };
    while (now != touches.end() && key(*now) < key(touch)) ++now;
    if (now == touches.end() || now->a != touch.a || now->b != touch.b) ended.push_back({touch.a, touch.b});
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
