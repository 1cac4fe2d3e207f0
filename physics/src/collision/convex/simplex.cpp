#include "collision/convex/simplex.h"

#include <algorithm>
#include <limits>

namespace tweenfall::convex {

namespace {

/// The combination of some corners that is nearest to zero.
struct Nearest {
  Vec3 point{0, 0, 0};
  double square = std::numeric_limits<double>::infinity();
  std::array<double, 4> weights{};

  void take_if_nearer(const Nearest& other) {
    if (other.square < square) *this = other;
  }
};

using Corners = std::array<Simplex::Corner, 4>;

Nearest at_corner(const Corners& corners, std::size_t a) {
  Nearest nearest;
  nearest.point = corners[a].difference;
  nearest.square = nearest.point.squaredNorm();
  nearest.weights[a] = 1;
  return nearest;
}

Nearest on_edge(const Corners& corners, std::size_t a, std::size_t b) {
  const Vec3 &from = corners[a].difference, &to = corners[b].difference;
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  const double share = square > 0 ? std::clamp(-from.dot(along) / square, 0.0, 1.0) : 0;
  Nearest nearest;
  // Computed from the nearer end, so that little precision is lost.
  nearest.point = share <= 0.5 ? Vec3(from + share * along) : Vec3(to - (1 - share) * along);
  nearest.square = nearest.point.squaredNorm();
  nearest.weights[a] = 1 - share;
  nearest.weights[b] = share;
  return nearest;
}

/// Its border, and its inside if zero lies above that.
Nearest on_triangle(const Corners& corners, std::size_t a, std::size_t b, std::size_t c) {
  Nearest nearest = on_edge(corners, a, b);
  nearest.take_if_nearer(on_edge(corners, b, c));
  nearest.take_if_nearer(on_edge(corners, c, a));
  const Vec3 &first = corners[a].difference, &second = corners[b].difference, &third = corners[c].difference;
  const Vec3 normal = (second - first).cross(third - first);
  const double square = normal.squaredNorm();
  const double longest =
      std::max({(second - first).squaredNorm(), (third - second).squaredNorm(), (first - third).squaredNorm()});
  // A triangle flatter than rounding has no inside.
  if (!(square > 1e-28 * longest * longest)) return nearest;
  const double of_first = normal.dot(second.cross(third));
  const double of_second = normal.dot(third.cross(first));
  const double of_third = normal.dot(first.cross(second));
  if (of_first < 0 || of_second < 0 || of_third < 0) return nearest;
  const double sum = of_first + of_second + of_third;
  if (!(sum > 0)) return nearest;
  Nearest inside;
  inside.point = normal * (normal.dot(first) / square);
  inside.square = inside.point.squaredNorm();
  inside.weights[a] = of_first / sum;
  inside.weights[b] = of_second / sum;
  inside.weights[c] = of_third / sum;
  nearest.take_if_nearer(inside);
  return nearest;
}

/// Six times the volume of a tetrahedron with its tip at zero.
double volume(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

Nearest in_tetrahedron(const Corners& corners) {
  const Vec3 &a = corners[0].difference, &b = corners[1].difference, &c = corners[2].difference,
             &d = corners[3].difference;
  const std::array<double, 4> parts = {volume(b, d, c), volume(a, c, d), volume(a, d, b), volume(a, b, c)};
  const bool enclosed = std::ranges::all_of(parts, [](double part) { return part > 0; }) ||
                        std::ranges::all_of(parts, [](double part) { return part < 0; });
  if (enclosed) {
    Nearest nearest;
    const double sum = parts[0] + parts[1] + parts[2] + parts[3];
    nearest.square = 0;
    for (std::size_t i = 0; i < 4; ++i) nearest.weights[i] = parts[i] / sum;
    return nearest;
  }
  Nearest nearest = on_triangle(corners, 0, 1, 2);
  nearest.take_if_nearer(on_triangle(corners, 0, 1, 3));
  nearest.take_if_nearer(on_triangle(corners, 0, 2, 3));
  nearest.take_if_nearer(on_triangle(corners, 1, 2, 3));
  return nearest;
}

}  // namespace

bool Simplex::has(const Vec3& difference) const {
  return std::any_of(corners.begin(), corners.begin() + count,
                     [&](const Corner& corner) { return corner.difference == difference; });
}

Vec3 Simplex::reduce() {
  const Nearest nearest = count == 1   ? at_corner(corners, 0)
                          : count == 2 ? on_edge(corners, 0, 1)
                          : count == 3 ? on_triangle(corners, 0, 1, 2)
                                       : in_tetrahedron(corners);
  int kept = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (!(nearest.weights[i] > 0)) continue;
    corners[static_cast<std::size_t>(kept)] = corners[i];
    weights[static_cast<std::size_t>(kept++)] = nearest.weights[i];
  }
  count = kept;
  return nearest.point;
}

Vec3 Simplex::on_a() const {
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += weights[i] * corners[i].on_a;
  return sum;
}

Vec3 Simplex::on_b() const {
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) sum += weights[i] * corners[i].on_b;
  return sum;
}

}  // namespace tweenfall::convex
