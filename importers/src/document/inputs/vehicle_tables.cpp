#include "document/inputs/input_tables.h"

namespace tweenfall::document::inputs {

using fields::Row;
using fields::Table;

namespace {

Row<Controlled> pedal(std::string name, std::string what, double low, std::string help,
                      std::optional<double> VehicleControl::*part) {
  const auto read = [part](const json::Value& value, Controlled& controlled, Building&) {
    if (value.is(json::Value::Kind::number)) controlled.input.control.*part = value.number();
  };
  return {std::move(name), bounded(std::move(what), low, false, 1), std::move(help), {read}};
}

}  // namespace

const Table<Controlled>& control_table() {
  const auto vehicle = [](const json::Value& value, Controlled& controlled, Building&) {
    controlled.input.vehicle = value.text();
    controlled.place = value;
  };
  static const Table<Controlled> table(
      "a control", {{"vehicle", &ValueForms::name, "absent: the only one", {vehicle}},
                    pedal("throttle", "a number from -1 to 1", -1, "part of each wheel's \"torque\"; absent: as before",
                          &VehicleControl::throttle),
                    pedal("brake", "a number from 0 to 1", 0, "part of each wheel's \"brake\"; absent: as before",
                          &VehicleControl::brake),
                    pedal("steer", "a number from -1 to 1", -1,
                          "to the left: part of each wheel's \"lock\"; absent: as before", &VehicleControl::steer)});
  return table;
}

}  // namespace tweenfall::document::inputs
