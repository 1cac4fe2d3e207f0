#pragma once

#include <tweenfall/physics/strategies.h>

#include "strategies/gathering.h"

namespace tweenfall::strategies {

/// Solves the contacts of an island: changes the velocities of its parties by impulses at its touches.
using SolvesContacts = void(Gathering& island);

// One file each
SolvesContacts sequential, iterative, shock, lcp;

/// Null for a solver that does not exist.
[[nodiscard]] SolvesContacts* solver_of(ContactSolver solver);

}  // namespace tweenfall::strategies
