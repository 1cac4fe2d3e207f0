#include "mass/weighing.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "mass/cubature.h"

namespace tweenfall {

namespace mass {
namespace {

void require_quadrature(const Quadrature& quadrature) {
  if (!(quadrature.tolerance >= 1e-13 && quadrature.tolerance <= 1))
    throw std::invalid_argument("tolerance of a quadrature must lie in 1e-13 to 1, but is " +
                                number_text(quadrature.tolerance));
}

std::string text_of_place(const Vec3& place) {
  return "(" + number_text(place.x()) + ", " + number_text(place.y()) + ", " + number_text(place.z()) + ")";
}

}  // namespace

void require_mass(double mass) {
  if (!(mass > 0) || !std::isfinite(mass))
    throw std::invalid_argument("mass must be positive and finite, but is " + number_text(mass));
}

WeighedProperties weigh_pieces(const Cut& cut, const Density& density, const Quadrature& quadrature) {
  require_quadrature(quadrature);
  const Mat3 axes = normalized(cut.pose.rotation).toRotationMatrix();
  const auto at = [&](const Vec3& place) {
    const Vec3 told = cut.pose.position + axes * place;
    const double value = density.at(told);
    if (!(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument("density must be finite and not negative, but is " + number_text(value) +
                                  " kg/m^3 at " + text_of_place(told));
    return value;
  };
  const Summed sums = sum_up(cut.pieces, cut.middle, cut.size, at, quadrature);
  const Moments& m = sums.moments;
  WeighedProperties result;
  result.evaluations = sums.evaluations;
  MassProperties& of = result.properties;
  of.mass = m[0];
  if (!(of.mass > 0) || !std::isfinite(of.mass))
    throw std::invalid_argument("a density must give some mass, but this one gives " + number_text(of.mass) + " kg");
  const Vec3 offset = Vec3(m[1], m[2], m[3]) / of.mass;
  Mat3 second;
  second << m[4], m[7], m[9], m[7], m[5], m[8], m[9], m[8], m[6];
  second -= of.mass * (offset * offset.transpose());
  of.center = cut.middle + offset;
  of.inertia = second.trace() * Mat3::Identity() - second;

  const Moments& e = sums.errors;
  const double first = std::max({e[1], e[2], e[3]}), far = offset.cwiseAbs().maxCoeff();
  double square = 0;
  for (std::size_t i = 4; i < e.size(); ++i) square = std::max(square, e[i]);
  // The rotation into the frame of the density mixes three coordinates, and an element of the inertia two integrals.
  const double mixing = cut.pose.rotation.vec() == Vec3(0, 0, 0) ? 1 : 3;
  result.mass_error = e[0];
  result.center_error = mixing * (first + far * e[0]) / of.mass;
  result.inertia_error = 2 * mixing * (square + 2 * far * first + far * far * e[0]);
  of = moved(of, cut.pose);
  return result;
}

}  // namespace mass

Density::Density(double even) : even_(even) {
  if (!(even > 0) || !std::isfinite(even))
    throw std::invalid_argument("density must be positive and finite, but is " + number_text(even));
}

Density::Density(std::function<double(const Vec3&)> at) : at_(std::move(at)) {
  if (!at_) throw std::invalid_argument("a density must hold a number or a function");
}

}  // namespace tweenfall
