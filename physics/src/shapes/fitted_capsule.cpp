#include "shapes/fitted_capsule.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/principal_axes.h"

namespace tweenfall::shapes {

namespace {

/// Share of the points within the capsule's radius, and share that may lie beyond each end.
constexpr double within = 0.9;
constexpr double left_out = 0.02;

double at_share(std::vector<double>& values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

FittedCapsule along_axis(std::span<const Vec3> points, const Vec3& middle, const Vec3& axis) {
  std::vector<double> heights, distances;
  heights.reserve(points.size());
  distances.reserve(points.size());
  for (const Vec3& point : points) {
    const Vec3 from = point - middle;
    const double height = axis.dot(from);
    heights.push_back(height);
    distances.push_back((from - height * axis).norm());
  }
  const double radius = at_share(distances, within);
  const double low = at_share(heights, left_out);
  const double high = at_share(heights, 1 - left_out);
  FittedCapsule fitted;
  fitted.axis = axis;
  fitted.center = middle + 0.5 * (low + high) * axis;
  fitted.capsule.radius = radius;
  fitted.capsule.half_height = std::max(0.0, 0.5 * (high - low) - radius);
  return fitted;
}

}  // namespace

std::optional<FittedCapsule> fitted_capsule(std::span<const Vec3> points, const std::optional<Vec3>& along) {
  if (points.empty()) return std::nullopt;
  const Vec3 middle = mean_of(points);
  const Mat3 principal = principal_axes(points);
  std::vector<Vec3> axes;
  if (along) axes.push_back(*along);
  for (int i = 2; i >= 0; --i) axes.emplace_back(principal.col(i));
  std::optional<FittedCapsule> best;
  double least = 0;
  for (const Vec3& axis : axes) {
    const FittedCapsule fitted = along_axis(points, middle, axis);
    if (!(fitted.capsule.radius > 0)) continue;
    const double size = volume(fitted.capsule);
    // The bone's own direction is right unless another is clearly better.
    if (best && !(size < 0.8 * least)) continue;
    best = fitted;
    least = size;
  }
  return best;
}

}  // namespace tweenfall::shapes
