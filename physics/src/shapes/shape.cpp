#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/shape.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "collision/surfaces/surface.h"
#include "shapes/compound.h"
#include "shapes/placed.h"
#include "shapes/turned.h"

namespace tweenfall {

namespace shapes {
namespace {

constexpr double pi = std::numbers::pi;

void require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value))
    throw std::invalid_argument(std::string(name) + " must be positive and finite, but is " + number_text(value));
}

void require_two_balls(const TaperedCapsule& capsule) {
  require_positive(capsule.bottom_radius, "bottom radius of a tapered capsule");
  require_positive(capsule.top_radius, "top radius of a tapered capsule");
  require_positive(capsule.half_height, "half height of a tapered capsule");
  const bool bottom = capsule.bottom_radius > capsule.top_radius;
  if (std::abs(capsule.bottom_radius - capsule.top_radius) < 2 * capsule.half_height) return;
  throw std::invalid_argument(
      std::string("the ") + (bottom ? "bottom" : "top") + " ball of a tapered capsule, of radius " +
      number_text(bottom ? capsule.bottom_radius : capsule.top_radius) + ", contains its other ball, of radius " +
      number_text(bottom ? capsule.top_radius : capsule.bottom_radius) + " and " +
      number_text(2 * capsule.half_height) + " m away; set them farther apart, or make it a sphere");
}

/// Principal moments about the solid's own center.
Vec3 principal_inertia(const Sphere& sphere, double mass) {
  return Vec3::Constant(0.4 * mass * sphere.radius * sphere.radius);
}

Vec3 principal_inertia(const Box& box, double mass) {
  const Vec3 square = box.half_extents.cwiseProduct(box.half_extents);
  return mass / 3 * Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
}

Vec3 principal_inertia(const Capsule& capsule, double mass) {
  const double radius = capsule.radius;
  const double height = 2 * capsule.half_height;
  // Volumes divided by pi r^2: the cylinder's is its height, that of the two half balls together 4/3 r.
  const double balls = 4 * radius / 3;
  const double cylinder_mass = mass * height / (height + balls);
  const double balls_mass = mass * balls / (height + balls);
  const double square = radius * radius;
  const double along = cylinder_mass * square / 2 + balls_mass * 0.4 * square;
  // A half ball's center of mass lies 3/8 r above its flat side; both are moved out to the cylinder's ends.
  const double across = cylinder_mass * (square / 4 + height * height / 12) +
                        balls_mass * (0.4 * square + height * height / 4 + 3 * height * radius / 8);
  return {across, along, across};
}

}  // namespace
}  // namespace shapes

void validate(const Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&solid)) {
    shapes::require_positive(sphere->radius, "radius of a sphere");
  } else if (const auto* box = std::get_if<Box>(&solid)) {
    shapes::require_positive(box->half_extents.x(), "half extent x of a box");
    shapes::require_positive(box->half_extents.y(), "half extent y of a box");
    shapes::require_positive(box->half_extents.z(), "half extent z of a box");
  } else if (const auto* capsule = std::get_if<Capsule>(&solid)) {
    shapes::require_positive(capsule->radius, "radius of a capsule");
    if (!(capsule->half_height >= 0) || !std::isfinite(capsule->half_height))
      throw std::invalid_argument("half height of a capsule must not be negative and must be finite, but is " +
                                  number_text(capsule->half_height));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&solid)) {
    shapes::require_positive(cylinder->radius, "radius of a cylinder");
    shapes::require_positive(cylinder->half_height, "half height of a cylinder");
  } else if (const auto* cone = std::get_if<Cone>(&solid)) {
    shapes::require_positive(cone->radius, "radius of a cone");
    shapes::require_positive(cone->half_height, "half height of a cone");
    // On its side a flatter one rests on one point at a time, and sinks in.
    constexpr double flattest = 1e-3;
    if (!(cone->half_height >= flattest * cone->radius))
      throw std::invalid_argument("half height of a cone must be at least a thousandth of its radius, but is " +
                                  number_text(cone->half_height) + " of " + number_text(cone->radius) +
                                  ": use a cylinder");
  } else if (const auto* tapered = std::get_if<TaperedCapsule>(&solid)) {
    shapes::require_two_balls(*tapered);
  } else if (const auto* plane = std::get_if<Plane>(&solid)) {
    const double length = plane->normal.norm();
    if (!(std::abs(length - 1) <= 1e-6))
      throw std::invalid_argument("normal of a plane must have length 1, but has " + number_text(length));
    if (!std::isfinite(plane->offset))
      throw std::invalid_argument("offset of a plane must be finite, but is " + number_text(plane->offset));
  }
}

