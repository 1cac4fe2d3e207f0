#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

ShapeRow plane() {
  fields::Meaning<Plane> normal = fields::member<Plane>(&Plane::normal);
  normal.read = [](const json::Value& value, Plane& plane, Building& building) {
    if (const std::optional<Vec3> unit = axis_of(value, building.problems)) plane.normal = *unit;
  };
  static const fields::Table<Plane> table(
      "a plane",
      {{"normal", &ValueForms::vector, "out of the solid", normal},
       {"offset", &ValueForms::number, "of the surface along the normal, m", fields::member<Plane>(&Plane::offset)}});
  return shape_of("plane", table);
}

}  // namespace tweenfall::document::shapes
