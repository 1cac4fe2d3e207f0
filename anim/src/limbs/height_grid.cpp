#include <tweenfall/anim/height_grid.h>

#include <algorithm>
#include <cmath>

#include "chains/problems.h"

namespace tweenfall {

namespace limbs {
namespace {

// Along one axis: the four heights used, and their weights in the value, its slope and its second derivative.
struct Span {
  std::size_t at[4];
  double value[4], slope[4], bend[4];
};

// Source: Catmull, Rom, "A class of local interpolating splines", 1974. Beyond the border the ground continues
// straight.
Span span_at(double place, std::size_t count) noexcept {
  const double last = static_cast<double>(count - 1);
  const double u = std::clamp(std::isnan(place) ? 0.0 : place, 0.0, last);
  const double beyond = std::isnan(place) ? 0 : std::clamp(place - u, -1e9, 1e9);
  const std::size_t cell = std::min(static_cast<std::size_t>(u), count - 2);
  const double f = u - static_cast<double>(cell);
  Span span{
      {cell, cell, cell + 1, cell + 1},
      {((2 - f) * f - 1) * f / 2, ((3 * f - 5) * f * f + 2) / 2, ((4 - 3 * f) * f + 1) * f / 2, (f - 1) * f * f / 2},
      {(4 - 3 * f) * f / 2 - 0.5, (9 * f - 10) * f / 2, (8 - 9 * f) * f / 2 + 0.5, (3 * f - 2) * f / 2},
      {2 - 3 * f, 9 * f - 5, 4 - 9 * f, 3 * f - 1}};
  const auto lean = [&](double(&shares)[4]) {  // a missing height is extrapolated from the two beside it
    if (cell == 0) {
      shares[1] += 2 * shares[0];
      shares[2] -= shares[0];
      shares[0] = 0;
    }
    if (cell + 2 == count) {
      shares[2] += 2 * shares[3];
      shares[1] -= shares[3];
      shares[3] = 0;
    }
  };
  lean(span.value);
  lean(span.slope);
  lean(span.bend);
  if (cell > 0) span.at[0] = cell - 1;
  if (cell + 2 < count) span.at[3] = cell + 2;
  for (int i = 0; i < 4 && beyond != 0; ++i) {
    span.value[i] += beyond * span.slope[i];
    span.bend[i] = 0;
  }
  return span;
}

}  // namespace
}  // namespace limbs

std::vector<std::string> HeightGrid::problems() const {
  std::vector<std::string> problems;
  if (columns < 2 || heights.size() < 2 * columns || heights.size() % std::max<std::size_t>(columns, 1) != 0)
    problems.emplace_back("a ground has two heights along x at least, and two whole rows of them");
  const auto can_be_between = [](double spacing) { return spacing >= 1e-9 && spacing <= chains::largest; };
  if (!can_be_between(spacing_x) || !can_be_between(spacing_z))
    problems.emplace_back("the heights of a ground are from 1e-9 to 1e15 m apart");
  const auto is_place = [](double number) { return std::abs(number) <= chains::largest; };
  if (!is_place(middle.x()) || !is_place(middle.y()) || !is_place(middle.z()) ||
      !std::ranges::all_of(heights, is_place))
    problems.emplace_back("the heights of a ground and its middle are numbers up to 1e15");
  return problems;
}

Ground HeightGrid::at(const Sample<Vec3>& place) const noexcept {
  const std::size_t rows = heights.size() / columns;
  const double half_x = 0.5 * static_cast<double>(columns - 1), half_z = 0.5 * static_cast<double>(rows - 1);
  const limbs::Span x = limbs::span_at((place.value.x() - middle.x()) / spacing_x + half_x, columns);
  const limbs::Span z = limbs::span_at((place.value.z() - middle.z()) / spacing_z + half_z, rows);
  double value = 0, by_x = 0, by_z = 0, by_xx = 0, by_xz = 0, by_zz = 0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const double height = heights[z.at[j] * columns + x.at[i]];
      value += height * x.value[i] * z.value[j];
      by_x += height * x.slope[i] * z.value[j];
      by_z += height * x.value[i] * z.slope[j];
      by_xx += height * x.bend[i] * z.value[j];
      by_xz += height * x.slope[i] * z.slope[j];
      by_zz += height * x.value[i] * z.bend[j];
    }
  const double along_x = place.rate.x() / spacing_x, along_z = place.rate.z() / spacing_z;
  Ground ground;
  ground.height = middle.y() + value;
  ground.normal = {-by_x / spacing_x, 1, -by_z / spacing_z};
  ground.normal_rate = {-(by_xx * along_x + by_xz * along_z) / spacing_x, 0,
                        -(by_xz * along_x + by_zz * along_z) / spacing_z};
  return ground;
}

}  // namespace tweenfall
