#include "document/shapes/shapes.h"

#include <utility>

// All shapes: the functions in the files of these names. A mesh or a height field cannot be a part of a compound.
#define TWEENFALL_SINGLE_SHAPES(one)                                                                             \
  one(sphere) one(box) one(capsule) one(tapered_capsule) one(cylinder) one(cone) one(plane) one(hull) one(lathe) \
      one(sweep)
#define TWEENFALL_SHAPES(one) TWEENFALL_SINGLE_SHAPES(one) one(compound) one(mesh) one(height_field)

namespace tweenfall::document::shapes {

#define TWEENFALL_SHAPE_DECLARED(name) ShapeRow name();
TWEENFALL_SHAPES(TWEENFALL_SHAPE_DECLARED)
#undef TWEENFALL_SHAPE_DECLARED

namespace {

const fields::Table<Shape>& shape_table() {
#define TWEENFALL_SHAPE_LISTED(name) name(),
  static const fields::Table<Shape> table("a shape", {TWEENFALL_SHAPES(TWEENFALL_SHAPE_LISTED)});
  return table;
}

const fields::Table<Shape>& single_shape_table() {
  static const fields::Table<Shape> table("a shape", {TWEENFALL_SINGLE_SHAPES(TWEENFALL_SHAPE_LISTED)});
#undef TWEENFALL_SHAPE_LISTED
  return table;
}

}  // namespace

const Form* single_form(FormStore& store, const ValueForms& values) {
  Form form = single_shape_table().choosing_form(store, values);
  form.definition = "single_shape";
  return store.add(std::move(form));
}

Shape read_single(const json::Value& shape, Building& building) {
  Shape read;
  single_shape_table().read(shape, read, building);
  return read;
}

const Form* form(FormStore& store, const ValueForms& values) {
  Form form = shape_table().choosing_form(store, values);
  form.definition = "shape";
  return store.add(std::move(form));
}

Shape read(const json::Value& shape, Building& building) {
  Shape read;
  shape_table().read(shape, read, building);
  return read;
}

void put(Shape& shape, const Pose& place) {
  shape.offset.position = place.position + place.rotation * shape.offset.position;
  shape.offset.rotation = place.rotation * shape.offset.rotation;
}

}  // namespace tweenfall::document::shapes
