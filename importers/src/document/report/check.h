#pragma once

// Holds a document's tree against its shape.

#include "document/report/problems.h"
#include "document/shape.h"

namespace tweenfall::document {

// Notes every fault of shape in the tree and marks the faulty values, so that what follows passes over them.
void check(const Shape& shape, JsonTree& tree, Problems& problems);

// "a list of 3", "\"left\"", "-2": completes "found ...".
[[nodiscard]] std::string described(const JsonValue& value);

}  // namespace tweenfall::document