bool is_scenery(const Solid& solid) noexcept {
  return std::holds_alternative<Plane>(solid) || surfaces::surface_of(solid) != nullptr;
}

const char* kind_name(const Solid& solid) noexcept {
  struct Names {
    const char* operator()(const Sphere&) const { return "a sphere"; }
    const char* operator()(const Box&) const { return "a box"; }
    const char* operator()(const Capsule&) const { return "a capsule"; }
    const char* operator()(const Plane&) const { return "a plane"; }
    const char* operator()(const Hull&) const { return "a hull"; }
    const char* operator()(const Cylinder&) const { return "a cylinder"; }
    const char* operator()(const Cone&) const { return "a cone"; }
    const char* operator()(const TaperedCapsule&) const { return "a tapered capsule"; }
    const char* operator()(const Compound&) const { return "a compound"; }
    const char* operator()(const TriangleMesh&) const { return "a triangle mesh"; }
    const char* operator()(const HeightField&) const { return "a height field"; }
  };
  return std::visit(Names{}, solid);
}

double volume(const Solid& solid) noexcept {
  if (const auto* sphere = std::get_if<Sphere>(&solid)) {
    return 4 * shapes::pi / 3 * sphere->radius * sphere->radius * sphere->radius;
  }
  if (const auto* box = std::get_if<Box>(&solid)) return 8 * box->half_extents.prod();
  if (const auto* capsule = std::get_if<Capsule>(&solid)) {
    return shapes::pi * capsule->radius * capsule->radius * (2 * capsule->half_height + 4 * capsule->radius / 3);
  }
  if (const auto* hull = std::get_if<Hull>(&solid)) return hull->convex.measures().volume;
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) return shapes::measures_of(*cylinder).volume;
  if (const auto* cone = std::get_if<Cone>(&solid)) return shapes::measures_of(*cone).volume;
  if (const auto* tapered = std::get_if<TaperedCapsule>(&solid)) return shapes::measures_of(*tapered).volume;
  if (const auto* compound = std::get_if<Compound>(&solid)) return shapes::volume_of(*compound);
  return std::numeric_limits<double>::infinity();
}

MassProperties mass_properties(const Shape& shape, double mass) {
  validate(shape.solid);
  shapes::require_positive(mass, "mass");
  Vec3 center(0, 0, 0);
  Mat3 inertia;
  const auto take = [&](const shapes::TurnedMeasures& measures) {
    center = Vec3(0, measures.center, 0);
    inertia = (mass / measures.volume * Vec3(measures.across, measures.along, measures.across)).asDiagonal();
  };
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) {
    inertia = shapes::principal_inertia(*sphere, mass).asDiagonal();
  } else if (const auto* box = std::get_if<Box>(&shape.solid)) {
    inertia = shapes::principal_inertia(*box, mass).asDiagonal();
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    inertia = shapes::principal_inertia(*capsule, mass).asDiagonal();
  } else if (const auto* hull = std::get_if<Hull>(&shape.solid)) {
    const MeshMeasures& measures = hull->convex.measures();
    center = measures.center;
    inertia = mass / measures.volume * measures.inertia;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.solid)) {
    take(shapes::measures_of(*cylinder));
  } else if (const auto* cone = std::get_if<Cone>(&shape.solid)) {
    take(shapes::measures_of(*cone));
  } else if (const auto* tapered = std::get_if<TaperedCapsule>(&shape.solid)) {
    take(shapes::measures_of(*tapered));
  } else if (const auto* compound = std::get_if<Compound>(&shape.solid)) {
    const MassProperties whole = shapes::mass_of(*compound, mass);
    center = whole.center;
    inertia = whole.inertia;
  } else {
    throw std::invalid_argument(std::string(kind_name(shape.solid)) +
                                " has no mass: only fixed and keyed bodies can be of this shape");
  }
  const Mat3 axes = shape.offset.rotation.toRotationMatrix();
  MassProperties properties;
  properties.mass = mass;
  properties.center = shape.offset.position + axes * center;
  properties.inertia = axes * inertia * axes.transpose();
  // Rounding leaves the two triangles of the matrix an ulp apart.
  properties.inertia = (0.5 * (properties.inertia + properties.inertia.transpose())).eval();
  return properties;
}

Mat3 inertia_about(const MassProperties& properties, const Vec3& point) noexcept {
  const Vec3 arm = point - properties.center;
  const Mat3 shift = arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
  return properties.inertia + properties.mass * shift;
}

