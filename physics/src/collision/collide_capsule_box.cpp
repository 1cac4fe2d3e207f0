#include <algorithm>
#include <array>
#include <cmath>

#include "collision/collide_pairs.h"

namespace tweenfall::collision {

namespace {

/// The capsule's axis in the box's own space.
struct Segment {
  Vec3 center, direction;
  double half;
  [[nodiscard]] Vec3 at(double t) const { return center + t * direction; }
};

Vec3 closest_in_box(const Vec3& point, const Vec3& half_extents) {
  return point.cwiseMax(-half_extents).cwiseMin(half_extents);
}

/// Half the derivative of the squared distance to the box along the segment: it never falls.
double slope(const Segment& segment, const Vec3& half_extents, double t) {
  const Vec3 point = segment.at(t);
  return segment.direction.dot(point - closest_in_box(point, half_extents));
}

/// Where on the segment the box is nearest; the middle of the stretch when several points are.
double nearest_on_segment(const Segment& segment, const Vec3& half_extents) {
  // The slope is linear between these.
  std::array<double, 8> knots;
  std::size_t count = 0;
  knots[count++] = -segment.half;
  for (int i = 0; i < 3; ++i) {
    if (segment.direction[i] == 0) continue;
    for (const double side : {-1.0, 1.0}) {
      const double t = (side * half_extents[i] - segment.center[i]) / segment.direction[i];
      if (t > -segment.half && t < segment.half) knots[count++] = t;
    }
  }
  knots[count++] = segment.half;
  std::sort(knots.begin(), knots.begin() + static_cast<std::ptrdiff_t>(count));
  const double flat = 1e-9 * half_extents.maxCoeff();
  const auto zero = [&](bool last) {
    // First place where the slope is no longer below -flat, or last where it is not yet above flat.
    const double level = last ? flat : -flat;
    double previous = slope(segment, half_extents, knots[0]);
    if (previous >= level) return knots[0];
    for (std::size_t i = 1; i < count; ++i) {
      const double value = slope(segment, half_extents, knots[i]);
      if (value >= level) {
        const double rise = value - previous;
        return rise > 0 ? knots[i - 1] + (knots[i] - knots[i - 1]) * (level - previous) / rise : knots[i];
      }
      previous = value;
    }
    return knots[count - 1];
  };
  return 0.5 * (zero(false) + zero(true));
}

struct WayOut {
  double separation = 0;  ///< of the axis from the box, m
  Vec3 normal{0, 0, 0};   ///< out of the box, box space
  int face = -1;          ///< axis of the face, or -1 for an edge
  int edge = -1;          ///< axis of the box's edges
};

/// The way out when the axis runs through the box: the shortest along face normals and edge crosses.
WayOut way_out(const Segment& segment, const Vec3& half_extents) {
  WayOut best;
  best.separation = -1e300;
  const double preference = 1e-3 * half_extents.minCoeff();
  for (int i = 0; i < 3; ++i) {
    const double reach = std::abs(segment.direction[i]) * segment.half;
    const double separation = std::abs(segment.center[i]) - half_extents[i] - reach;
    if (separation > best.separation + (i == 0 ? 0 : 0.1 * preference)) {
      best = {separation, Vec3::Unit(i) * (segment.center[i] < 0 ? -1.0 : 1.0), i, -1};
    }
  }
  for (int i = 0; i < 3; ++i) {
    Vec3 axis = segment.direction.cross(Vec3::Unit(i));
    const double length = axis.norm();
    if (length < 1e-3) continue;
    axis /= length;
    if (axis.dot(segment.center) < 0) axis = -axis;
    const double separation = axis.dot(segment.center) - axis.cwiseAbs().dot(half_extents);
    if (separation > best.separation + preference) best = {separation, axis, -1, i};
  }
  return best;
}

}  // namespace

Manifold collide(const Box& a, const shapes::Placed& at_a, const Capsule& b, const shapes::Placed& at_b,
                 double margin) {
  const Mat3 into = at_a.axes.transpose();
  const Segment segment{into * (at_b.center - at_a.center), into * at_b.axes.col(1), b.half_height};
  const double t = nearest_on_segment(segment, a.half_extents);
  const Vec3 on_axis = segment.at(t);
  const Vec3 on_box = closest_in_box(on_axis, a.half_extents);
  const Vec3 between = on_axis - on_box;
  const double distance = between.norm();

  WayOut contact;
  if (distance > 1e-9 * a.half_extents.maxCoeff()) {
    contact.separation = distance;
    contact.normal = between / distance;
    int axis = 0;
    contact.normal.cwiseAbs().maxCoeff(&axis);
    // A normal this close to a face's, of an axis this close to parallel: lying on the face, over its edge or not.
    if (std::abs(contact.normal[axis]) > 0.98) {
      contact.face = axis;
    }
  } else {
    contact = way_out(segment, a.half_extents);
  }

  Manifold manifold;
  manifold.normal = at_a.axes * contact.normal;
  const auto add = [&](const Vec3& axis_point, const Vec3& normal, double separation, std::uint32_t feature) {
    const double penetration = b.radius - separation;
    const Vec3 middle = axis_point - normal * (b.radius - 0.5 * penetration);
    add_point(manifold, at_a.center + at_a.axes * middle, penetration, feature, margin);
  };
  if (contact.face >= 0) {
    // The stretch of the axis above the face; both its ends carry.
    double low = -segment.half;
    double high = segment.half;
    for (int i = 0; i < 3; ++i) {
      if (i == contact.face || segment.direction[i] == 0) continue;
      const double first = (-a.half_extents[i] - segment.center[i]) / segment.direction[i];
      const double second = (a.half_extents[i] - segment.center[i]) / segment.direction[i];
      low = std::max(low, std::min(first, second));
      high = std::min(high, std::max(first, second));
    }
    const bool above = low < high || (segment.half == 0 && distance > 0 && contact.normal.cwiseAbs().maxCoeff() == 1);
    if (above) {
      const Vec3 normal = Vec3::Unit(contact.face) * (contact.normal[contact.face] < 0 ? -1.0 : 1.0);
      manifold.normal = at_a.axes * normal;
      const bool upside = segment.direction[contact.face] != 0 && std::abs(segment.direction[contact.face]) > 0.5;
      std::uint32_t feature = 1;
      for (const double place : {low, high}) {
        const Vec3 point = segment.at(place);
        add(point, normal, normal.dot(point) - a.half_extents[contact.face], feature++);
        if (segment.half == 0 || (upside && low == high)) break;
      }
      if (manifold.count > 0) return manifold;
      manifold.normal = at_a.axes * contact.normal;
    }
  }
  if (distance > 1e-9 * a.half_extents.maxCoeff()) {
    add(on_axis, contact.normal, distance, 0);
    return manifold;
  }
  if (contact.edge >= 0) {
    // The box's edge that faces the way out, and the place on the axis nearest to it.
    Vec3 corner = a.half_extents;
    for (int i = 0; i < 3; ++i)
      if (contact.normal[i] < 0) corner[i] = -corner[i];
    Vec3 offset = corner - segment.center;
    offset[contact.edge] = 0;
    Vec3 flat = segment.direction;
    flat[contact.edge] = 0;
    const double place = std::clamp(flat.dot(offset) / flat.squaredNorm(), -segment.half, segment.half);
    add(segment.at(place), contact.normal, contact.separation, 0);
    return manifold;
  }
  // The deeper end, out through the face.
  const double side = contact.normal.dot(segment.direction) > 0 ? -1 : 1;
  const Vec3 point = segment.at(side * segment.half);
  add(point, contact.normal, contact.normal.dot(point) - a.half_extents[contact.face], 0);
  return manifold;
}

}  // namespace tweenfall::collision
