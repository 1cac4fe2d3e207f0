#pragma once

// Every call of a stage, each with arguments that it chooses itself.

#include "attack/stage/made.h"

#include <tweenfall/physics/stage/stage.h>

#include <ostream>
#include <span>
#include <string>

namespace tweenfall::attack {

/// A stage that is called.
struct Caller {
  Random& random;
  StageDescription description = made_stage(random);
  Stage stage{description};
  Arguments arguments{random, false, true};
  int added = 0;  ///< names that have been used
  std::ostream* log = nullptr;
  std::string fault = {};  ///< what a call found to be wrong

  /// An existing one, or sometimes any number.
  [[nodiscard]] NodeId any_node() { return arguments.one_in(12) ? random.bits() : below(random, stage.nodes().size()); }
  void require(bool holds, const char* otherwise) {
    if (!holds && fault.empty()) fault = otherwise;
  }
};

struct Call {
  const char* name;
  int share;  ///< of all calls
  void (*make)(Caller&);
};

[[nodiscard]] std::span<const Call> calls_of_time();
[[nodiscard]] std::span<const Call> calls_that_read();
[[nodiscard]] std::span<const Call> calls_that_change();

}  // namespace tweenfall::attack
