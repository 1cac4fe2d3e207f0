#include "document/shapes/points.h"

namespace tweenfall::document::shapes {

namespace {

template <class Turned>
fields::Meaning<Turned> whole_height() {
  return {[](const json::Value& value, Turned& turned, Building&) { turned.half_height = value.number() / 2; }};
}

template <class Turned>
fields::Table<Turned> rim_and_height(const char* what, const char* radius, const char* height) {
  return {
      what,
      {{"radius", bounded("a radius in m, above 0", 0, true), radius, fields::member<Turned>(&Turned::radius), true},
       {"height", bounded("a height in m, above 0", 0, true), height, whole_height<Turned>(), true}}};
}

}  // namespace

SolidRow cylinder() {
  static const fields::Table<Cylinder> table =
      rim_and_height<Cylinder>("a cylinder", "m", "from end to end, m; along y");
  return shape_of("cylinder", table);
}

SolidRow cone() {
  static const fields::Table<Cone> table =
      rim_and_height<Cone>("a cone", "of the base, m", "from base to tip, m; along y, the node midway");
  return shape_of("cone", table);
}

SolidRow tapered_capsule() {
  using Fields = TaperedCapsule;
  static const fields::Table<Fields> table(
      "a tapered capsule", {{"bottom_radius", bounded("a radius in m, above 0", 0, true), "of the ball at -y, m",
                             fields::member<Fields>(&Fields::bottom_radius), true},
                            {"top_radius", bounded("a radius in m, above 0", 0, true), "of the ball at +y, m",
                             fields::member<Fields>(&Fields::top_radius), true},
                            {"height", bounded("a height in m, above 0", 0, true),
                             "between the centers of the balls, m; along y", whole_height<Fields>(), true}});
  return shape_of("tapered_capsule", "all that lies between two balls", table,
                  [](const json::Value& place, const Fields& given, Building& building) -> std::optional<Solid> {
                    return solid_or_problem(place, building.problems, [&]() -> Solid {
                      validate(given);
                      return given;
                    });
                  });
}

}  // namespace tweenfall::document::shapes
