#pragma once

/// Other ways to do what a world's step does, beside the usual ones: each is what a textbook tells, to be read, seen
/// and compared. The usual ones are the fastest and the most exact.
///
/// Where a world asks for another solver, separation or collision, all its islands of contacts go by these, with the
/// usual ones of the others in their plain form: the iterative solver in one sweep after the other, and overlap taken
/// apart by positional impulses. Islands that joints, drives or springs too stiff for the step hold go as usual.

#include <tweenfall/physics/world.h>

namespace tweenfall {

/// How the contacts of an island are met.
enum class ContactSolver : std::uint8_t {
  iterative,   ///< all contacts over and over (the default)
  sequential,  ///< one after the other, each once, as if it were alone: stacks sink and tremble
  shock,       ///< over and over, then from the ground up with all below held firm
  /// All at once, as a linear complementarity problem: islands of up to 96 touching points by Lemke's pivots, larger
  /// ones by projected Gauss-Seidel in 20,000 passes at most, or by pivots, too, where that takes many and there are up
  /// to 1024 points. `complementarity_residual` (detail.h) tells how far off.
  lcp,
};

/// How overlap is taken apart.
enum class Parting : std::uint8_t {
  soft,                ///< by contacts that give way, at `push_out_speed` at most (the default)
  half,                ///< each of two by half of it
  by_mass,             ///< the lighter by more, so that their center of mass stays
  positional_impulse,  ///< as an impulse would at the point where they touch: they turn, too
  closest_point,       ///< one of the two all of it, to the closest place where it touches from outside
};

/// When bodies are found to meet.
enum class Detection : std::uint8_t {
  ahead,     ///< at the start of the step, as far ahead as it goes (the default)
  discrete,  ///< when they overlap at its end: what is fast and thin passes through
  /// When they do: the world goes on to that instant, responds, and through the rest of the step. After 4096 instants
  /// of one step, or 8 blows of two bodies at one instant, what still meets is solved together.
  time_of_impact,
};

/// How pairs are found that may meet. What is found never depends on it.
enum class PairSearch : std::uint8_t {
  tree,       ///< a tree of boxes with room to spare, kept from step to step (the default)
  all_pairs,  ///< every body with every other
  sweep,      ///< in the order in which they begin along one axis
  grid,       ///< in equal cubes of space; what would lie in more than 512 is held against all
  quadtree,   ///< in squares cut into four where there is much in them
  octree,     ///< in cubes cut into eight
  kd_tree,    ///< in cells cut in two where half of the bodies are on either side
  bvh,        ///< in boxes around boxes, made anew in each step
};

}  // namespace tweenfall
