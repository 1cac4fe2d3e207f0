#pragma once

// The table of all fields of the document.

#include "document/form.h"

namespace tweenfall::document {

// The form of a whole document.
[[nodiscard]] const Form& document_form();

inline constexpr double document_version = 1;

}  // namespace tweenfall::document
