#include "stage/actors/vehicles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stage/actors/named.h"
#include "stage/between.h"
#include "state/checks.h"

namespace tweenfall::staging {

namespace {

Vehicle vehicle_of(const StageState& state, const VehicleDescription& described) {
  const StagedBody* chassis = described.chassis < state.body_of.size() ? state.body(described.chassis) : nullptr;
  if (!chassis) throw std::invalid_argument("its chassis must be a node with a body");
  if (state.world.is_fixed(chassis->id)) throw std::invalid_argument("its chassis must not be static");
  VehicleSettings settings{
      .chassis = chassis->id, .forward = described.forward, .up = described.up, .gravity = state.gravity, .wheels = {}};
  for (std::size_t i = 0; i < described.wheels.size(); ++i) {
    const WheelDescription& wheel = described.wheels[i];
    const auto same = [&](const WheelDescription& other) { return other.name == wheel.name; };
    const auto first = std::ranges::find_if(described.wheels, same);
    if (static_cast<std::size_t>(first - described.wheels.begin()) != i)
      throw std::invalid_argument("two of its wheels are called \"" + wheel.name + "\"");
    if (!state::countable(wheel.torque)) throw std::invalid_argument("torque of a wheel must be finite, at most 1e30");
    state::require_amount(wheel.brake, "brake of a wheel");
    if (!state::countable(wheel.lock)) throw std::invalid_argument("lock of a wheel must be finite");
    settings.wheels.push_back(wheel.wheel);
  }
  return Vehicle(std::move(settings));
}

}  // namespace

void add_vehicles(StageState& state, const StageDescription& description, std::vector<StageFault>& faults) {
  for (std::size_t i = 0; i < description.vehicles.size(); ++i) {
    const VehicleDescription& described = description.vehicles[i];
    const auto refuse = [&](const std::string& why) {
      faults.push_back({StageFault::Part::vehicle, i, "the vehicle \"" + described.name + "\": " + why});
    };
    if (std::ranges::any_of(state.vehicles, [&](const auto& other) { return other.described->name == described.name; }))
      refuse("another one has this name");
    try {
      state.vehicles.push_back({std::make_shared<const VehicleDescription>(described), vehicle_of(state, described)});
    } catch (const std::invalid_argument& fault) {
      refuse(fault.what());
    }
  }
}

void control_vehicle(StageState& state, std::string_view name, const VehicleControl& control) {
  StagedVehicle& staged = state.vehicles[index_called(state.vehicles, name, "vehicle")];
  if (!control.throttle && !control.brake && !control.steer)
    throw std::invalid_argument("a vehicle control needs a throttle, a brake or a steer");
  const auto require = [](const std::optional<double>& value, const char* what) {
    if (value && !std::isfinite(*value))
      throw std::invalid_argument(std::string(what) + " of a vehicle must be finite");
  };
  require(control.throttle, "throttle");
  require(control.brake, "brake");
  require(control.steer, "steer");
  if (control.throttle) staged.control.throttle = control.throttle;
  if (control.brake) staged.control.brake = control.brake;
  if (control.steer) staged.control.steer = control.steer;
}

void drive_vehicles(StageState& state, double dt) {
  for (StagedVehicle& staged : state.vehicles) {
    if (!state.world.contains(staged.vehicle.settings().chassis)) continue;
    const VehicleDescription& described = *staged.described;
    const auto held = [&](const std::optional<double>& value, const Strength& script, double low) {
      return std::clamp(value ? *value : script.at(state.time), low, 1.0);
    };
    const double throttle = held(staged.control.throttle, described.throttle, -1);
    const double brake = held(staged.control.brake, described.brake, 0);
    const double steer = held(staged.control.steer, described.steer, -1);
    for (std::size_t i = 0; i < described.wheels.size(); ++i) {
      const WheelDescription& wheel = described.wheels[i];
      staged.vehicle.control(
          i, {.torque = throttle * wheel.torque, .brake = brake * wheel.brake, .steer = steer * wheel.lock});
    }
    staged.vehicle.act(state.world, dt);
  }
}

std::vector<StageWheel> vehicle_wheels(const StageState& from, const StageState& to, std::string_view name,
                                       double time) {
  const std::size_t index = index_called(to.vehicles, name, "vehicle");
  const StagedVehicle& last = to.vehicles[index];
  const bool between = is_between(from, to, time);
  const std::vector<WheelReading>& before = (between ? from : to).vehicles[index].vehicle.readings();
  const std::vector<WheelReading>& after = last.vehicle.readings();
  const double part = between ? (time - from.time) / (to.time - from.time) : 0;
  const NodeId node = last.described->chassis;
  const bool here = node < to.present.size() && to.present[node];
  const Pose chassis = here ? node_world(from, to, node, time).motion.pose : Pose{};
  std::vector<StageWheel> wheels;
  for (std::size_t i = 0; i < before.size(); ++i) {
    StageWheel& wheel = wheels.emplace_back();
    wheel.reading = before[i];
    wheel.reading.angle += part * (after[i].angle - before[i].angle);
    wheel.reading.length += part * (after[i].length - before[i].length);
    wheel.pose = wheel_pose(last.vehicle.settings(), i, wheel.reading, chassis);
  }
  return wheels;
}

}  // namespace tweenfall::staging
