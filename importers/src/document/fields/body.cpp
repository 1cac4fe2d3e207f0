#include "document/fields/table.h"
#include "document/fields/things.h"
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

const Table<Body>& body_table() {
  constexpr auto offset = [](Body& body) -> Pose& { return body.shape.offset; };
  constexpr auto velocity = [](Body& body) -> Vec3& { return body.twist.linear; };
  constexpr auto spin = [](Body& body) -> Vec3& { return body.twist.angular; };
  const Meaning<Body> shape = {[](const json::Value& value, Body& body, Building& building) {
    body.shape.solid = shapes::read(value, building);
  }};
  const Meaning<Body> drive = {
      [](const json::Value& value, Body& body, Building& building) { body.drive = read_owner(value, building); }};
  static const Table<Body> table(
      "a body",
      {{"shape", shapes::form, "", shape, true},
       part<Body>("offset", offset_table(), "of the shape on its node", offset),
       {"mass", bounded("a mass in kg, above 0", 0, true), "kg", member<Body>(&Body::mass), false, while_static},
       {"density", bounded("a density in kg/m^3, above 0", 0, true), "kg/m^3", member<Body>(&Body::density), false,
        while_static},
       {"friction", &ValueForms::not_negative, "a pair takes sqrt(f1 f2)", member<Body>(&Body::friction)},
       {"restitution",
        bounded("a restitution from 0 to 1", 0, false, 1),
        "a pair takes the larger",
        member<Body>(&Body::restitution),
        false,
        {},
        {"bounciness", "elasticity"}},
       {"rolling_friction", &ValueForms::not_negative, "m", member<Body>(&Body::rolling_friction)},
       {"linear_damping", &ValueForms::not_negative, "1/s", member<Body>(&Body::linear_damping)},
       {"angular_damping", &ValueForms::not_negative, "1/s", member<Body>(&Body::angular_damping)},
       {"static",
        &ValueForms::boolean,
        "scenery that never moves",
        member<Body>(&Body::fixed),
        false,
        {},
        {"fixed", "is_static"}},
       {"drive", owner_form, "absent: keyed where a playing clip animates the node, else free", drive, false,
        while_static},
       {"velocity", &ValueForms::vector, "at the start, of the center of mass, m/s", member<Body>(velocity), false,
        while_static},
       {"angular_velocity", &ValueForms::vector, "at the start, degrees/s", turning<Body>(spin), false, while_static}});
  return table;
}

}  // namespace

const Form* body_form(FormStore& store, const ValueForms& values) {
  Form form = body_table().form(store, values);
  form.together = {at_most_one({"mass", "density"})};
  form.definition = "body";
  return store.add(std::move(form));
}

json::Value place_of_spin(const json::Value& body) {
  return below(body, {"angular_velocity"});
}

BodyDescription read_body(const json::Value& value, Building& building) {
  Body body;
  body_table().read(value, body, building);
  const json::Value shape = usable(value, "shape");
  if (shape && std::holds_alternative<Plane>(body.shape.solid) && !body.fixed)
    building.problems.add(shape, "a plane has no mass, so it cannot move; say \"static\": true");
  return body;
}

}  // namespace tweenfall::document::fields
