#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

ShapeRow cylinder() {
  const fields::Meaning<Cylinder> height = {
      [](const json::Value& value, Cylinder& cylinder, Building&) { cylinder.half_height = value.number() / 2; }};
  static const fields::Table<Cylinder> table(
      "a cylinder",
      {{"radius", bounded("a radius in m, above 0", 0, true), "m", fields::member<Cylinder>(&Cylinder::radius), true},
       {"height", bounded("a height in m, above 0", 0, true), "from end to end, m; along y", height, true}});
  return shape_of("cylinder", table);
}

}  // namespace tweenfall::document::shapes
