#include "document/shapes/shapes.h"

#include <utility>

// Every shape there is: the functions in the files of these names. A mesh or a height field is no part of a compound.
#define TWEENFALL_SINGLE_SHAPES(one)                                                                             \
  one(sphere) one(box) one(capsule) one(tapered_capsule) one(cylinder) one(cone) one(plane) one(hull) one(lathe) \
      one(sweep)
#define TWEENFALL_SHAPES(one) TWEENFALL_SINGLE_SHAPES(one) one(compound) one(mesh) one(height_field)

namespace tweenfall::document::shapes {

#define TWEENFALL_SHAPE_DECLARED(name) SolidRow name();
TWEENFALL_SHAPES(TWEENFALL_SHAPE_DECLARED)
#undef TWEENFALL_SHAPE_DECLARED

namespace {

const fields::Table<Solid>& shape_table() {
#define TWEENFALL_SHAPE_LISTED(name) name(),
  static const fields::Table<Solid> table("a shape", {TWEENFALL_SHAPES(TWEENFALL_SHAPE_LISTED)});
  return table;
}

const fields::Table<Solid>& single_shape_table() {
  static const fields::Table<Solid> table("a shape", {TWEENFALL_SINGLE_SHAPES(TWEENFALL_SHAPE_LISTED)});
#undef TWEENFALL_SHAPE_LISTED
  return table;
}

}  // namespace

const Form* single_form(FormStore& store, const ValueForms& values) {
  Form form = single_shape_table().choosing_form(store, values);
  form.definition = "single_shape";
  return store.add(std::move(form));
}

Solid read_single(const json::Value& shape, Building& building) {
  Solid solid;
  single_shape_table().read(shape, solid, building);
  return solid;
}

const Form* form(FormStore& store, const ValueForms& values) {
  Form form = shape_table().choosing_form(store, values);
  form.definition = "shape";
  return store.add(std::move(form));
}

Solid read(const json::Value& shape, Building& building) {
  Solid solid;
  shape_table().read(shape, solid, building);
  return solid;
}

}  // namespace tweenfall::document::shapes
