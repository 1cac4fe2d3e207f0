#pragma once

// A force of a document: its kind, the bodies on which it acts, and its strength.

#include "document/fields/table.h"

#include <string>
#include <vector>

namespace tweenfall::document::forces {

// One field for each kind of force
[[nodiscard]] std::vector<fields::Row<ForceDescription>> kinds();

// By formulas
[[nodiscard]] fields::Row<ForceDescription> field_row();

// A factor over the stage's time
const Form* strength_form(FormStore& store, const ValueForms& values);
void read_strength(const json::Value& value, ForceDescription& force, Building& building);

}  // namespace tweenfall::document::forces
