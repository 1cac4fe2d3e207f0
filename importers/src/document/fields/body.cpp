#include <tweenfall/physics/strategies.h>

#include <algorithm>
#include <utility>

#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/report/foreign_words.h"
#include "document/report/suggestion.h"
#include "document/shapes/shapes.h"

namespace tweenfall::document::fields {

namespace {

using Body = BodyDescription;

const Table<Pose>& offset_table() {
  static const Table<Pose> table("an offset", {{"position", &ValueForms::vector, "m", member<Pose>(&Pose::position)},
                                               {"rotation", &ValueForms::rotation, "", member<Pose>(&Pose::rotation)}});
  return table;
}

std::string while_static(const Body& body) {
  return body.fixed ? "for a static body; leave it or \"static\" out" : "";
}

Row<Body> combine_rule(std::string name, std::string help, Combine Body::*member_of_body) {
  return one_of<Body, Combine>(std::move(name), "a rule to combine",
                               {{"geometric-mean", Combine::geometric_mean},
                                {"average", Combine::average},
                                {"minimum", Combine::minimum},
                                {"multiply", Combine::multiply},
                                {"maximum", Combine::maximum}},
                               std::move(help), member_of_body);
}

// The bits of groups by their names, which all files of one reading share.
std::uint64_t bits_of(const json::Value& list, Building& building) {
  constexpr std::size_t most = 64;
  std::vector<std::string>& groups = building.reading.groups;
  std::uint64_t bits = 0;
  for (const json::Value& name : list.items()) {
    const auto found = std::ranges::find(groups, name.text());
    const auto bit = static_cast<std::size_t>(found - groups.begin());
    if (bit == most) {
      building.problems.add(name, "there can be 63 groups of bodies beside \"default\", and this is one more");
      return bits;
    }
    if (found == groups.end()) groups.emplace_back(name.text());
    bits |= std::uint64_t{1} << bit;
  }
  return bits;
}

Row<Body> collision_row() {
  Row<Body> row = one_of<Body, Detection>(
      "collision", "a way to find that bodies meet", detection_words(),
      "when it is found to meet others; absent: as they say, or else the world. Of two that differ the more careful",
      &Body::collision);
  row.useless = [](const Body& body) {
    return body.sensor ? "for a sensor; it notices what overlaps it at the end of a step" : "";
  };
  return row;
}

const Table<Body>& body_table() {
  constexpr auto velocity = [](Body& body) -> Vec3& { return body.twist.linear; };
  constexpr auto spin = [](Body& body) -> Vec3& { return body.twist.angular; };
  const Meaning<Body> shape = {
      [](const json::Value& value, Body& body, Building& building) { body.shape = shapes::read(value, building); }};
  // A shape fitted to a mesh has the place of the mesh, and is moved relative to that.
  const Meaning<Body> offset = {[](const json::Value& value, Body& body, Building& building) {
                                  Pose place;
                                  offset_table().read(value, place, building);
                                  shapes::put(body.shape, place);
                                },
                                "{}"};
  constexpr auto surface = [](Body& body) -> Vec3& { return body.surface_velocity.linear; };
  constexpr auto surface_spin = [](Body& body) -> Vec3& { return body.surface_velocity.angular; };
  const Meaning<Body> groups = {
      [](const json::Value& value, Body& body, Building& building) { body.groups = read_groups(value, building); },
      "[\"default\"]"};
  const Meaning<Body> collides_with = {[](const json::Value& value, Body& body, Building& building) {
    body.collides_with = read_collides_with(value, building);
  }};
  const Meaning<Body> drive = {
      [](const json::Value& value, Body& body, Building& building) { body.drive = read_owner(value, building); }};
  static const Table<Body> table(
      "a body",
      {{"shape", shapes::form, "", shape, true, {}, {"collider", "collision_shape"}},
       {"offset", form_of(offset_table()), "of the shape on its node", offset},
       {"mass", bounded("a mass in kg, above 0", 0, true), "kg", member<Body>(&Body::mass), false, while_static},
       {"density",
        density_form,
        "kg/m^3, or an expression of x, y and z, m on the node",
        {read_density, text_of_default(Body{}.density)},
        false,
        while_static},
       {"mass_properties",
        mass_properties_form,
        "instead of those of an even solid",
        {read_mass_properties},
        false,
        while_static},
       {"friction", &ValueForms::not_negative, "a pair takes sqrt(f1 f2)", member<Body>(&Body::friction)},
       {"restitution",
        bounded("a restitution from 0 to 1", 0, false, 1),
        "a pair takes the larger",
        member<Body>(&Body::restitution),
        false,
        {},
        {"bounciness", "elasticity", "bounce"}},
       combine_rule("friction_combine", "of two bodies' rules the one later in this list holds",
                    &Body::friction_combine),
       combine_rule("restitution_combine", "likewise", &Body::restitution_combine),
       {"rolling_friction", &ValueForms::not_negative, "m", member<Body>(&Body::rolling_friction)},
       {"spinning_friction", &ValueForms::not_negative, "m", member<Body>(&Body::spinning_friction)},
       {"surface_velocity", &ValueForms::vector, "of a belt against its body, in the node's axes, m/s",
        member<Body>(surface)},
       {"surface_angular_velocity", &ValueForms::vector, "in the node's axes, degrees/s", turning<Body>(surface_spin)},
       {"sensor",
        &ValueForms::boolean,
        "notices what overlaps it, and neither pushes nor is pushed",
        member<Body>(&Body::sensor),
        false,
        {},
        {"trigger", "istrigger", "is_trigger"}},
       collision_row(),
       {"groups", groups_form, "that it belongs to", groups},
       {"collides_with", groups_form, "groups; absent: all. Two bodies meet when each names one of the other's",
        collides_with},
       {"linear_damping",
        &ValueForms::not_negative,
        "1/s",
        member<Body>(&Body::linear_damping),
        false,
        {},
        {"drag", "lineardrag", "damping"}},
       {"angular_damping",
        &ValueForms::not_negative,
        "1/s",
        member<Body>(&Body::angular_damping),
        false,
        {},
        {"angulardrag"}},
       {"static",
        &ValueForms::boolean,
        "scenery that never moves",
        member<Body>(&Body::fixed),
        false,
        {},
        {"fixed", "is_static"}},
       {"drive",
        owner_form,
        "absent: keyed where a playing clip animates the node, else free",
        drive,
        false,
        while_static,
        {"kinematic", "iskinematic", "type", "bodytype"}},
       {"velocity", &ValueForms::vector, "at the start, of the center of mass, m/s", member<Body>(velocity), false,
        while_static},
       {"angular_velocity",
        &ValueForms::vector,
        "at the start, degrees/s",
        turning<Body>(spin),
        false,
        while_static,
        {"spin"}}});
  return table;
}

}  // namespace

const Form* body_form(FormStore& store, const ValueForms& values) {
  Form form = body_table().form(store, values);
  form.together = {at_most_one({"mass", "density", "mass_properties"})};
  form.definition = "body";
  form.said_of = said_of_field_of_body;
  return store.add(std::move(form));
}

const Form* groups_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.name, "a list of names of groups", 0));
}

