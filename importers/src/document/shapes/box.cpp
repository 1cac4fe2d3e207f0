#include <tweenfall/physics/fitted_shapes.h>

#include "document/report/spellings.h"
#include "document/shapes/fitted.h"

namespace tweenfall::document::shapes {

namespace {

const Form* sizes_form(FormStore& store, const ValueForms&) {
  const Form* size = store.add(bounded("a size in m, above 0", 0, true));
  Form sizes = list_of(size, "a list of 3 sizes in m, from face to face", 3, 3);
  sizes.instead = list_of_equal;
  return store.add(std::move(sizes));
}

const fields::Table<FittedFields<Box>>& box_table() {
  static const fields::Table<FittedFields<Box>> table(
      "a box",
      {{"size", sizes_form, "from face to face, m", of_solid<Box>([](const json::Value& value, Box& box, Building&) {
          if (const std::optional<Vec3> size = vector_of(value)) box.half_extents = *size / 2;
        })},
       mesh_row<Box>()});
  return table;
}

const Form* box_form(FormStore& store, const ValueForms& values) {
  return store.add(box_table().choosing_form(store, values));
}

}  // namespace

ShapeRow box() {
  ShapeRow row = fitted_or_sized<Box>("box", "of a size, or the smallest around a mesh, where that is", box_table(),
                                      fields::FormOf::Make(box_form), box_around);
  row.elsewhere = {"cube", "cuboid"};
  return row;
}

}  // namespace tweenfall::document::shapes
