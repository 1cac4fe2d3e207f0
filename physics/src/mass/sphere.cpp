#include <tweenfall/curves/elementary.h>

#include <numbers>

#include "mass/pieces.h"

namespace tweenfall::mass {

// By distance from the center, angle from the pole and angle around it: a density that only depends on the distance, as
// in a planet, then varies with one coordinate.
Pieces pieces_of(const Sphere& sphere) {
  constexpr double quarter = std::numbers::pi / 2;
  Pieces pieces;
  for (int half = 0; half < 2; ++half)
    for (int k = 0; k < 4; ++k)
      pieces.emplace_back([radius = sphere.radius, half, k](double u, double v, double w) {
        const auto [out, along] = elementary::sin_cos(quarter * (half + v));
        const auto [sine, cosine] = elementary::sin_cos(quarter * (k + w));
        const double r = radius * u;
        return Image{r * Vec3(out * cosine, along, -out * sine), radius * quarter * quarter * r * r * out};
      });
  return pieces;
}

}  // namespace tweenfall::mass
