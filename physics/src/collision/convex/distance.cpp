#include "collision/convex/distance.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace tweenfall::convex {

namespace {

constexpr int most_searches = 128;
/// The distance, in parts of all their extent, below which its direction may be rounded too much.
constexpr double rounded_off = 1e-6;

/// A point of a minus one of b.
struct SimplexPoint {
  Vec3 apart, on_a, on_b;
};

/// The smallest simplex found so far that contains the point nearest to the origin.
class NearestSimplex {
 public:
  /// The point nearest to the origin.
  const Vec3& find_nearest() {
    // The newest corner is part of it: without it, the nearest point would be the same as before.
    const int newest = count_ - 1;
    best_ = {};
    try_point(newest);
    for (int i = 0; i < newest; ++i) try_segment(i, newest);
    for (int i = 0; i < newest; ++i)
      for (int k = i + 1; k < newest; ++k) try_triangle(i, k, newest);
    return best_.place;
  }
  /// Drops the corners that the nearest point does not lie between.
  void reduce() { keep(best_); }

  /// For a tetrahedron.
  [[nodiscard]] bool holds_origin() const {
    if (count_ < 4) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& a = points_[(i + 1) % 4].apart;
      const Vec3& b = points_[(i + 2) % 4].apart;
      const Vec3& c = points_[(i + 3) % 4].apart;
      const Vec3 out = (b - a).cross(c - a);
      if (!(out.dot(points_[i].apart - a) * out.dot(-a) > 0)) return false;
    }
    return true;
  }

  [[nodiscard]] bool has(const Vec3& apart) const {
    for (int i = 0; i < count_; ++i)
      if (points_[static_cast<std::size_t>(i)].apart == apart) return true;
    return false;
  }
  void add(const SimplexPoint& point) {
    points_[static_cast<std::size_t>(count_)] = point;
    shares_[static_cast<std::size_t>(count_++)] = 0;
  }
  void tell(Nearness& nearness) const {
    nearness.on_a = nearness.on_b = Vec3::Zero();
    for (int i = 0; i < count_; ++i) {
      const auto k = static_cast<std::size_t>(i);
      nearness.on_a += shares_[k] * points_[k].on_a;
      nearness.on_b += shares_[k] * points_[k].on_b;
    }
  }

 private:
  struct Candidate {
    double square = 1e300;
    Vec3 place{0, 0, 0};
    std::array<int, 3> corners{};
    std::array<double, 3> shares{};
    int count = 0;
  };

  [[nodiscard]] const Vec3& at(int i) const { return points_[static_cast<std::size_t>(i)].apart; }

  void try_candidate(const Vec3& place, const std::array<int, 3>& corners, const std::array<double, 3>& shares,
                     int count) {
    const double square = place.squaredNorm();
    if (square < best_.square) best_ = {square, place, corners, shares, count};
  }
  void try_point(int i) { try_candidate(at(i), {i}, {1}, 1); }
  void try_segment(int i, int k) {
    const Vec3 along = at(k) - at(i);
    const double square = along.squaredNorm(), part = -along.dot(at(i));
    if (!(part > 0) || !(part < square)) return;
    const double share = part / square;
    try_candidate((1 - share) * at(i) + share * at(k), {i, k}, {1 - share, share}, 2);
  }
  void try_triangle(int i, int k, int l) {
    const Vec3 &a = at(i), &b = at(k), &c = at(l);
    const Vec3 normal = (b - a).cross(c - a);
    const double of_a = normal.dot(b.cross(c)), of_b = normal.dot(c.cross(a)), of_c = normal.dot(a.cross(b));
    if (!(of_a > 0) || !(of_b > 0) || !(of_c > 0)) return;
    const double whole = 1 / (of_a + of_b + of_c);
    const std::array<double, 3> shares = {of_a * whole, of_b * whole, of_c * whole};
    try_candidate(shares[0] * a + shares[1] * b + shares[2] * c, {i, k, l}, shares, 3);
  }

  void keep(const Candidate& best) {
    count_ = best.count;
    // Corners are listed in order, so that none is overwritten before it is read.
    for (std::size_t k = 0; k < static_cast<std::size_t>(count_); ++k) {
      const auto from = static_cast<std::size_t>(best.corners[k]);
      if (from != k) points_[k] = points_[from];
      shares_[k] = best.shares[k];
    }
  }

