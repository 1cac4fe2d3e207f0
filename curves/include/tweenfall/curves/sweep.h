#pragma once

/// Meshes made by curves: a profile swept along a rail (tubes, tracks, moldings), a profile turned about an axis
/// (vases, wheels, balls).
///
/// A profile is a curve in the plane. If it ends at the point where it began, it is closed; where it kinks, the mesh
/// has an edge, elsewhere smooth normals, exact for the true surface. Knots of both curves become corners; the finer
/// the steps, the nearer the true surface: errors of area and volume shrink with the square of the step.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/surface_mesh.h>

#include <optional>

namespace tweenfall {

struct SweepOptions {
  int rail_steps = 64;           ///< approximate number of rings along the rail; each span has at least one; >= 1
  int profile_steps = 32;        ///< sides of the profile, about: each span has at least one; >= 1
  bool caps = true;              ///< a closed profile on an open rail gets a lid at both ends
  std::optional<Vec3> normal{};  ///< where the profile's x axis points at the rail's start. Absent: any
  double twist = 0;              ///< radians about the rail from start to end; on a closed rail, whole turns only
};

/// The profile carried along the rail in rotation-minimizing frames: x along the normal, y along the binormal.
///
/// The outside is to the right of the profile's direction; a closed profile may run either way. A rail that ends where
/// it began and in the same direction is closed. At a kink of the rail the profile is placed at half the bend. Texture
/// coordinates run from 0 to 1 with the length of the profile and of the rail.
/// @throws std::invalid_argument for an endless or single-point curve, steps < 1, or part of a turn on a closed rail.
[[nodiscard]] SurfaceMesh sweep(const Curve<Vec2>& profile, const Curve<Vec3>& rail, const SweepOptions& options = {});

struct LatheOptions {
  int segments = 48;                    ///< around the axis; >= 3
  int profile_steps = 32;               ///< sides of the profile, about: each span has at least one; >= 1
  double angle = 0x1.921fb54442d18p+2;  ///< radians, above 0 to a whole turn
  bool caps = true;  ///< close the gaps between profile and axis, and the cut faces of a partial turn
};

/// The profile, with x as distance from the y axis and y as height, turned about the y axis from x toward -z.
///
/// The outside is to the right of the profile's direction; if it would face inwards, the mesh is turned inside out.
/// @throws std::invalid_argument for an endless or single-point profile, one that reaches beyond the axis (naming the
///         place), or numbers out of range.
[[nodiscard]] SurfaceMesh lathe(const Curve<Vec2>& profile, const LatheOptions& options = {});

}  // namespace tweenfall