namespace shapes {
namespace {

/// For shapes with a farthest point along every direction.
template <class Turned>
Bounds turned_bounds(const Turned& solid, const Placed& placed) {
  Bounds result{placed.center, placed.center};
  for (int i = 0; i < 3; ++i) {
    const Vec3 along = placed.axes.row(i);
    result.high[i] += along.dot(farthest(solid, along));
    result.low[i] += along.dot(farthest(solid, -along));
  }
  return result;
}

}  // namespace
}  // namespace shapes

Bounds bounds(const Shape& shape, const Pose& node) noexcept {
  const shapes::Placed placed = shapes::place(shape, node);
  Vec3 reach = Vec3::Constant(std::numeric_limits<double>::infinity());
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) {
    reach = Vec3::Constant(sphere->radius);
  } else if (const auto* box = std::get_if<Box>(&shape.solid)) {
    reach = placed.axes.cwiseAbs() * box->half_extents;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    reach = placed.axes.col(1).cwiseAbs() * capsule->half_height + Vec3::Constant(capsule->radius);
  } else if (const auto* hull = std::get_if<Hull>(&shape.solid)) {
    Bounds result{reach, -reach};
    for (const Vec3& vertex : hull->convex.vertices()) {
      const Vec3 point = placed.axes * vertex;
      result.low = result.low.cwiseMin(point);
      result.high = result.high.cwiseMax(point);
    }
    return {placed.center + result.low, placed.center + result.high};
  } else if (const auto* plane = std::get_if<Plane>(&shape.solid)) {
    Bounds result{-reach, reach};
    // A half space is bounded in a direction only if the normal lies along it.
    const Vec3 normal = placed.axes * plane->normal;
    const Vec3 surface = placed.center + normal * plane->offset;
    for (int i = 0; i < 3; ++i) {
      if (normal[i] == 1) result.high[i] = surface[i];
      if (normal[i] == -1) result.low[i] = surface[i];
    }
    return result;
  }
  if (const surfaces::Surface* surface = surfaces::surface_of(shape.solid))
    return surface->bounds(placed.center, placed.axes);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.solid)) return shapes::turned_bounds(*cylinder, placed);
  if (const auto* cone = std::get_if<Cone>(&shape.solid)) return shapes::turned_bounds(*cone, placed);
  if (const auto* tapered = std::get_if<TaperedCapsule>(&shape.solid)) return shapes::turned_bounds(*tapered, placed);
  if (const auto* compound = std::get_if<Compound>(&shape.solid)) return shapes::bounds_of(*compound, shape, node);
  return {placed.center - reach, placed.center + reach};
}

}  // namespace tweenfall

namespace tweenfall::shapes {

namespace {

double support_of(const Sphere& sphere, const Mat3&, const Vec3&) {
  return sphere.radius;
}
double support_of(const Box& box, const Mat3& axes, const Vec3& direction) {
  return (axes.transpose() * direction).cwiseAbs().dot(box.half_extents);
}
double support_of(const Capsule& capsule, const Mat3& axes, const Vec3& direction) {
  return std::abs(axes.col(1).dot(direction)) * capsule.half_height + capsule.radius;
}
double support_of(const Plane& plane, const Mat3& axes, const Vec3& direction) {
  const bool out = (axes * plane.normal - direction).squaredNorm() < 1e-24;
  return out ? plane.offset : std::numeric_limits<double>::infinity();
}
double support_of(const Hull& hull, const Mat3& axes, const Vec3& direction) {
  const Vec3 local = axes.transpose() * direction;
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : hull.convex.vertices()) most = std::max(most, local.dot(vertex));
  return most;
}

double support_of(const Compound&, const Mat3&, const Vec3&) {
  return std::numeric_limits<double>::infinity();  // its parts are handled one by one
}

double support_of(const TriangleMesh&, const Mat3&, const Vec3&) {
  return std::numeric_limits<double>::infinity();  // its triangles are handled one by one
}
double support_of(const HeightField&, const Mat3&, const Vec3&) {
  return std::numeric_limits<double>::infinity();
}

template <class Turned>
double support_of(const Turned& solid, const Mat3& axes, const Vec3& direction) {
  const Vec3 local = axes.transpose() * direction;
  return local.dot(farthest(solid, local));
}

}  // namespace

double support_along(const Solid& solid, const Mat3& axes, const Vec3& direction) {
  return std::visit([&](const auto& one) { return support_of(one, axes, direction); }, solid);
}

}  // namespace tweenfall::shapes
