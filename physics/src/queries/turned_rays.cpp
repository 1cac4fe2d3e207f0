#include "queries/turned_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

/// A ray is in a convex solid for one stretch of it; for the intersection of several solids, that is the intersection
/// of their stretches.

namespace tweenfall::queries {

namespace {

constexpr double without_bound = std::numeric_limits<double>::infinity();

/// The part of a ray inside a convex solid.
struct Stretch {
  double enter = -without_bound, leave = without_bound;
  Vec3 normal{0, 1, 0};  ///< where it enters

  void meet(double from, double to, const Vec3& out) {
    if (from > enter) {
      enter = from;
      normal = out;
    }
    leave = std::min(leave, to);
  }
  void be_nowhere() { leave = -without_bound; }
  /// Above or below a height: where side * y <= most.
  void bound(const Vec3& from, const Vec3& direction, double side, double most) {
    const double above = side * from.y() - most, rising = side * direction.y();
    if (rising == 0) {
      if (above > 0) be_nowhere();
    } else if (rising < 0) {
      meet(-above / rising, without_bound, Vec3(0, side, 0));
    } else {
      leave = std::min(leave, -above / rising);
    }
  }
};

/// Everything around the y axis within a radius that decreases with the height.
struct Side {
  double radius = 0;  ///< at height 0, m
  double fall = 0;    ///< of the radius, per height

  [[nodiscard]] double radius_at(double height) const { return radius - fall * height; }
  [[nodiscard]] bool holds(const Vec3& point) const { return std::hypot(point.x(), point.z()) <= radius_at(point.y()); }

  /// Both roots of the quadratic for radius squared = distance from the axis squared; if the ray is steeper
  /// than the side, they belong to two opposite cones, one of which is ours.
  void meet(Stretch& stretch, const Vec3& from, const Vec3& direction) const {
    const double start = radius_at(from.y()), shrinks = fall * direction.y();
    const double across = direction.x() * direction.x() + direction.z() * direction.z();
    const double square = across - shrinks * shrinks;
    const double half = from.x() * direction.x() + from.z() * direction.z() + start * shrinks;
    const double rest = from.x() * from.x() + from.z() * from.z() - start * start;
    if (across == 0 && shrinks == 0) {
      if (rest > 0 || start < 0) stretch.be_nowhere();
      return;
    }
    const double room = half * half - square * rest;
    if (room < 0 && square > 0) return stretch.be_nowhere();
    const double root = std::sqrt(std::max(0.0, room));
    const double sum = half > 0 ? -(half + root) : root - half;
    double first = sum / square, second = sum != 0 ? rest / sum : 0;
    if (first > second) std::swap(first, second);
    if (square > 0) {
      const double middle = std::isinf(first) ? second : std::isinf(second) ? first : 0.5 * (first + second);
      if (start - shrinks * middle < 0) return stretch.be_nowhere();
    } else if (shrinks > 0) {
      second = std::exchange(first, -without_bound);
    } else {
      first = std::exchange(second, without_bound);
    }
    Vec3 out(0, 1, 0);
    if (std::isfinite(first)) {
      const Vec3 point = from + first * direction;
      const double distance = std::hypot(point.x(), point.z());
      if (distance > 0) out = Vec3(point.x() / distance, fall, point.z() / distance).normalized();
    }
    stretch.meet(first, second, out);
  }
};

void meet_ball(Stretch& stretch, const Vec3& center, double radius, const Vec3& from, const Vec3& direction) {
  const double nearest = (center - from).dot(direction);
  const Vec3 across = from + nearest * direction - center;
  const double room = radius * radius - across.squaredNorm();
  if (!(room >= 0)) return stretch.be_nowhere();
  const double half = std::sqrt(room);
  stretch.meet(nearest - half, nearest + half, (across - half * direction).normalized());
}

/// @param before  distance from the stretch's origin to the ray's start
std::optional<Entry> entry_of(const Stretch& stretch, double before) {
  const double enter = stretch.enter - before, leave = stretch.leave - before;
  if (!(enter <= leave) || leave < 0) return std::nullopt;
  return Entry{std::max(0.0, enter), stretch.normal, false};
}

Entry from_within() {
  return {0, Vec3(0, 1, 0), true};
}

/// Relative to where a ray comes nearest to the origin, so that a far start loses nothing.
Vec3 seen_from_near(const Vec3& from, const Vec3& direction, double& before) {
  before = from.dot(direction);
  return from - before * direction;
}

/// Between two heights.
std::optional<Entry> enters_between(const Side& side, double low, double high, const Vec3& from,
                                    const Vec3& direction) {
  if (from.y() >= low && from.y() <= high && side.holds(from)) return from_within();
  double before = 0;
  const Vec3 near = seen_from_near(from, direction, before);
  Stretch stretch;
  stretch.bound(near, direction, 1, high);
  stretch.bound(near, direction, -1, -low);
  side.meet(stretch, near, direction);
  return entry_of(stretch, before);
}

std::optional<Entry> enters_ball(double height, double radius, const Vec3& from, const Vec3& direction) {
  const Vec3 center(0, height, 0);
  if ((from - center).norm() <= radius) return from_within();
  Stretch stretch;
  meet_ball(stretch, center, radius, from, direction);
  return entry_of(stretch, 0);
}

}  // namespace

std::optional<Entry> enters(const Cylinder& cylinder, const Vec3& from, const Vec3& direction) {
  return enters_between({cylinder.radius, 0}, -cylinder.half_height, cylinder.half_height, from, direction);
}

std::optional<Entry> enters(const Cone& cone, const Vec3& from, const Vec3& direction) {
  return enters_between({0.5 * cone.radius, 0.5 * cone.radius / cone.half_height}, -cone.half_height, cone.half_height,
                        from, direction);
}

/// Both balls, and the cone between the circles where the side touches them.
std::optional<Entry> enters(const TaperedCapsule& capsule, const Vec3& from, const Vec3& direction) {
  const double lean = (capsule.bottom_radius - capsule.top_radius) / (2 * capsule.half_height);
  const double upright = std::sqrt(std::max(0.0, 1 - lean * lean));
  const double low = -capsule.half_height + capsule.bottom_radius * lean,
               high = capsule.half_height + capsule.top_radius * lean;
  std::optional<Entry> first;
  const auto take = [&first](const std::optional<Entry>& entry) {
    if (entry && (!first || entry->distance < first->distance || entry->inside)) first = entry;
  };
  take(enters_ball(-capsule.half_height, capsule.bottom_radius, from, direction));
  take(enters_ball(capsule.half_height, capsule.top_radius, from, direction));
  if (upright > 0 && high > low) {
    const double fall = lean / upright;
    const double radius = capsule.bottom_radius * upright + fall * low;
    take(enters_between({radius, fall}, low, high, from, direction));
  }
  return first;
}

}  // namespace tweenfall::queries
