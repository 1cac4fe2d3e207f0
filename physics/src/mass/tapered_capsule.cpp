#include "mass/revolved.h"
#include "shapes/turned.h"

namespace tweenfall::mass {

// The side touches the balls where its normal rises by the sine.
Pieces pieces_of(const TaperedCapsule& capsule) {
  const auto [sine, cosine] = shapes::taper_of(capsule);
  const double half = capsule.half_height, touching = std::numbers::pi / 2 + elementary::asin(sine);
  Pieces pieces;
  add_ball_slices(pieces, -half, capsule.bottom_radius, 0, touching);
  add_frustum(pieces, -half + sine * capsule.bottom_radius, half + sine * capsule.top_radius,
              cosine * capsule.bottom_radius, cosine * capsule.top_radius);
  add_ball_slices(pieces, half, capsule.top_radius, touching, std::numbers::pi);
  return pieces;
}

}  // namespace tweenfall::mass
