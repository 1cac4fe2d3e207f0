#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

ShapeRow cone() {
  const fields::Meaning<Cone> height = {
      [](const json::Value& value, Cone& cone, Building&) { cone.half_height = value.number() / 2; }};
  static const fields::Table<Cone> table("a cone", {{"radius", bounded("a radius in m, above 0", 0, true),
                                                     "of the base, m", fields::member<Cone>(&Cone::radius), true},
                                                    {"height", bounded("a height in m, above 0", 0, true),
                                                     "from base to tip, m; along y, the node midway", height, true}});
  return shape_of("cone", table);
}

}  // namespace tweenfall::document::shapes
