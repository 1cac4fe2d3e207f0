#include "verbs/verbs.h"

namespace tweenfall::cli {

std::span<const Verb* const> all_verbs() {
#define TWEENFALL_ROW(name) &name##_verb,
  static constexpr const Verb* verbs[] = {TWEENFALL_VERBS(TWEENFALL_ROW)};
#undef TWEENFALL_ROW
  return verbs;
}

}  // namespace tweenfall::cli