  std::array<SimplexPoint, 4> points_;
  std::array<double, 4> shares_{};
  int count_ = 0;
  Candidate best_;
};

/// If the point of a solid nearest to a box lies over a face of it, there is no shorter distance; and if it is farther
/// than `enough` from the plane of a face, that is enough.
/// @return the normal out of the box; empty if no face decides
std::optional<Nearness> over_a_face(const Core& box, Core& other, double enough, double touching) {
  const Vec3 between = box.turn.transpose() * (other.shift - box.shift);
  double most = touching;
  int axis = -1;
  Vec3 nearest;
  for (int i = 0; i < 3; ++i) {
    // Its center is no nearer to the face than its nearest point.
    if (!(std::abs(between[i]) - box.half[i] > most)) continue;
    const double side = between[i] < 0 ? -1 : 1;
    const Vec3 place = other.support(box.turn.col(i) * -side);
    const double height = side * box.turn.col(i).dot(place - box.shift) - box.half[i];
    if (!(height > most)) continue;
    most = height;
    axis = i;
    nearest = place;
  }
  if (axis < 0) return std::nullopt;
  if (!(most > enough)) {
    const Vec3 local = box.turn.transpose() * (nearest - box.shift);
    for (int i = 0; i < 3; ++i)
      if (i != axis && !(std::abs(local[i]) <= box.half[i])) return std::nullopt;
  }
  Nearness nearness;
  nearness.distance = most;
  nearness.normal = box.turn.col(axis) * (between[axis] < 0 ? -1.0 : 1.0);
  nearness.on_b = nearest;
  nearness.on_a = nearest - most * nearness.normal;
  return nearness;
}

}  // namespace

Nearness nearness_of(Core& a, Core& b, double enough) {
  const double extent = a.reach + b.reach + (a.shift - b.shift).norm();
  const double rounding = 4e-16 * extent, touching = 1e-9 * std::min(a.reach + a.radius, b.reach + b.radius);
  if (a.kind == Core::Kind::box)
    if (const std::optional<Nearness> over = over_a_face(a, b, enough, touching)) return *over;
  if (b.kind == Core::Kind::box)
    if (std::optional<Nearness> over = over_a_face(b, a, enough, touching)) {
      over->normal = -over->normal;
      std::swap(over->on_a, over->on_b);
      return *over;
    }
  NearestSimplex simplex;
  Vec3 nearest = a.shift - b.shift;
  if (!(nearest.squaredNorm() > 0)) nearest = Vec3(1, 0, 0);
  double square = 1e300, lowest = 0;
  Nearness nearness;
  for (int i = 0; i < most_searches; ++i) {
    SimplexPoint point;
    point.on_a = a.support(-nearest);
    point.on_b = b.support(nearest);
    point.apart = point.on_a - point.on_b;
    const double length = nearest.norm();
    lowest = nearest.dot(point.apart) / length;
    if (lowest > enough) {
      nearness.distance = lowest;
      nearness.normal = -nearest / length;
      nearness.on_a = point.on_a;
      nearness.on_b = point.on_b;
      return nearness;
    }
    if (i > 0 && (length - lowest <= 1e-13 * length + rounding || simplex.has(point.apart))) break;
    simplex.add(point);
    // If all lies beyond a plane, the origin is not inside, however flat the tetrahedron and the rounding of its sides.
    if (!(lowest > rounding) && simplex.holds_origin()) return {};
    const Vec3& next = simplex.find_nearest();
    if (!(next.squaredNorm() < square)) {
      if (i == 0) simplex.reduce();
      break;
    }
    nearest = next;
    simplex.reduce();
    square = nearest.squaredNorm();
    if (!(square > touching * touching)) return {};
  }
  nearness.distance = nearest.norm();
  // So near to each other, rounding turns the direction, and far from there a plane across it need not lie between
  // them.
  if (nearness.distance < rounded_off * extent && lowest < nearness.distance - touching) return {};
  nearness.normal = -nearest / nearness.distance;
  simplex.tell(nearness);
  return nearness;
}

}  // namespace tweenfall::convex
