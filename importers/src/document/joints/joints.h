#pragma once

// The joints of a document's world, by name.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::joints {

const Form* form(FormStore& store, const ValueForms& values);
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::joints