std::uint64_t read_groups(const json::Value& groups, Building& building) {
  const std::uint64_t bits = bits_of(groups, building);
  building.reading.given_groups |= bits;
  return bits;
}

std::uint64_t read_collides_with(const json::Value& groups, Building& building) {
  for (const json::Value& name : groups.items()) building.asked_groups.push_back(name);
  return bits_of(groups, building);
}

void check_groups(Building& building) {
  // A group named by an imported file may be defined in the file that imports it.
  if (!building.reading.is_outermost() || !building.failed_imports.empty()) return;
  const std::vector<std::string>& groups = building.reading.groups;
  std::vector<std::string> given;
  for (std::size_t i = 0; i < groups.size(); ++i)
    if ((building.reading.given_groups >> i & 1) != 0) given.push_back(groups[i]);
  for (const json::Value& name : building.asked_groups)
    if (std::ranges::find(given, name.text()) == given.end())
      building.problems.add(
          name, "no body belongs to a group " + json::in_quotes(name.text()) + suggestion(name.text(), given));
}

json::Value place_of_drive(const json::Value& body) {
  return below(body, {"drive"});
}

json::Value place_of_spin(const json::Value& body) {
  return below(body, {"angular_velocity"});
}

BodyDescription read_body(const json::Value& value, Building& building) {
  Body body;
  body_table().read(value, body, building);
  const json::Value shape = usable(value, "shape");
  const bool led = body.drive ? body.drive->owner() == Owner::keyed : !std::holds_alternative<Plane>(body.shape.solid);
  if (shape && is_scenery(body.shape.solid) && !body.fixed && !led)
    building.problems.add(
        shape, std::string(kind_name(body.shape.solid)) + " has no mass, so it cannot move; say \"static\": true");
  return body;
}

}  // namespace tweenfall::document::fields
