#include "document/actors/actors.h"

#include <tweenfall/curves/number_text.h>

#include "document/fields/things.h"
#include "document/forces/force.h"

namespace tweenfall::document::actors {

namespace {

using Kind = json::Value::Kind;
using Wheel = WheelDescription;

const fields::Table<Wheel>& wheel_table() {
  using fields::member;
  const auto of_wheel = [](auto WheelSettings::*part) {
    return member<Wheel>([part](Wheel & wheel) -> auto& { return wheel.wheel.*part; });
  };
  const fields::Meaning<Wheel> lock = {[](const json::Value& value, Wheel& wheel, Building&) {
                                         if (value.is(Kind::number)) wheel.lock = radians(value.number());
                                       },
                                       "0"};
  static const fields::Table<Wheel> table(
      "a wheel",
      {{"mount", &ValueForms::vector, "where its strut begins, on the chassis, m", of_wheel(&WheelSettings::mount),
        true},
       {"radius", &ValueForms::positive, "m", of_wheel(&WheelSettings::radius)},
       {"rest_length",
        &ValueForms::positive,
        "of the strut, from mount to hub, unloaded, m",
        of_wheel(&WheelSettings::rest_length),
        false,
        {},
        {"suspension_length", "travel"}},
       {"stiffness", &ValueForms::positive, "of the strut, N/m", of_wheel(&WheelSettings::stiffness)},
       {"damping", &ValueForms::not_negative, "of the strut, N s/m", of_wheel(&WheelSettings::damping)},
       {"moment", &ValueForms::positive, "of inertia about the axle, kg m^2", of_wheel(&WheelSettings::moment)},
       {"grip",
        &ValueForms::not_negative,
        "Coulomb coefficient along its heading",
        of_wheel(&WheelSettings::grip),
        false,
        {},
        {"friction", "traction"}},
       {"side_grip", &ValueForms::not_negative, "Coulomb coefficient across its heading",
        of_wheel(&WheelSettings::side_grip)},
       {"sharpness", &ValueForms::positive, "how steeply grip rises with slip", of_wheel(&WheelSettings::sharpness)},
       {"torque",
        &ValueForms::number,
        "of the engine at full throttle, N m",
        member<Wheel>(&Wheel::torque),
        false,
        {},
        {"engine"}},
       {"brake", &ValueForms::not_negative, "largest torque at full braking, N m", member<Wheel>(&Wheel::brake)},
       {"lock",
        bounded("an angle from -90 to 90 degrees", -90, false, 90),
        "of its heading at full steering, degrees",
        lock,
        false,
        {},
        {"steer", "steering"}}});
  return table;
}

const Form* wheels_form(FormStore& store, const ValueForms& values) {
  return store.add(
      map_of(store.add(wheel_table().listing_form(store, values)), "an object with wheels by name, at least one"));
}

void read_wheels(const json::Value& value, VehicleDescription& vehicle, Building& building) {
  const auto begin = [](std::string name) { return Wheel{.name = std::move(name)}; };
  const auto take = [&](Wheel wheel, bool) { vehicle.wheels.push_back(std::move(wheel)); };
  read_by_name(value, wheel_table(), building, begin, take);
}

fields::Meaning<VehicleDescription> axis(Vec3 VehicleDescription::*part, std::string standard) {
  return {[part](const json::Value& value, VehicleDescription& vehicle, Building& building) {
            if (const std::optional<Vec3> given = axis_of(value, building.problems)) vehicle.*part = *given;
          },
          std::move(standard)};
}

std::string what_part(double low) {
  return low < 0 ? "a number from -1 to 1" : "a number from 0 to 1";
}

// A constant is held against its range by its form; curves may leave it between keys, where they are clamped.
void require_keys_within(const json::Value& value, double low, Building& building) {
  if (!value.is(Kind::list)) return;
  for (const json::Value& key : value.items()) {
    const bool whole = key.is(Kind::list) && key.items().size() > 1;
    for (const json::Value& part : {whole ? key.items()[1] : usable(key, "v"), usable(key, "v_in")})
      if (part && part.is(Kind::number) && !(part.number() >= low && part.number() <= 1))
        building.problems.add(part, "expected " + what_part(low) + ", found " + number_text(part.number()));
  }
}

fields::Row<VehicleDescription> script(std::string name, double low, std::string help,
                                       Strength VehicleDescription::*part) {
  const auto make = [low](FormStore& store, const ValueForms& values) {
    Form form = *forces::strength_form(store, values);
    form.what = what_part(low) + ", a list of keys in stage time, or {\"expression\": text}";
    for (const Form*& alternative : form.alternatives)
      if (alternative->kind == Form::Kind::number) alternative = store.add(bounded(what_part(low), low, false, 1));
    return store.add(std::move(form));
  };
  const auto read = [part, low](const json::Value& value, VehicleDescription& vehicle, Building& building) {
    require_keys_within(value, low, building);
    ForceDescription scripted;
    scripted.strength = 0;
    forces::read_strength(value, scripted, building);
    vehicle.*part = scripted.strength;
  };
  return {std::move(name), fields::FormOf::Make(make), std::move(help), {read, "0"}};
}

const fields::Table<VehicleDescription>& vehicle_table() {
  const fields::Meaning<VehicleDescription> chassis = {
      [](const json::Value& value, VehicleDescription& vehicle, Building& building) {
        vehicle.chassis = fields::body_called(value, building);
      }};
  static const fields::Table<VehicleDescription> table(
      "a vehicle",
      {{"chassis", &ValueForms::name, "node with a body that the wheels carry", chassis, true, {}, {"body", "node"}},
       {"forward", &ValueForms::axis, "on the chassis", axis(&VehicleDescription::forward, "\"x\"")},
       {"up", &ValueForms::axis, "on the chassis, across \"forward\"", axis(&VehicleDescription::up, "\"y\"")},
       {"wheels", wheels_form, "by name", {read_wheels}, true},
       script("throttle", -1, "-1 to 1: part of each wheel's \"torque\", over stage time",
              &VehicleDescription::throttle),
       script("brake", 0, "0 to 1: part of each wheel's \"brake\"", &VehicleDescription::brake),
       script("steer", -1, "-1 to 1, to the left: part of each wheel's \"lock\"", &VehicleDescription::steer)});
  return table;
}

}  // namespace

const Form* vehicles_form(FormStore& store, const ValueForms& values) {
  Form vehicle = vehicle_table().listing_form(store, values);
  vehicle.definition = "vehicle";
  return store.add(map_of(store.add(std::move(vehicle)), "an object with vehicles by name"));
}

void read_vehicles(const json::Value& value, Building& building) {
  const auto begin = [](std::string name) { return VehicleDescription{.name = std::move(name)}; };
  // Without a chassis, which is reported, there is nothing to add.
  const auto take = [&](VehicleDescription vehicle, bool whole) {
    if (whole && vehicle.chassis != no_node) building.stage.vehicles.push_back(std::move(vehicle));
  };
  read_by_name(value, vehicle_table(), building, begin, take);
}

}  // namespace tweenfall::document::actors
