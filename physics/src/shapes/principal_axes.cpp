#include "shapes/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::shapes {

namespace {

/// A turn in one plane that makes the matrix zero there.
void turn_in_plane(Mat3& matrix, Mat3& axes, int p, int q) {
  if (matrix(p, q) == 0) return;
  const double slope = (matrix(q, q) - matrix(p, p)) / (2 * matrix(p, q));
  const double tangent = std::copysign(1.0, slope) / (std::abs(slope) + std::sqrt(slope * slope + 1));
  const double cosine = 1 / std::sqrt(tangent * tangent + 1), sine = tangent * cosine;
  for (int k = 0; k < 3; ++k) {
    const double left = matrix(k, p), right = matrix(k, q);
    matrix(k, p) = cosine * left - sine * right;
    matrix(k, q) = sine * left + cosine * right;
  }
  for (int k = 0; k < 3; ++k) {
    const double upper = matrix(p, k), lower = matrix(q, k);
    matrix(p, k) = cosine * upper - sine * lower;
    matrix(q, k) = sine * upper + cosine * lower;
    const double left = axes(k, p), right = axes(k, q);
    axes(k, p) = cosine * left - sine * right;
    axes(k, q) = sine * left + cosine * right;
  }
  matrix(p, q) = matrix(q, p) = 0;
}

double greatest_coordinate(const Vec3& v) {
  int most = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(v[i]) > std::abs(v[most])) most = i;
  return v[most];
}

}  // namespace

Vec3 mean_of(std::span<const Vec3> points) noexcept {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / static_cast<double>(points.size());
  return middle;
}

Mat3 principal_axes(std::span<const Vec3> points) noexcept {
  constexpr int most_sweeps = 32;
  const Vec3 middle = mean_of(points);
  double size = 0;
  for (const Vec3& point : points)
    for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(point[i] - middle[i]));
  Mat3 axes = Mat3::Identity();
  if (!(size > 0)) return axes;
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) {
    const Vec3 from = (point - middle) / size;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) spread(i, k) += from[i] * from[k];
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double off = std::max({std::abs(spread(0, 1)), std::abs(spread(0, 2)), std::abs(spread(1, 2))});
    if (!(off > 1e-17 * (spread(0, 0) + spread(1, 1) + spread(2, 2)))) break;
    turn_in_plane(spread, axes, 0, 1);
    turn_in_plane(spread, axes, 0, 2);
    turn_in_plane(spread, axes, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::ranges::stable_sort(order, {}, [&](int i) { return spread(i, i); });
  Mat3 sorted;
  for (int i = 1; i < 3; ++i) {
    const Vec3 axis = axes.col(order[static_cast<std::size_t>(i)]);
    sorted.col(i) = greatest_coordinate(axis) < 0 ? Vec3(-axis) : axis;
  }
  sorted.col(0) = Vec3(sorted.col(1)).cross(Vec3(sorted.col(2)));
  return sorted;
}

}  // namespace tweenfall::shapes
