#include <tweenfall/curves/number_text.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "mass/pieces.h"
#include "mass/weighing.h"

namespace tweenfall {

namespace mass {

Pieces pieces_of(const Ellipsoid& ellipsoid) {
  Pieces pieces = pieces_of(Sphere{1});
  for (Piece& piece : pieces)
    piece = [of_ball = std::move(piece), axes = ellipsoid.semi_axes](double u, double v, double w) {
      const Image image = of_ball(u, v, w);
      return Image{axes.cwiseProduct(image.place), axes.prod() * image.stretch};
    };
  return pieces;
}

namespace {

void require_axes(const Ellipsoid& ellipsoid) {
  for (int i = 0; i < 3; ++i) {
    const double axis = ellipsoid.semi_axes[i];
    if (!(axis > 0) || !std::isfinite(axis))
      throw std::invalid_argument(std::string("semi-axis ") + "xyz"[i] +
                                  " of an ellipsoid must be positive and finite, but is " + number_text(axis));
  }
}

}  // namespace
}  // namespace mass

double volume(const Ellipsoid& ellipsoid) noexcept {
  return 4 * std::numbers::pi / 3 * ellipsoid.semi_axes.prod();
}

MassProperties mass_properties(const Ellipsoid& ellipsoid, double mass) {
  mass::require_axes(ellipsoid);
  mass::require_mass(mass);
  const Vec3 square = ellipsoid.semi_axes.cwiseProduct(ellipsoid.semi_axes);
  MassProperties properties;
  properties.mass = mass;
  properties.inertia =
      (mass / 5 * Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y())).asDiagonal();
  return properties;
}

WeighedProperties weigh(const Ellipsoid& ellipsoid, const Density& density, const Quadrature& quadrature) {
  mass::require_axes(ellipsoid);
  if (density.even()) return {mass_properties(ellipsoid, density.at({0, 0, 0}) * volume(ellipsoid))};
  return mass::weigh_pieces({mass::pieces_of(ellipsoid), {}, Vec3(0, 0, 0), ellipsoid.semi_axes.maxCoeff()}, density,
                            quadrature);
}

}  // namespace tweenfall
