#include <array>

#include "pairs/searches/cells.h"

namespace tweenfall::pairs {

/// A cube cut into eight, each of which is cut again where there is much in it. Only boxes that share a cell are held
/// against each other.
/// Source: Meagher, Geometric modeling using octree encoding, Computer Graphics and Image Processing 19, 1982.
void octree(Search& search) {
  constexpr std::array<int, 3> axes{0, 1, 2};
  halve_along(search, axes);
}

}  // namespace tweenfall::pairs
