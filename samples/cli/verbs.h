#pragma once

/// The verbs, a file each: every function declares its arguments and gives back what to run.

#include "arguments.h"

#include <span>

namespace tweenfall::cli {

Run check(Arguments& arguments);
Run inspect(Arguments& arguments);
Run sample(Arguments& arguments);
Run run(Arguments& arguments);
Run plot(Arguments& arguments);
Run view(Arguments& arguments);
Run import_model(Arguments& arguments);
Run new_document(Arguments& arguments);
Run schema(Arguments& arguments);
Run completion(Arguments& arguments);
Run bench(Arguments& arguments);

/// The one table of verbs, in the order of the help.
[[nodiscard]] std::span<const Verb> all_verbs();

}  // namespace tweenfall::cli
