#pragma once

// The forces of a document's world.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

#include <vector>

namespace tweenfall::document::forces {

const Form* form(FormStore& store, const ValueForms& values);
void read(const json::Value& value, std::vector<ForceDescription>& forces, Building& building);
[[nodiscard]] json::Value place_of_stiffness(const json::Value& force);

}  // namespace tweenfall::document::forces
