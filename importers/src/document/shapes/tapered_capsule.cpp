#include "document/shapes/points.h"

namespace tweenfall::document::shapes {

ShapeRow tapered_capsule() {
  using Fields = TaperedCapsule;
  const fields::Meaning<Fields> height = {
      [](const json::Value& value, Fields& capsule, Building&) { capsule.half_height = value.number() / 2; }};
  static const fields::Table<Fields> table(
      "a tapered capsule", {{"bottom_radius", bounded("a radius in m, above 0", 0, true), "of the ball at -y, m",
                             fields::member<Fields>(&Fields::bottom_radius), true},
                            {"top_radius", bounded("a radius in m, above 0", 0, true), "of the ball at +y, m",
                             fields::member<Fields>(&Fields::top_radius), true},
                            {"height", bounded("a height in m, above 0", 0, true),
                             "between the centers of the balls, m; along y", height, true}});
  return shape_of("tapered_capsule", "all that lies between two balls", table,
                  [](const json::Value& place, const Fields& given, Building& building) -> std::optional<Solid> {
                    return solid_or_problem(place, building.problems, [&]() -> Solid {
                      validate(given);
                      return given;
                    });
                  });
}

}  // namespace tweenfall::document::shapes
