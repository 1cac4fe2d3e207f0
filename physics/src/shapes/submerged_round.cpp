#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shapes/submerged.h"

namespace tweenfall::shapes {

namespace {

/// Points and weights of the 16-point Gauss-Legendre rule on -1 to 1: those above 0.
/// Source: Abramowitz and Stegun, Handbook of Mathematical Functions, table 25.4.
struct GaussPlace {
  double at, weight;
};
constexpr std::array<GaussPlace, 8> gauss_places{{{0.095012509837637440185, 0.189450610455068496285},
                                                  {0.281603550779258913230, 0.182603415044923588867},
                                                  {0.458016777657227386342, 0.169156519395002538189},
                                                  {0.617876244402643748447, 0.149595988816576732081},
                                                  {0.755404408355003033895, 0.124628971255533872052},
                                                  {0.865631202387831743880, 0.095158511682492784810},
                                                  {0.944575023073232576078, 0.062253523938647892863},
                                                  {0.989400934991649932596, 0.027152459411754094852}}};

/// The smaller part of a disc cut by a line at a distance from its center: area, and its moment about
/// the line through the center parallel to the cut.
struct CutDisc {
  double area, moment;
};
CutDisc cut_disc(double radius, double distance) {
  if (distance <= -radius) return {0, 0};
  if (distance >= radius) return {std::numbers::pi * radius * radius, 0};
  const double half = std::sqrt((radius - distance) * (radius + distance));
  const double angle = elementary::atan2(half, distance);  // of half the part that is left out
  return {radius * radius * (std::numbers::pi - angle) + distance * half, -2.0 / 3 * half * half * half};
}

}  // namespace

Moments submerged(const Round& round, const Vec3& normal, double level) {
  const double along = normal.y();
  const Vec3 beside(normal.x(), 0, normal.z());
  const double across = beside.norm();
  const auto square = [&](double y) {
    return std::max(0.0, round.constant + y * (round.linear + y * round.quadratic));
  };
  // Where the cut starts and ends to meet the discs: (level - along y)^2 = across^2 radius^2.
  std::array<double, 5> ends{round.low, round.low, round.low, round.high, round.high};
  std::size_t count = 1;
  const auto add = [&](double y) {
    if (y > round.low && y < round.high) ends[count++] = y;
  };
  const double sine = across * across;
  const double a = along * along - sine * round.quadratic, b = -2 * level * along - sine * round.linear;
  const double c = level * level - sine * round.constant, root = b * b - 4 * a * c;
  if (std::abs(a) < 1e-14 * (1 + sine * std::abs(round.quadratic))) {
    if (b != 0) add(-c / b);
  } else if (root >= 0) {
    const double q = -0.5 * (b + (b < 0 ? -std::sqrt(root) : std::sqrt(root)));
    add(q / a);
    if (q != 0) add(c / q);
  }
  ends[count++] = round.high;
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
  Moments sum;
  const auto see = [&](double y, double weight) {
    const double radius = std::sqrt(square(y)), depth = level - along * y;
    const double far = across * radius;
    const CutDisc disc =
        far <= std::abs(depth) ? cut_disc(radius, depth < 0 ? -radius : radius) : cut_disc(radius, depth / across);
    sum.volume += weight * disc.area;
    sum.first += weight * Vec3(0, y * disc.area, 0);
    if (across > 0) sum.first += weight * disc.moment / across * beside;
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double low = ends[i], width = ends[i + 1] - low;
    if (!(width > 0)) continue;
    // At the ends the integrand is a square root of the height; substituting 3 u^2 - 2 u^3 makes it smooth.
    for (const GaussPlace& place : gauss_places)
      for (const double sign : {-1.0, 1.0}) {
        const double u = 0.5 + 0.5 * sign * place.at;
        see(low + width * u * u * (3 - 2 * u), 0.5 * place.weight * width * 6 * u * (1 - u));
      }
  }
  return sum;
}

}  // namespace tweenfall::shapes
