#pragma once

// The graphs of a document, by name.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::graphs {

const Form* form(FormStore& store, const ValueForms& values);
// Call when nodes and clips are known.
void read(const json::Value& value, Building& building);

}  // namespace tweenfall::document::graphs
