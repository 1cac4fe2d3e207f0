#include "mass/pieces.h"

namespace tweenfall::mass {

Pieces pieces_of(const Box& box) {
  return {[half = box.half_extents](double u, double v, double w) {
    return Image{half.cwiseProduct(Vec3(2 * u - 1, 2 * v - 1, 2 * w - 1)), 8 * half.prod()};
  }};
}

}  // namespace tweenfall::mass
