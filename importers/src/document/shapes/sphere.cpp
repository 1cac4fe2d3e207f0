#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

ShapeRow sphere() {
  static const fields::Table<Sphere> table("a sphere", {{"radius", bounded("a radius in m, above 0", 0, true), "m",
                                                         fields::member<Sphere>(&Sphere::radius), true}});
  ShapeRow row = shape_of("sphere", table);
  row.elsewhere = {"ball"};
  return row;
}

}  // namespace tweenfall::document::shapes
