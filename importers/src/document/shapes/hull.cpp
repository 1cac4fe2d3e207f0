#include <tweenfall/physics/fitted_shapes.h>

#include "document/shapes/mesh_named.h"
#include "document/shapes/points.h"

#include <span>
#include <utility>

namespace tweenfall::document::shapes {

namespace {

struct HullFields {
  json::Value place;
  std::vector<Vec3> points;
};

const Form* hull_points_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.vector, "a list of at least 4 points", 4, 4096));
}

const fields::Table<HullFields>& hull_table() {
  const fields::Meaning<HullFields> points = {[](const json::Value& value, HullFields& hull, Building&) {
    hull.place = value;
    hull.points = points_3(value);
  }};
  const fields::Meaning<HullFields> mesh = {[](const json::Value& value, HullFields& hull, Building& building) {
    hull.place = value;
    if (std::optional<SurfaceMesh> named = mesh_named(value, building)) hull.points = std::move(named->positions);
  }};
  static const fields::Table<HullFields> table(
      "a hull",
      {{"points", hull_points_form, "m", points}, {"mesh", &ValueForms::name, "of an imported node or file", mesh}});
  return table;
}

const Form* hull_form(FormStore& store, const ValueForms& values) {
  return store.add(hull_table().choosing_form(store, values));
}

}  // namespace

ShapeRow hull() {
  const auto read = [](const json::Value& value, Shape& shape, Building& building) {
    HullFields given;
    hull_table().read(value, given, building);
    if (given.points.empty()) return;
    std::optional<Solid> made =
        hull_or_problem(given.place, building.problems, [&] { return hull_around(given.points); });
    if (made) shape.solid = std::move(*made);
  };
  return {"hull", fields::FormOf::Make(hull_form), "the smallest convex solid around points or a mesh", {read}, false,
          {},     {"convex", "convex_hull"}};
}

}  // namespace tweenfall::document::shapes
