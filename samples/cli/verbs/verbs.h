#pragma once

/// The verbs, one file each, which ends with the verb itself: name, summary, example, function that declares arguments.

#include "line/arguments.h"

#include <span>

/// One row per verb, in the order of the help: check_verb is defined at the end of check.cpp.
#define TWEENFALL_VERBS(ROW) \
  ROW(check)                 \
  ROW(inspect)               \
  ROW(sample)                \
  ROW(run)                   \
  ROW(plot)                  \
  ROW(view)                  \
  ROW(import)                \
  ROW(new)                   \
  ROW(schema)                \
  ROW(completion)            \
  ROW(bench)

namespace tweenfall::cli {

#define TWEENFALL_ROW(name) extern const Verb name##_verb;
TWEENFALL_VERBS(TWEENFALL_ROW)
#undef TWEENFALL_ROW

/// The whole table.
[[nodiscard]] std::span<const Verb* const> all_verbs();

}  // namespace tweenfall::cli
