#include "document/shapes/points.h"

#include <tweenfall/curves/sweep.h>

namespace tweenfall::document::shapes {

namespace {

struct SweepFields {
  std::vector<Vec2> profile;
  std::vector<Vec3> rail;
  std::optional<Vec3> normal;
};

const Form* swept_profile_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.vector_2, "a list of at least 2 points", 2, 256));
}

const Form* rail_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.vector, "a list of at least 2 points", 2, 256));
}

}  // namespace

ShapeRow sweep() {
  using Fields = SweepFields;
  const fields::Meaning<Fields> profile = {
      [](const json::Value& value, Fields& sweep, Building&) { sweep.profile = points_2(value); }};
  const fields::Meaning<Fields> rail = {
      [](const json::Value& value, Fields& sweep, Building&) { sweep.rail = points_3(value); }};
  const fields::Meaning<Fields> normal = {
      [](const json::Value& value, Fields& sweep, Building&) { sweep.normal = vector_of(value); }};
  static const fields::Table<Fields> table(
      "a sweep",
      {{"profile", swept_profile_form, "[x, y], m", profile, true},
       {"rail", rail_form, "m", rail, true},
       {"normal", &ValueForms::vector, "where the profile's x points at the rail's start; absent: any", normal}});
  return shape_of("sweep", "the convex hull of a profile carried along a rail", table,
                  [](const json::Value& place, const Fields& given, Building& building) -> std::optional<Solid> {
                    if (given.profile.size() < 2 || given.rail.size() < 2) return std::nullopt;
                    SweepOptions options{.rail_steps = 1, .profile_steps = 1, .caps = false};
                    options.normal = given.normal;
                    return hull_or_problem(place, building.problems, [&] {
                      return tweenfall::sweep(polyline(given.profile), polyline(given.rail), options);
                    });
                  });
}

}  // namespace tweenfall::document::shapes
