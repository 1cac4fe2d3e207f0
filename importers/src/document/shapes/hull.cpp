#include "document/shapes/points.h"

#include <span>

namespace tweenfall::document::shapes {

namespace {

struct HullFields {
  json::Value place;
  std::vector<Vec3> points;
};

const Form* hull_points_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.vector, "a list of at least 4 points", 4, 4096));
}

}  // namespace

SolidRow hull() {
  const fields::Meaning<HullFields> points = {[](const json::Value& value, HullFields& hull, Building&) {
    hull.place = value;
    hull.points = points_3(value);
  }};
  static const fields::Table<HullFields> table("a hull", {{"points", hull_points_form, "m", points, true}});
  return shape_of("hull", "the smallest convex solid around points", table,
                  [](const json::Value&, const HullFields& hull, Building& building) -> std::optional<Solid> {
                    if (hull.points.empty()) return std::nullopt;
                    return hull_or_problem(hull.place, building.problems,
                                           [&] { return std::span<const Vec3>(hull.points); });
                  });
}

}  // namespace tweenfall::document::shapes
