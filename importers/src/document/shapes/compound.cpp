#include "document/shapes/points.h"

#include <vector>

namespace tweenfall::document::shapes {

namespace {

const fields::Table<Shape>& part_table() {
  const fields::Meaning<Shape> shape = {
      [](const json::Value& value, Shape& part, Building& building) { part.solid = read_single(value, building); }};
  constexpr auto position = [](Shape& part) -> Vec3& { return part.offset.position; };
  constexpr auto rotation = [](Shape& part) -> Quat& { return part.offset.rotation; };
  static const fields::Table<Shape> table("a part",
                                          {{"shape", single_form, "", shape, true},
                                           {"position", &ValueForms::vector, "m", fields::member<Shape>(position)},
                                           {"rotation", &ValueForms::rotation, "", fields::member<Shape>(rotation)}});
  return table;
}

struct CompoundFields {
  std::vector<Shape> parts;
};

const Form* parts_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(store.add(part_table().form(store, values)), "a list of parts", 1, Compound::most_parts));
}

}  // namespace

SolidRow compound() {
  const fields::Meaning<CompoundFields> parts = {
      [](const json::Value& value, CompoundFields& compound, Building& building) {
        for (const json::Value& item : value.items()) {
          Shape part;
          part_table().read(item, part, building);
          compound.parts.push_back(part);
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
