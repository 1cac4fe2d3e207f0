#include <array>

#include "pairs/searches/cells.h"

namespace tweenfall::pairs {

/// A square cut into four, each of which is cut again if it holds many boxes: along the two axes in which the boxes
/// spread most. Only boxes that share a cell are tested against each other.
/// Source: Finkel and Bentley, Quad trees: a data structure for retrieval on composite keys, Acta Informatica 4, 1974.
void quadtree(Search& search) {
  const Bounds all = search.all();
  const Vec3 sides = all.high - all.low;
  int narrowest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (sides[axis] < sides[narrowest]) narrowest = axis;
  const std::array<int, 2> axes{narrowest == 0 ? 1 : 0, narrowest == 2 ? 1 : 2};
  halve_along(search, axes);
}

}  // namespace tweenfall::pairs
