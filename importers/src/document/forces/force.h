#pragma once

// A force of a document: what its kind says, on whom it acts, and how strongly.

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
