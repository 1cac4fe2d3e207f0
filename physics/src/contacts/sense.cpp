#include <algorithm>
#include <functional>
#include <vector>

#include "queries/body_scene.h"
#include "state/world_data.h"

namespace tweenfall {

namespace contacts {
namespace {

bool sensed_before(const SensorOverlap& a, const SensorOverlap& b) {
  return a.sensor.index != b.sensor.index ? a.sensor.index < b.sensor.index : a.body.index < b.body.index;
}

bool same_pair(const SensorOverlap& a, const SensorOverlap& b) {
  return a.sensor == b.sensor && a.body == b.body;
}

}  // namespace
}  // namespace contacts

void World::Implementation::sense() {
  left_sensors.clear();
  if (sensors.empty() && overlaps.empty()) return;
  next_overlaps.clear();
  thread_local std::vector<std::uint32_t> sensed;  // by one sensor
  scene.forget();
  const queries::Scene& here = scene.get([this](queries::Scene& ahead) { queries::arrange_bodies(ahead, bodies); });
  for (const std::uint32_t index : sensors) {
    const state::Body& sensor = bodies[index];
    if (!here[index].shape) continue;
    const bool endless = is_scenery(sensor.shape().solid);
    const auto counts = [&](std::uint32_t other) {
      const state::Body& body = bodies[other];
      if (other == index || body.sensor() || (sensor.fixed && body.fixed)) return false;
      if (endless && is_scenery(body.shape().solid)) return false;
      return sensor.may_meet(body) && !ignored.contains(index, other);
    };
    here.find_overlapping(sensor.shape(), sensor.motion.pose, std::cref(counts), sensed);
    for (const std::uint32_t other : sensed)
      next_overlaps.push_back({{index, sensor.generation}, {other, bodies[other].generation}, false});
  }
  // Both are sorted by index; a body that has taken the place of another counts as another.
  auto before = overlaps.cbegin();
  for (SensorOverlap& overlap : next_overlaps) {
    for (; before != overlaps.cend() && contacts::sensed_before(*before, overlap); ++before)
      left_sensors.push_back(*before);
    const bool known = before != overlaps.cend() && contacts::same_pair(*before, overlap);
    overlap.began = !known;
    if (known) ++before;
  }
  left_sensors.insert(left_sensors.end(), before, overlaps.cend());
  for (SensorOverlap& left : left_sensors) left.began = false;
  std::swap(overlaps, next_overlaps);
}

}  // namespace tweenfall
