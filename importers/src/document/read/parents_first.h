#pragma once

// The order in which a stage wants its nodes.

#include "document/content.h"

namespace tweenfall::document {

// Sorts the nodes so that parents come before their children, otherwise keeping their order, and renumbers all that
// names a node by its place. Parents must not go around in a circle.
void parents_first(Building& building);

}  // namespace tweenfall::document
