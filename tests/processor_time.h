#pragma once

#include <ctime>

namespace tweenfall::test {

/// What this process has taken of a processor, s. Bounds that tell a hang from work are on this: a crowded machine
/// stretches the clock, not the work.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace tweenfall::test
