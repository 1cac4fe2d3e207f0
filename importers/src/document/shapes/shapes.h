#pragma once

// The shape of a body: each kind has a file of its own, with its word, its form and its reader.

#include <tweenfall/physics/shape.h>

#include "document/fields/table.h"

#include <optional>
#include <string>
#include <utility>

namespace tweenfall::document::shapes {

// A shape is a field of a body's "shape", which has exactly one. A shape fitted to a mesh also has a place on its node.
using ShapeRow = fields::Row<Shape>;

// A shape whose fields are those of a table; `solid_of` makes the solid from what was read, or reports why not.
template <class Thing, class SolidOf>
[[nodiscard]] ShapeRow shape_of(std::string word, std::string help, const fields::Table<Thing>& table,
                                SolidOf solid_of) {
  const auto read = [&table, solid_of](const json::Value& value, Shape& shape, Building& building) {
    Thing thing{};
    table.read(value, thing, building);
    if (std::optional<Solid> made = solid_of(value, thing, building)) shape.solid = std::move(*made);
  };
  return {std::move(word), fields::form_of(table), std::move(help), {read}};
}

// A shape whose table fills in the solid itself.
template <class Thing>
[[nodiscard]] ShapeRow shape_of(std::string word, const fields::Table<Thing>& table) {
  return shape_of(std::move(word), "", table, [](const json::Value&, const Thing& thing, Building&) { return thing; });
}

// A shape that can be a part of a compound
const Form* single_form(FormStore& store, const ValueForms& values);
[[nodiscard]] Shape read_single(const json::Value& shape, Building& building);

// Moves a shape by `place` from the document, relative to the place on the node that it may have already.
void put(Shape& shape, const Pose& place);

// A body's "shape"
const Form* form(FormStore& store, const ValueForms& values);
[[nodiscard]] Shape read(const json::Value& shape, Building& building);

}  // namespace tweenfall::document::shapes
