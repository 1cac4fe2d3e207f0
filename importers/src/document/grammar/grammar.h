#pragma once

// The table of all fields of the document.

#include "document/shape.h"

namespace tweenfall::document {

// The shape of a whole document.
[[nodiscard]] const Shape& document_shape();

inline constexpr double document_version = 1;

}  // namespace tweenfall::document
