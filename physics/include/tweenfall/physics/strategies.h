#pragma once

/// Other ways to do what a world's step does, beside the usual ones: each is what a textbook tells, to be read, seen
/// and compared. The usual ones are the fastest and the most exact.

#include <tweenfall/physics/world.h>

namespace tweenfall {

/// How the contacts of an island are met.
enum class ContactSolver : std::uint8_t {
  iterative,  ///< all contacts over and over (the default)
};

/// How overlap is taken apart.
enum class Parting : std::uint8_t {
  soft,  ///< by contacts that give way, at `push_out_speed` at most (the default)
};

/// When bodies are found to meet.
enum class Detection : std::uint8_t {
  ahead,  ///< at the start of the step, as far ahead as it goes (the default)
};

/// How pairs are found that may meet. What is found never depends on it.
enum class PairSearch : std::uint8_t {
  tree,  ///< a tree of boxes with room to spare, kept from step to step (the default)
};

}  // namespace tweenfall
