#pragma once

// The shape of a body: each kind in a file of its own, which holds its word, its form and its reader.

#include <tweenfall/physics/shape.h>

#include "document/fields/table.h"

#include <optional>
#include <string>
#include <utility>

namespace tweenfall::document::shapes {

// A shape is a field of a body's "shape", of which one is given.
using SolidRow = fields::Row<Solid>;

// A shape whose fields are those of a table; `solid_of` makes the solid of what was read, or notes why there is none.
template <class Thing, class SolidOf>
[[nodiscard]] SolidRow shape_of(std::string word, std::string help, const fields::Table<Thing>& table,
                                SolidOf solid_of) {
  const auto read = [&table, solid_of](const json::Value& value, Solid& solid, Building& building) {
    Thing thing{};
    table.read(value, thing, building);
    if (std::optional<Solid> made = solid_of(value, thing, building)) solid = std::move(*made);
  };
  return {std::move(word), fields::form_of(table), std::move(help), {read}};
}

// A shape whose table fills in the solid itself.
template <class Thing>
[[nodiscard]] SolidRow shape_of(std::string word, const fields::Table<Thing>& table) {
  return shape_of(std::move(word), "", table, [](const json::Value&, const Thing& thing, Building&) { return thing; });
}

// A shape that can be a part of a compound
const Form* single_form(FormStore& store, const ValueForms& values);
[[nodiscard]] Solid read_single(const json::Value& shape, Building& building);

// A body's "shape"
const Form* form(FormStore& store, const ValueForms& values);
[[nodiscard]] Solid read(const json::Value& shape, Building& building);

}  // namespace tweenfall::document::shapes
