#pragma once

// The systems of first order of a document, by name: each is a clip of what follows from its state.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::systems {

const Form* form(FormStore& store, const ValueForms& values);
// When nodes and clips are known.
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::systems
