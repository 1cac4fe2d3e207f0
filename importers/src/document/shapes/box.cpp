#include "document/shapes/shapes.h"

namespace tweenfall::document::shapes {

namespace {

const Form* sizes_form(FormStore& store, const ValueForms&) {
  const Form* size = store.add(bounded("a size in m, above 0", 0, true));
  return store.add(list_of(size, "a list of 3 sizes in m, from face to face", 3, 3));
}

}  // namespace

SolidRow box() {
  const fields::Meaning<Box> sizes = {[](const json::Value& value, Box& box, Building&) {
    if (const std::optional<Vec3> size = vector_of(value)) box.half_extents = *size / 2;
  }};
  static const fields::Table<Box> table("a box", {{"size", sizes_form, "from face to face, m", sizes, true}});
  return shape_of("box", table);
}

}  // namespace tweenfall::document::shapes
