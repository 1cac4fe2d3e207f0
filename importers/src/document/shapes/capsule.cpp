#include <tweenfall/physics/fitted_shapes.h>

#include "document/shapes/fitted.h"

namespace tweenfall::document::shapes {

namespace {

const fields::Table<FittedFields<Capsule>>& capsule_table() {
  static const fields::Table<FittedFields<Capsule>> table(
      "a capsule", {{"radius", bounded("a radius in m, above 0", 0, true), "m",
                     of_solid<Capsule>([](const json::Value& value, Capsule& capsule, Building&) {
                       capsule.radius = value.number();
                     })},
                    {"height", &ValueForms::not_negative, "of the cylinder between the balls, m; along y",
                     of_solid<Capsule>([](const json::Value& value, Capsule& capsule, Building&) {
                       capsule.half_height = value.number() / 2;
                     })},
                    mesh_row<Capsule>()});
  return table;
}

const Form* capsule_form(FormStore& store, const ValueForms& values) {
  Form form = capsule_table().listing_form(store, values);
  form.together = {exactly_one({"radius", "mesh"}),
                   {Together::Rule::first_needs_second, {"radius", "height"}},
                   {Together::Rule::first_needs_second, {"height", "radius"}}};
  return store.add(std::move(form));
}

}  // namespace

ShapeRow capsule() {
  return fitted_or_sized<Capsule>("capsule", "of a radius and a height, or the smallest around nearly all of a mesh",
                                  capsule_table(), fields::FormOf::Make(capsule_form),
                                  [](std::span<const Vec3> points) { return capsule_around(points); });
}

}  // namespace tweenfall::document::shapes
