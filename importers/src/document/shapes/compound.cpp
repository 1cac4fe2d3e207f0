#include "document/shapes/points.h"

#include <vector>

namespace tweenfall::document::shapes {

namespace {

struct PartFields {
  Shape shape;
  Pose place;
};

const fields::Table<PartFields>& part_table() {
  using Part = PartFields;
  const fields::Meaning<Part> shape = {
      [](const json::Value& value, Part& part, Building& building) { part.shape = read_single(value, building); }};
  constexpr auto position = [](Part& part) -> Vec3& { return part.place.position; };
  constexpr auto rotation = [](Part& part) -> Quat& { return part.place.rotation; };
  static const fields::Table<Part> table("a part",
                                         {{"shape", single_form, "", shape, true},
                                          {"position", &ValueForms::vector, "m", fields::member<Part>(position)},
                                          {"rotation", &ValueForms::rotation, "", fields::member<Part>(rotation)}});
  return table;
}

struct CompoundFields {
  std::vector<Shape> parts;
};

const Form* parts_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(store.add(part_table().form(store, values)), "a list of parts", 1, Compound::most_parts));
}

}  // namespace

ShapeRow compound() {
  const fields::Meaning<CompoundFields> parts = {
      [](const json::Value& value, CompoundFields& compound, Building& building) {
        for (const json::Value& item : value.items()) {
          PartFields part;
          part_table().read(item, part, building);
          put(part.shape, part.place);
          compound.parts.push_back(part.shape);
        }
      }};
  static const fields::Table<CompoundFields> table(
      "a compound", {{"parts", parts_form, "each with its shape, position and rotation", parts, true}});
  return shape_of(
      "compound", "several shapes that move as one", table,
      [](const json::Value& place, const CompoundFields& given, Building& building) -> std::optional<Solid> {
        if (given.parts.empty()) return std::nullopt;
        return solid_or_problem(place, building.problems, [&]() -> Solid { return Compound(given.parts); });
      });
}

}  // namespace tweenfall::document::shapes
