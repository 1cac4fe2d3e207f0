#pragma once

// Holds a document's tree against its form.

#include "document/form.h"
#include "document/report/problems.h"

namespace tweenfall::document {

// Notes every fault of form in the tree and marks the faulty values, so that what follows passes over them.
void check(const Form& form, json::Tree& tree, Problems& problems);

// "a list of 3", "\"left\"", "-2": completes "found ...".
[[nodiscard]] std::string described(const json::Value& value);

}  // namespace tweenfall::document
