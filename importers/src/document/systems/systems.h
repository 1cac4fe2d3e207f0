#pragma once

// The first-order systems of a document, by name: each becomes a clip of its solution.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::systems {

const Form* form(FormStore& store, const ValueForms& values);
// Call when nodes and clips are known.
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::systems
