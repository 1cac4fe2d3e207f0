#include "strategies/solvers/solvers.h"

namespace tweenfall::strategies {

SolvesContacts* solver_of(ContactSolver solver) {
  switch (solver) {
    case ContactSolver::iterative:
      return iterative;
    case ContactSolver::sequential:
      return sequential;
    case ContactSolver::shock:
      return shock;
    case ContactSolver::lcp:
      return lcp;
  }
  return nullptr;
}

}  // namespace tweenfall::strategies
