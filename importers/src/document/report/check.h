#pragma once

// Checks a document's tree against its form.

#include "document/form.h"
#include "document/report/problems.h"

namespace tweenfall::document {

// Reports every fault of form in the tree and marks the faulty values, so that later code skips them.
void check(const Form& form, json::Tree& tree, Problems& problems);

// "a list of 3", "\"left\"", "-2": completes "found ...".
[[nodiscard]] std::string described(const json::Value& value);

}  // namespace tweenfall::document
