#pragma once

#include <ctime>

namespace tweenfall::test {

/// Processor time that this process has used, s. Limits that tell a hang from work use it: a crowded machine
/// stretches the clock, not the work.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace tweenfall::test
