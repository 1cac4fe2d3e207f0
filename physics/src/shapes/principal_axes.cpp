#include "shapes/principal_axes.h"

#include <tweenfall/curves/symmetric_eigen.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::shapes {

namespace {

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
  const Vec3 middle = mean_of(points);
  double size = 0;
  for (const Vec3& point : points)
    for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(point[i] - middle[i]));
  if (!(size > 0)) return Mat3::Identity();
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) {
    const Vec3 from = (point - middle) / size;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) spread(i, k) += from[i] * from[k];
  }
  const SymmetricEigen<3> found = symmetric_eigen(spread);
  std::array<int, 3> order{0, 1, 2};  // equal ones keep their order
  std::ranges::stable_sort(order, {}, [&](int i) { return found.values[i]; });
  Mat3 sorted;
  for (int i = 1; i < 3; ++i) {
    const Vec3 axis = found.vectors.col(order[static_cast<std::size_t>(i)]);
    sorted.col(i) = greatest_coordinate(axis) < 0 ? Vec3(-axis) : axis;
  }
  sorted.col(0) = Vec3(sorted.col(1)).cross(Vec3(sorted.col(2)));
  return sorted;
}

}  // namespace tweenfall::shapes
