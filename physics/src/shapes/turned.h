#pragma once

/// Solids of revolution about y: cylinder, cone, and capsule with two radii.

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// Mass properties of a solid of revolution, for a density of 1.
struct TurnedMeasures {
  double volume = 0;             ///< m^3
  double center = 0;             ///< of mass, on the axis, m
  double along = 0, across = 0;  ///< moments about the center of mass, about the axis and perpendicular to it, m^5
};

[[nodiscard]] TurnedMeasures measures_of(const Cylinder& cylinder) noexcept;
[[nodiscard]] TurnedMeasures measures_of(const Cone& cone) noexcept;
[[nodiscard]] TurnedMeasures measures_of(const TaperedCapsule& capsule) noexcept;

/// Sine and cosine of the angle by which a tapered capsule's side leans: its normal rises by the sine.
struct Taper {
  double sine, cosine;
};
[[nodiscard]] Taper taper_of(const TaperedCapsule& capsule) noexcept;

/// The farthest point of a solid along a direction, in its own space; the direction need not be a unit vector.
[[nodiscard]] Vec3 farthest(const Cylinder& cylinder, const Vec3& direction) noexcept;
[[nodiscard]] Vec3 farthest(const Cone& cone, const Vec3& direction) noexcept;
[[nodiscard]] Vec3 farthest(const TaperedCapsule& capsule, const Vec3& direction) noexcept;

/// Farthest point from the center of mass, m.
[[nodiscard]] double radius_of(const Cylinder& cylinder) noexcept;
[[nodiscard]] double radius_of(const Cone& cone) noexcept;
[[nodiscard]] double radius_of(const TaperedCapsule& capsule) noexcept;

/// The radius with which a solid's surface rolls around a point of it: how far the center or the axis is behind it
/// along the normal, if the surface is round there; 0 on flat faces, edges and tips, and for other solids.
[[nodiscard]] double rolling_radius(const Solid& solid, const Vec3& place, const Vec3& normal) noexcept;

}  // namespace tweenfall::shapes
