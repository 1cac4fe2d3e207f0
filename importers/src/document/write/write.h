#pragma once

// A document's tree as text.

#include "document/form.h"

#include <string>

namespace tweenfall::document {

// Two spaces, one key a line, what says the default left out, one way to say a thing. Comments are gone. Writing what
// was read from this text gives this text.
[[nodiscard]] std::string write(const Form& form, const json::Value& value);

}  // namespace tweenfall::document
