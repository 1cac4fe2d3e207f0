#pragma once

// The order in which a stage needs its nodes.

#include "document/content.h"

namespace tweenfall::document {

// Sorts the nodes so that parents come before their children, otherwise keeping their order, and renumbers all indices
// of nodes. Parents must not form a cycle.
void parents_first(Building& building);

}  // namespace tweenfall::document
