#include "document/joints/joint.h"

#include <tweenfall/curves/number_text.h>

namespace tweenfall::document::joints {

namespace {

const fields::Table<Limits>& soft_table() {
  const auto row = [](const char* name, const char* help, double Limits::*part) {
    return fields::Row<Limits>{name, &ValueForms::number, help, fields::member<Limits>(part), true};
  };
  static const fields::Table<Limits> table(
      "soft limits", {row("low", "", &Limits::low),
                      row("high", "", &Limits::high),
                      {"hz", bounded("a frequency above 0 Hz", 0, true), "of the spring beyond them",
                       fields::member<Limits>(&Limits::hz), true},
                      {"zeta", &ValueForms::not_negative, "its damping ratio", fields::member<Limits>(&Limits::zeta)}});
  return table;
}

const Form* limits_form(FormStore& store, const ValueForms& values, const std::string& of, const Form& number) {
  const Form* const bound = store.add(number);
  Form soft = soft_table().listing_form(store, values);
  for (Field& field : soft.fields)
    if (field.name == "low" || field.name == "high") field.form = bound;
  return store.add(choice_of("limits of " + of + ": [low, high], or soft ones {\"low\", \"high\", \"hz\", \"zeta\"}",
                             {store.add(list_of(bound, "", 2, 2)), store.add(std::move(soft))}));
}

struct MotorTables {
  fields::Table<Motor> angle, length;
};

const MotorTables& motor_tables() {
  const auto turned = [](auto part) {
    return fields::Meaning<Motor>{
        [part](const json::Value& value, Motor& motor, Building&) { motor.*part = radians(value.number()); }};
  };
  fields::Meaning<Motor> turning_speed = turned(&Motor::speed);
  turning_speed.standard = "0";
  const fields::Row<Motor> hz{"hz", bounded("a frequency above 0 Hz", 0, true), "of the spring toward the position",
                              fields::member<Motor>(&Motor::hz)};
  const fields::Row<Motor> zeta{"zeta", &ValueForms::not_negative, "its damping ratio",
                                fields::member<Motor>(&Motor::zeta)};
  const std::string beside = "; with a position, that of the position";
  static const MotorTables tables{
      {"a motor",
       {{"speed", &ValueForms::number, "degrees per second" + beside, turning_speed},
        {"position", &ValueForms::number, "degrees", turned(&Motor::position)},
        hz,
        zeta,
        {"max_torque", &ValueForms::not_negative, "N m; absent: without limit",
         fields::member<Motor>(&Motor::max_force)}}},
      {"a motor",
       {{"speed", &ValueForms::number, "m/s" + beside, fields::member<Motor>(&Motor::speed)},
        {"position", &ValueForms::number, "m", fields::member<Motor>(&Motor::position)},
        hz,
        zeta,
        {"max_force", &ValueForms::not_negative, "N; absent: without limit",
         fields::member<Motor>(&Motor::max_force)}}}};
  return tables;
}

}  // namespace

fields::FormOf angle_limits_form(double lowest, double highest) {
  return fields::FormOf::Make([lowest, highest](FormStore& store, const ValueForms& values) {
    const bool unbounded = lowest == -Form::infinite;
    return limits_form(
        store, values, "an angle",
        bounded(unbounded ? "degrees" : "degrees from " + number_text(lowest) + " to " + number_text(highest), lowest,
                false, highest));
  });
}

fields::FormOf length_limits_form(bool from_zero) {
  return fields::FormOf::Make([from_zero](FormStore& store, const ValueForms& values) {
    return limits_form(store, values, "a length",
                       from_zero ? bounded("meters, at least 0", 0, false) : bounded("meters", -Form::infinite, false));
  });
}

std::optional<Limits> read_limits(const json::Value& value, double unit, Building& building) {
  Limits limits;
  if (value.is(json::Value::Kind::list)) {
    if (value.items().size() != 2) return {};
    for (const json::Value& item : value.items())
      if (!item.is(json::Value::Kind::number)) return {};
    limits.low = value.items()[0].number();
    limits.high = value.items()[1].number();
  } else {
    if (!usable(value, "low") || !usable(value, "high")) return {};
    soft_table().read(value, limits, building);
  }
  if (limits.low > limits.high)
    building.problems.add(value, "limits must be in order, the low one first; " + number_text(limits.low) +
                                     " is above " + number_text(limits.high));
  limits.low *= unit;
  limits.high *= unit;
  return limits;
}

fields::FormOf motor_form(bool of_angle) {
  return fields::FormOf::Make([of_angle](FormStore& store, const ValueForms& values) {
    const MotorTables& tables = motor_tables();
    Form form = (of_angle ? tables.angle : tables.length).listing_form(store, values);
    form.together = {{Together::Rule::first_needs_second, {"hz", "position"}},
                     {Together::Rule::first_needs_second, {"zeta", "position"}}};
    return store.add(std::move(form));
  });
}

Motor read_motor(const json::Value& value, bool of_angle, Building& building) {
  Motor motor;
  (of_angle ? motor_tables().angle : motor_tables().length).read(value, motor, building);
  return motor;
}

}  // namespace tweenfall::document::joints
