#include "document/fields/things.h"
#include "document/forces/force.h"

#include <utility>

namespace tweenfall::document::forces {

namespace {

using Described = ForceDescription;
using Rows = std::vector<fields::Row<Described>>;
using Table = fields::Table<Described>;

template <class Kind>
Kind& as(Described& described) {
  return std::get<Kind>(described.force);
}

// A member of a kind
template <class Kind, class Part>
fields::Meaning<Described> of(Part Kind::*part) {
  return {[part](const json::Value& value, Described& described, Building& building) {
            fields::take(value, as<Kind>(described).*part, building);
          },
          fields::text_of_default(Kind{}.*part)};
}

template <class Kind>
fields::Meaning<Described> axis_of_kind(Vec3 Kind::*part) {
  return {[part](const json::Value& value, Described& described, Building& building) {
            if (const std::optional<Vec3> given = axis_of(value, building.problems)) as<Kind>(described).*part = *given;
          },
          "\"y\""};
}

fields::Meaning<Described> node(std::size_t Described::*part) {
  return {[part](const json::Value& value, Described& described, Building& building) {
    described.*part = fields::body_called(value, building);
  }};
}

// The body at the other end, if any
fields::Meaning<Described> other_end(std::string what) {
  return {[what = std::move(what)](const json::Value& value, Described& described, Building& building) {
    described.b = fields::body_called(value, building);
    if (described.a != no_node && described.a == described.b)
      building.problems.add(value, what + " cannot pull a body to itself; leave \"b\" out for the world");
  }};
}

const fields::Table<Drag>& drag_table() {
  using fields::member;
  static const fields::Table<Drag> table(
      "a drag", {{"linear", &ValueForms::not_negative, "kg/s", member<Drag>(&Drag::linear)},
                 {"quadratic", &ValueForms::not_negative, "kg/m", member<Drag>(&Drag::quadratic)},
                 {"angular", &ValueForms::not_negative, "kg m^2/s", member<Drag>(&Drag::angular)}});
  return table;
}

const Table& spring_table() {
  static const Table table("a spring",
                           {{"a", &ValueForms::name, "node with a body", node(&Described::a), true},
                            {"b", &ValueForms::name, "node with a body; absent: the world", other_end("a spring")},
                            {"anchor_a", &ValueForms::vector, "on a, m", of(&Spring::anchor_a)},
                            {"anchor_b", &ValueForms::vector, "on b or in the world, m", of(&Spring::anchor_b)},
                            {"rest_length", &ValueForms::not_negative, "m", of(&Spring::rest_length)},
                            {"stiffness", &ValueForms::not_negative, "N/m", of(&Spring::stiffness), true},
                            {"damping", &ValueForms::not_negative, "N s/m", of(&Spring::damping)}});
  return table;
}

const Table& damper_table() {
  static const Table table("a damper",
                           {{"a", &ValueForms::name, "node with a body", node(&Described::a), true},
                            {"b", &ValueForms::name, "node with a body; absent: the world", other_end("a damper")},
                            {"anchor_a", &ValueForms::vector, "on a, m", of(&Damper::anchor_a)},
                            {"anchor_b", &ValueForms::vector, "on b or in the world, m", of(&Damper::anchor_b)},
                            {"damping", &ValueForms::not_negative, "N s/m", of(&Damper::damping), true}});
  return table;
}

const Table& wind_table() {
  static const Table table(
      "a wind",
      {{"velocity", &ValueForms::vector, "of the medium, m/s", of(&Wind::velocity), true},
       {"linear", &ValueForms::not_negative, "kg/s", of(&Wind::linear)},
       {"quadratic", &ValueForms::not_negative, "kg/m", of(&Wind::quadratic)},
       {"angular", &ValueForms::not_negative, "kg m^2/s", of(&Wind::angular)},
       {"coefficient", &ValueForms::not_negative, "of drag, by how large the body looks", of(&Wind::coefficient)},
       {"density", &ValueForms::not_negative, "of the medium, kg/m^3", of(&Wind::density)}});
  return table;
}

const Table& buoyancy_table() {
  static const Table table(
      "a liquid", {{"normal", &ValueForms::axis, "of its surface", axis_of_kind(&Buoyancy::normal)},
                   {"level", &ValueForms::number, "of its surface along the normal, m", of(&Buoyancy::level)},
                   {"density", &ValueForms::not_negative, "kg/m^3", of(&Buoyancy::density)},
                   fields::part<Described>("drag", drag_table(), "of a body that is wholly under the surface",
                                           [](Described& described) -> Drag& { return as<Buoyancy>(described).drag; }),
                   {"flow", &ValueForms::vector, "its velocity, m/s", of(&Buoyancy::flow)}});
  return table;
}

fields::FormOf power_form() {
  return bounded("a power from -4 to 8", -4, false, 8);
}

const Table& attractor_table() {
  static const Table table(
      "an attractor",
      {{"body", &ValueForms::name, "node with a body, whose point it is; absent: the world", node(&Described::a)},
       {"at", &ValueForms::vector, "on that node or in the world, m", of(&Attractor::at)},
       {"acceleration", &ValueForms::number, "m/s^2 at 1 m", of(&Attractor::acceleration)},
       {"power", power_form(), "of the distance, with which it falls off", of(&Attractor::power)},
       {"softening", &ValueForms::not_negative, "m", of(&Attractor::softening)},
       {"by_mass", &ValueForms::boolean, "false: N in place of m/s^2", of(&Attractor::by_mass)}});
  return table;
}

const Table& vortex_table() {
  static const Table table(
      "a vortex",
      {{"at", &ValueForms::vector, "on its axis, m", of(&Vortex::at)},
       {"axis", &ValueForms::axis, "", axis_of_kind(&Vortex::axis)},
       {"acceleration", &ValueForms::number, "around it, m/s^2 at 1 m", of(&Vortex::acceleration)},
       {"inward", &ValueForms::number, "toward the axis, as a multiple of that around it", of(&Vortex::inward)},
       {"power", power_form(), "of the distance, with which it falls off", of(&Vortex::power)},
       {"softening", &ValueForms::not_negative, "m", of(&Vortex::softening)}});
  return table;
}

const Table& push_table() {
  const fields::Meaning<Described> at = {
      [](const json::Value& value, Described& described, Building&) { as<Push>(described).at = vector_of(value); }};
  const fields::Meaning<Described> axes = {[](const json::Value& value, Described& described, Building&) {
                                             as<Push>(described).turns = value.text() == "body";
                                           },
                                           "\"world\""};
  static const Table table("a push", {{"body", &ValueForms::name, "node with a body", node(&Described::a), true},
                                      {"force", &ValueForms::vector, "N", of(&Push::force)},
                                      {"torque", &ValueForms::vector, "N m, besides", of(&Push::torque)},
                                      {"at", &ValueForms::vector, "on the node, m; absent: at its center of mass", at},
                                      {"axes", words_of("axes", {"world", "body"}), "of both", axes}});
  return table;
}

template <class Kind>
fields::Row<Described> kind(std::string name, const Table& table, std::string help,
                            std::vector<std::string> elsewhere) {
  const auto read = [&table](const json::Value& value, Described& described, Building& building) {
    described.force = Kind{};
    table.read(value, described, building);
  };
  return {std::move(name), fields::form_of(table), std::move(help), {read}, false, {}, std::move(elsewhere)};
}

fields::Row<Described> drag() {
  const auto read = [](const json::Value& value, Described& described, Building& building) {
    described.force = Drag{};
    drag_table().read(value, as<Drag>(described), building);
  };
  return {"drag",
          fields::form_of(drag_table()),
          "of a medium at rest",
          {read},
          false,
          {},
          {"friction", "air_resistance", "damping"}};
}

}  // namespace

Rows kinds() {
  return {drag(),
          kind<Spring>("spring", spring_table(), "", {}),
          kind<Damper>("damper", damper_table(), "between two points", {"dashpot", "shock_absorber"}),
          kind<Wind>("wind", wind_table(), "a medium that moves", {"air", "breeze"}),
          kind<Buoyancy>("buoyancy", buoyancy_table(), "a liquid below a plane", {"water", "liquid", "fluid", "float"}),
          kind<Attractor>("attractor", attractor_table(), "draws toward a point",
                          {"gravity_well", "point_gravity", "magnet"}),
          kind<Vortex>("vortex", vortex_table(), "drives around an axis", {"swirl", "whirl", "tornado"}),
          field_row(),
          kind<Push>("push", push_table(), "a steady force and torque on one body",
                     {"force", "thrust", "thruster", "constant"})};
}

}  // namespace tweenfall::document::forces
