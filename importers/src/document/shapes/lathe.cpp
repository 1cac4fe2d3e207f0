#include "document/shapes/points.h"

#include <tweenfall/curves/sweep.h>

namespace tweenfall::document::shapes {

namespace {

struct LatheFields {
  json::Value place;
  std::vector<Vec2> profile;
  int sides = 24;
};

const Form* turned_profile_form(FormStore& store, const ValueForms& values) {
  Form point;
  point.kind = Form::Kind::tuple;
  point.what = "a point: [radius, y], the radius at least 0";
  point.parts = {values.not_negative, values.number};
  point.fewest = 2;
  point.on_one_line = true;
  return store.add(list_of(store.add(point), "a list of at least 2 points", 2, 256));
}

}  // namespace

ShapeRow lathe() {
  const fields::Meaning<LatheFields> profile = {[](const json::Value& value, LatheFields& lathe, Building&) {
    lathe.place = value;
    lathe.profile = points_2(value);
  }};
  static const fields::Table<LatheFields> table(
      "a lathe", {{"profile", turned_profile_form, "[radius, y], m", profile, true},
                  {"sides", bounded("a whole number from 3 to 64", 3, false, 64, true), "flat sides around the axis",
                   fields::member<LatheFields>(&LatheFields::sides)}});
  return shape_of("lathe", "the convex hull of a profile turned about y", table,
                  [](const json::Value&, const LatheFields& given, Building& building) -> std::optional<Solid> {
                    if (given.profile.size() < 2) return std::nullopt;
                    return hull_or_problem(given.place, building.problems, [&] {
                      return tweenfall::lathe(polyline(given.profile),
                                              {.segments = given.sides, .profile_steps = 1, .caps = false});
                    });
                  });
}

}  // namespace tweenfall::document::shapes
