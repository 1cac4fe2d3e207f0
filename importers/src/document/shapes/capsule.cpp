#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

SolidRow capsule() {
  const fields::Meaning<Capsule> height = {
      [](const json::Value& value, Capsule& capsule, Building&) { capsule.half_height = value.number() / 2; }};
  static const fields::Table<Capsule> table(
      "a capsule",
      {{"radius", bounded("a radius in m, above 0", 0, true), "m", fields::member<Capsule>(&Capsule::radius), true},
       {"height", &ValueForms::not_negative, "of the cylinder between the balls, m; along y", height, true}});
  return shape_of("capsule", table);
}

}  // namespace tweenfall::document::shapes
