#pragma once

// The shape of a body: one kind of solid in one file, which holds its word, its form and its reader.

#include <tweenfall/physics/shape.h>

#include "document/fields/table.h"

#include <functional>
#include <optional>
#include <string>

namespace tweenfall::document::shapes {

struct SolidKind {
  std::string word;
  std::string help;
  fields::FormOf form;
  // Nothing where the solid cannot be made, which then is noted.
  std::function<std::optional<Solid>(const JsonValue&, Building&)> read;
};

// A kind whose fields are those of a table; `solid_of` makes the solid of what was read.
template <class Thing, class SolidOf>
[[nodiscard]] SolidKind kind_of(std::string word, std::string help, const fields::Table<Thing>& table,
                                SolidOf solid_of) {
  const auto form = [&table](FormStore& store, const ValueForms& values) {
    return store.add(table.listing_form(store, values));
  };
  const auto read = [&table, solid_of](const JsonValue& value, Building& building) -> std::optional<Solid> {
    Thing thing{};
    table.read(value, thing, building);
    return solid_of(value, thing, building);
  };
  return {std::move(word), std::move(help), fields::FormOf::Make(form), read};
}

// A kind whose table fills in the solid itself.
template <class Thing>
[[nodiscard]] SolidKind kind_of(std::string word, const fields::Table<Thing>& table) {
  return kind_of(std::move(word), "", table, [](const JsonValue&, const Thing& thing, Building&) { return thing; });
}

// A body's "shape"
const Form* form(FormStore& store, const ValueForms& values);
[[nodiscard]] Solid read(const JsonValue& shape, Building& building);

}  // namespace tweenfall::document::shapes
