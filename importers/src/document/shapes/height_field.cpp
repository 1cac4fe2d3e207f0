#include "document/shapes/points.h"

namespace tweenfall::document::shapes {

namespace {

struct FieldOfHeights {
  std::size_t columns = 0;
  std::vector<double> heights;
  double spacing_x = 1, spacing_z = 1;
};

const Form* heights_form(FormStore& store, const ValueForms& values) {
  const Form* row = store.add(list_of(values.number, "a row of at least 2 heights in m, along x", 2, 4096));
  return store.add(list_of(row, "a list of at least 2 rows, along z", 2, 4096));
}

const Form* spacing_form(FormStore& store, const ValueForms&) {
  const Form* one = store.add(bounded("a spacing in m, above 0", 0, true));
  Form form;
  form.kind = Form::Kind::choice;
  form.what = "a spacing in m, or two: along x and along z";
  form.alternatives = {one, store.add(list_of(one, "two spacings in m: along x and along z", 2, 2))};
  return store.add(std::move(form));
}

}  // namespace

ShapeRow height_field() {
  using Fields = FieldOfHeights;
  const fields::Meaning<Fields> heights = {[](const json::Value& value, Fields& field, Building& building) {
    for (const json::Value& row : value.items()) {
      if (!row.is(json::Value::Kind::list)) continue;
      if (field.columns == 0) field.columns = row.items().size();
      if (row.items().size() != field.columns) {
        building.problems.add(row, "this row has " + std::to_string(row.items().size()) +
                                       " heights, and the first one has " + std::to_string(field.columns));
        field.columns = 0;
        return;
      }
      for (const json::Value& height : row.items()) field.heights.push_back(height.number());
    }
  }};
  const fields::Meaning<Fields> spacing = {[](const json::Value& value, Fields& field, Building&) {
    const bool two = value.is(json::Value::Kind::list) && value.items().size() == 2;
    field.spacing_x = two ? value.items()[0].number() : value.number();
    field.spacing_z = two ? value.items()[1].number() : value.number();
  }};
  static const fields::Table<Fields> table(
      "a height field", {{"heights", heights_form, "m; its middle is over the node", heights, true},
                         {"spacing", spacing_form, "from one height to the next, m", spacing, true}});
  return shape_of("height_field", "a ground over an even grid; scenery alone", table,
                  [](const json::Value& place, const Fields& given, Building& building) -> std::optional<Solid> {
                    if (given.columns == 0) return std::nullopt;
                    return solid_or_problem(place, building.problems, [&]() -> Solid {
                      return HeightField(given.columns, given.heights, given.spacing_x, given.spacing_z);
                    });
                  });
}

}  // namespace tweenfall::document::shapes
