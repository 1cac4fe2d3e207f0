#include "stage/rules/sensed.h"

#include <tweenfall/anim/animation.h>

#include <algorithm>

namespace tweenfall::staging {

namespace {

void tell(const StageState& state, const SensorOverlap& overlap, const char* name, std::vector<Happening>& happenings) {
  // Nothing is reported for what was removed.
  if (!state.world.contains(overlap.sensor) || !state.world.contains(overlap.body)) return;
  StageEvent event;
  event.time = state.time;
  event.name = name;
  event.nodes = {state.node_of[overlap.sensor.index], state.node_of[overlap.body.index]};
  Happening& happening = happenings.emplace_back();
  happening.time = state.time;
  happening.what = std::move(event);
}

bool names(const StageState& state, const SensorOverlap& overlap, const std::string& region, const std::string& who,
           const BodyId& own) {
  if (!state.world.contains(overlap.sensor) || !state.world.contains(overlap.body)) return false;
  const bool meant = who.empty() ? overlap.body == own : matches(who, state.name_of(overlap.body));
  return meant && matches(region, state.name_of(overlap.sensor));
}

}  // namespace

void report_sensed(const StageState& state, std::vector<Happening>& happenings) {
  for (const SensorOverlap& overlap : state.world.ended_sensor_overlaps()) tell(state, overlap, "left", happenings);
  for (const SensorOverlap& overlap : state.world.sensor_overlaps())
    if (overlap.began) tell(state, overlap, "entered", happenings);
}

bool has_entered(const StageState& state, const when::Enter& enter, const BodyId& own) {
  return std::ranges::any_of(state.world.sensor_overlaps(), [&](const SensorOverlap& overlap) {
    return overlap.began && names(state, overlap, enter.region, enter.who, own);
  });
}

bool has_left(const StageState& state, const when::Leave& leave, const BodyId& own) {
  return std::ranges::any_of(state.world.ended_sensor_overlaps(), [&](const SensorOverlap& overlap) {
    return names(state, overlap, leave.region, leave.who, own);
  });
}

}  // namespace tweenfall::staging
