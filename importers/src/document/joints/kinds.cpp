#include "document/joints/joint.h"

#include <utility>

namespace tweenfall::document::joints {

namespace {

using Read = JointBeingRead;
using Rows = std::vector<fields::Row<Read>>;
using Table = fields::Table<Read>;

constexpr double any = Form::infinite;
const double per_degree = radians(1);

fields::Row<Read> axis(std::string help, bool required = true) {
  const auto read = [](const json::Value& value, Read& joint, Building& building) {
    if (const std::optional<Vec3> given = axis_of(value, building.problems)) joint.axis = *given;
  };
  return {"axis", &ValueForms::axis, std::move(help), {read}, required};
}

fields::Row<Read> second_axis(std::string name, std::string help, bool required, std::string standard = {}) {
  const auto read = [](const json::Value& value, Read& joint, Building& building) {
    if (const std::optional<Vec3> given = axis_of(value, building.problems)) joint.second_axis = *given;
  };
  return {std::move(name), &ValueForms::axis, std::move(help), {read, std::move(standard)}, required};
}

// Rows for the members of a kind

template <class Kind, class Access>
fields::Row<Read> angle_limits(std::string name, std::string help, Access part) {
  const auto read = [part](const json::Value& value, Read& joint, Building& building) {
    std::invoke(part, joint.as<Kind>()) = read_limits(value, per_degree, building);
  };
  return {std::move(name), angle_limits_form(-any, any), std::move(help), {read}};
}

template <class Kind, class Access>
fields::Row<Read> length_limits(std::string name, std::string help, Access part) {
  const auto read = [part](const json::Value& value, Read& joint, Building& building) {
    std::invoke(part, joint.as<Kind>()) = read_limits(value, 1, building);
  };
  return {std::move(name), length_limits_form(false), std::move(help), {read}};
}

template <class Kind, class Access>
fields::Row<Read> motor(std::string name, bool of_angle, Access part) {
  const auto read = [part, of_angle](const json::Value& value, Read& joint, Building& building) {
    std::invoke(part, joint.as<Kind>()) = read_motor(value, of_angle, building);
  };
  return {std::move(name), motor_form(of_angle), "absent: none; {} is a brake", {read}};
}

template <class Kind>
fields::Meaning<Read> number(double Kind::*part, double unit = 1) {
  const double standard = Kind{}.*part;
  return {[part, unit](const json::Value& value, Read& joint, Building&) {
            joint.as<Kind>().*part = value.number() * unit;
          },
          fields::text_of_default(standard)};
}

const Table& none_table(const char* what) {
  static const Table ball("a ball", {}), fixed("a weld", {});
  return what[0] == 'b' ? ball : fixed;
}

const Table& hinge_table() {
  static const Table table("a hinge", {axis("about which the second turns"),
                                       angle_limits<HingeJoint>("limits", "degrees from rest", &HingeJoint::limits),
                                       motor<HingeJoint>("motor", true, &HingeJoint::motor)});
  return table;
}

const Table& slider_table() {
  static const Table table("a slider", {axis("along which the second slides"),
                                        length_limits<SliderJoint>("limits", "m from rest", &SliderJoint::limits),
                                        motor<SliderJoint>("motor", false, &SliderJoint::motor)});
  return table;
}

const Table& distance_table() {
  const fields::Meaning<Read> length = {[](const json::Value& value, Read& joint, Building&) {
    joint.as<DistanceJoint>().limits = {value.number(), value.number()};
  }};
  const fields::Meaning<Read> limits = {[](const json::Value& value, Read& joint, Building& building) {
    if (const std::optional<Limits> given = read_limits(value, 1, building)) joint.as<DistanceJoint>().limits = *given;
  }};
  static const Table table("a distance", {{"length", &ValueForms::not_negative, "of a rod, m", length},
                                          {"limits", length_limits_form(true), "of a rope [0, length], m", limits}});
  return table;
}

const Table& universal_table() {
  using Joint = UniversalJoint;
  static const Table table(
      "a universal joint",
      {axis("of the first node"), second_axis("second_axis", "of the second, at a right angle to it", true),
       angle_limits<Joint>("limits", "degrees from rest, about the first axis", &Joint::first_limits),
       angle_limits<Joint>("second_limits", "about the second", &Joint::second_limits),
       motor<Joint>("motor", true, &Joint::first_motor), motor<Joint>("second_motor", true, &Joint::second_motor)});
  return table;
}

const Table& limb_motor_table() {
  using Joint = SwingTwistJoint;
  const fields::Meaning<Read> rotation = {[](const json::Value& value, Read& joint, Building& building) {
    Quat toward(1, 0, 0, 0);
    fields::take(value, toward, building);
    joint.toward = toward;
  }};
  static const Table table(
      "a motor", {{"rotation", &ValueForms::rotation, "from rest, to which it turns the second", rotation, true},
                  {"hz", bounded("a frequency above 0 Hz", 0, true), "of the spring", number(&Joint::hz)},
                  {"zeta", &ValueForms::not_negative, "its damping ratio", number(&Joint::zeta)},
                  {"max_torque", &ValueForms::not_negative, "N m; absent: without limit", number(&Joint::max_torque)}});
  return table;
}

const Form* swing_form(FormStore& store, const ValueForms&) {
  const Form* const angle = store.add(bounded("degrees from 0 to 180", 0, false, 180));
  return store.add(choice_of("half angles of a cone from 0 to 180 degrees: one, or one about each axis beside",
                             {angle, store.add(list_of(angle, "", 2, 2))}));
}

const Table& swing_twist_table() {
  using Joint = SwingTwistJoint;
  const fields::Meaning<Read> swing = {[](const json::Value& value, Read& joint, Building&) {
    const bool round = value.is(json::Value::Kind::number);
    if (!round && value.items().size() != 2) return;
    const auto angle = [&](std::size_t i) { return radians(round ? value.number() : value.items()[i].number()); };
    joint.as<Joint>().swing_y = angle(0);
    joint.as<Joint>().swing_z = angle(1);
  }};
  const fields::Meaning<Read> twist = {[](const json::Value& value, Read& joint, Building& building) {
    if (const std::optional<Limits> given = read_limits(value, per_degree, building)) joint.as<Joint>().twist = *given;
  }};
  static const Table table(
      "a swing-twist joint",
      {axis("of the limb"),
       second_axis("second_axis", "about which the first of two swings turns", false),
       {"swing", swing_form, "half angles of the cone in which the axis swings", swing, true},
       {"twist", angle_limits_form(-180, 180), "degrees about the axis, from rest", twist, true},
       fields::part<Read>("motor", limb_motor_table(), "absent: none", [](Read& joint) -> Read& { return joint; })});
  return table;
}

const Table& suspension_table() {
  using Joint = WheelJoint;
  static const Table table("a suspension",
                           {second_axis("axis", "along which it springs", false, "\"y\""),
                            {"hz", &ValueForms::not_negative, "of its spring", number(&Joint::hz)},
                            {"zeta", &ValueForms::not_negative, "its damping ratio", number(&Joint::zeta)},
                            length_limits<Joint>("limits", "m from rest", &Joint::suspension)});
  return table;
}

const Table& wheel_table() {
  static const Table table(
      "a wheel", {axis("about which it turns"),
                  fields::part<Read>("suspension", suspension_table(), "", [](Read& joint) -> Read& { return joint; }),
                  motor<WheelJoint>("motor", true, &WheelJoint::motor)});
  return table;
}

const Table& pulley_table() {
  using Joint = PulleyJoint;
  const auto two_points = [](FormStore& store, const ValueForms& values) -> const Form* {
    return store.add(list_of(values.vector, "a list of 2 points", 2, 2));
  };
  const fields::Meaning<Read> over = {[](const json::Value& value, Read& joint, Building&) {
    if (value.items().size() != 2) return;
    joint.as<Joint>().pulley_a = vector_of(value.items()[0]).value_or(Vec3(0, 0, 0));
    joint.as<Joint>().pulley_b = vector_of(value.items()[1]).value_or(Vec3(0, 0, 0));
  }};
  const fields::Meaning<Read> length = {
      [](const json::Value& value, Read& joint, Building&) { joint.as<Joint>().length = value.number(); }};
  static const Table table(
      "a pulley",
      {{"over", fields::FormOf(+two_points), "where the two pulleys hang, m", over, true},
       {"ratio", &ValueForms::positive, "by which the second's part of the rope counts", number(&Joint::ratio)},
       {"length", &ValueForms::positive, "of the rope, m; absent: as it starts", length}});
  return table;
}

const Table& gear_table() {
  fields::Meaning<Read> ratio = number(&GearJoint::ratio);
  ratio.read = [](const json::Value& value, Read& joint, Building& building) {
    joint.as<GearJoint>().ratio = value.number();
    if (value.number() == 0) building.problems.add(value, "a ratio of 0 turns nothing; leave the gear out");
  };
  static const Table table(
      "a gear", {axis("of the first wheel"),
                 second_axis("second_axis", "of the second; absent: the same", false),
                 {"ratio", &ValueForms::number, "how often the second turns back for each turn of the first", ratio}});
  return table;
}

const Table& spring_joint_table() {
  using Joint = SpringJoint;
  static const Table table("a spring",
                           {{"length", &ValueForms::not_negative, "at rest, m", number(&Joint::length)},
                            {"stiffness", &ValueForms::not_negative, "N/m", number(&Joint::stiffness), true},
                            {"damping", &ValueForms::not_negative, "N s/m", number(&Joint::damping)}});
  return table;
}

template <class Kind>
fields::Row<Read> kind(std::string name, const Table& table, std::string help, std::vector<std::string> elsewhere) {
  const auto read = [&table](const json::Value& value, Read& joint, Building& building) {
    joint.joint.kind = Kind{};
    joint.kind = value;
    table.read(value, joint, building);
  };
  return {std::move(name), fields::form_of(table), std::move(help), {read}, false, {}, std::move(elsewhere)};
}

// What other programs' balls limit has a kind of its own.
fields::Row<Read> ball() {
  fields::Row<Read> row =
      kind<BallJoint>("ball", none_table("ball"), "holds a point", {"point", "spherical", "socket", "point2point"});
  row.form = fields::FormOf::Make([](FormStore& store, const ValueForms& values) {
    Form form = none_table("ball").listing_form(store, values);
    form.said_of = [](std::string_view name) {
      const bool limits = name == "limits" || name == "swing" || name == "twist" || name == "motor";
      return limits ? std::string("; a ball turns freely, and a \"swing_twist\" has \"swing\", \"twist\" and \"motor\"")
                    : std::string();
    };
    return store.add(std::move(form));
  });
  return row;
}

// A distance has a length or limits.
fields::Row<Read> distance() {
  fields::Row<Read> row =
      kind<DistanceJoint>("distance", distance_table(), "between two points", {"rope", "rod", "string", "chain"});
  row.form = fields::FormOf::Make([](FormStore& store, const ValueForms& values) {
    Form form = distance_table().listing_form(store, values);
    form.together = {exactly_one({"length", "limits"})};
    return store.add(std::move(form));
  });
  return row;
}

}  // namespace

Rows kinds() {
  return {ball(),
          kind<HingeJoint>("hinge", hinge_table(), "turns about an axis", {"revolute", "pin"}),
          kind<SliderJoint>("slider", slider_table(), "slides along an axis", {"prismatic", "rail"}),
          kind<FixedJoint>("fixed", none_table("fixed"), "a weld", {"weld", "lock", "rigid"}),
          distance(),
          kind<UniversalJoint>("universal", universal_table(), "turns about two axes", {"cardan", "hooke"}),
          kind<SwingTwistJoint>("swing_twist", swing_twist_table(), "swings in a cone and twists",
                                {"cone_twist", "conetwist", "shoulder"}),
          kind<WheelJoint>("wheel", wheel_table(), "turns about an axis and springs along another", {"suspension"}),
          kind<PulleyJoint>("pulley", pulley_table(), "a rope over two pulleys", {}),
          kind<GearJoint>("gear", gear_table(), "two that turn on hinges of their own", {"gears", "cogs"}),
          kind<SpringJoint>("spring", spring_joint_table(),
                            "a damped spring of any stiffness; a stiff one loses some of its swing to the step, which "
                            "a spring among the forces keeps",
                            {})};
}

}  // namespace tweenfall::document::joints
