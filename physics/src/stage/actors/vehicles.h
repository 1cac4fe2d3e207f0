#pragma once

// Vehicles of a stage: driven by their scripts, before each step of the world.

#include <memory>
#include <string_view>
#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Adds the description's vehicles. Impossible ones are faults.
void add_vehicles(StageState& state, const StageDescription& description, std::vector<StageFault>& faults);
/// From now on. @throws std::invalid_argument with the nearest name, for numbers not finite, and for an empty control
void control_vehicle(StageState& state, std::string_view name, const VehicleControl& control);
/// Lets wheels act on the world's next step of `dt` seconds.
void drive_vehicles(StageState& state, double dt);
/// Between two consecutive states. @throws std::invalid_argument with the nearest name
[[nodiscard]] std::vector<StageWheel> vehicle_wheels(const StageState& from, const StageState& to,
                                                     std::string_view name, double time);

}  // namespace tweenfall::staging
