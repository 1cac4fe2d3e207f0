#pragma once

// The things that a document describes by fields: what each may hold, and how it is read.

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

namespace tweenfall::document::fields {

const Form* body_form(FormStore& store, const ValueForms& values);
[[nodiscard]] BodyDescription read_body(const JsonValue& body, Building& building);

// Whose a body is: "free", "keyed", or a drive.
const Form* owner_form(FormStore& store, const ValueForms& values);
[[nodiscard]] Drive read_owner(const JsonValue& owner, Building& building);

}  // namespace tweenfall::document::fields
