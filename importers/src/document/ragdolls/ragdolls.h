#pragma once

// Ragdolls fitted to imported figures, by the names of their imports.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::ragdolls {

const Form* form(FormStore& store, const ValueForms& values);
// Gives the nodes of the figures bodies and joints.
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::ragdolls
