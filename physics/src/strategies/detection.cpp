#include "strategies/detection.h"

#include <algorithm>

namespace tweenfall::strategies {

namespace {

/// How much of a step a detection watches: its end, what lies ahead of its start, or all of it.
int care_of(Detection detection) {
  switch (detection) {
    case Detection::discrete:
      return 0;
    case Detection::ahead:
      return 1;
    case Detection::time_of_impact:
      break;
  }
  return 2;
}

}  // namespace

Detection detection_of(const state::Body& a, const state::Body& b, Detection of_world) {
  const std::optional<Detection>&its = a.makeup->collision, &others = b.makeup->collision;
  if (its && others) return std::max(*its, *others, [](Detection x, Detection y) { return care_of(x) < care_of(y); });
  return its ? *its : others.value_or(of_world);
}

}  // namespace tweenfall::strategies
