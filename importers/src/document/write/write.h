#pragma once

// A document's tree as text.

#include "document/form.h"

#include <string>

namespace tweenfall::document {

// Two spaces, one key per line, defaults left out, one spelling for each thing. Comments are lost. Reading this text
// and writing it again gives the same text.
[[nodiscard]] std::string write(const Form& form, const json::Value& value);

}  // namespace tweenfall::document
