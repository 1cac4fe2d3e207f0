#pragma once

/// Alternatives to parts of a world's step: each is a textbook method, to be read, watched
/// and compared. The defaults are the fastest and the most exact.
///
/// If a world asks for another solver, separation or collision, all its islands of contacts use them, and the defaults
/// of the others in their plain form: the iterative solver sweep after sweep, and overlap removed by positional
/// impulses. If only some of its bodies ask for another collision, the islands of contacts with them do, and all others
/// are solved as usual, to the bit. Islands with joints, drives or springs too stiff for the step are solved as usual,
/// too.

#include <tweenfall/physics/world.h>

namespace tweenfall {

/// How the contacts of an island are solved.
enum class ContactSolver : std::uint8_t {
  iterative,   ///< all contacts over and over (the default)
  sequential,  ///< one after the other, each once, as if it were alone: stacks sink and jitter
  shock,       ///< over and over, then from the ground up with everything below held fixed
  /// All at once, as a linear complementarity problem: islands of up to 96 contact points by Lemke's pivots, larger
  /// ones by projected Gauss-Seidel in at most 20,000 passes, or by pivots as well if that takes many passes and there
  /// are up to 1,536 points: complementarity is then met below 1e-9 m/s. `complementarity_residual` (detail.h) tells
  /// how exact the solution is; beyond that number passes alone reach 1e-9 m/s in what is broad (a pyramid of thirty
  /// rows), but miss it by some mm/s in a tower of six hundred boxes, and by some cm/s where masses differ a
  /// thousandfold.
  lcp,
};

/// How overlapping bodies are pushed apart.
enum class Parting : std::uint8_t {
  soft,                ///< by soft contacts, at `push_out_speed` at most (the default)
  half,                ///< each of the two by half of the depth
  by_mass,             ///< the lighter one by more, so that their center of mass stays
  positional_impulse,  ///< by an impulse on positions at the contact point: the bodies turn, too
  closest_point,       ///< one of the two by all of it, to the closest place where it touches from outside
};

/// When bodies are found to meet; a world's, unless one of two bodies has its own (`BodySettings::collision`).
enum class Detection : std::uint8_t {
  ahead,     ///< at the start of the step, as far ahead as it goes (the default)
  discrete,  ///< when they overlap at the end of the step: fast thin bodies pass through
  /// When they meet: the world advances to that instant, responds, and continues through the rest of the step. After
  /// 4096 instants in a step, or 8 collisions of two bodies at one instant, all that still meets is solved together.
  time_of_impact,
};

/// How pairs that may meet are found. The pairs found are the same for all.
enum class PairSearch : std::uint8_t {
  tree,       ///< a tree of enlarged boxes, kept from step to step (the default)
  all_pairs,  ///< every body with every other
  sweep,      ///< in the order in which the boxes begin along one axis
  grid,       ///< in equal cubes of space; boxes that would lie in more than 512 are tested against all
  quadtree,   ///< in squares, cut into four where there are many boxes
  octree,     ///< in cubes, cut into eight
  kd_tree,    ///< in cells, cut in two with half of the bodies on either side
  bvh,        ///< in boxes around boxes, rebuilt in each step
};

}  // namespace tweenfall
