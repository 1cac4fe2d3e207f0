#pragma once

/// Simple solids around meshes, which collide in their place. Each comes with its pose in the mesh's space.

#include <tweenfall/physics/shape.h>

#include <optional>
#include <span>

namespace tweenfall {

// All throw std::invalid_argument for points that are not finite and for points that span no volume; the capsule takes
// those that lie in one plane, but not on one straight line.

/// The convex hull of any number of points. If it has more than `most` vertices, the hull of those that stand
/// out most: the others then lie slightly outside of it.
/// @param most  4 to `ConvexHull::most_vertices`
[[nodiscard]] ConvexHull hull_around(std::span<const Vec3> points, std::size_t most = ConvexHull::most_vertices);

/// The smallest box found around all points: flush with a face of their hull and one of its edges, or along their
/// principal axes, and turned a little from there if that makes it smaller.
[[nodiscard]] Shape box_around(std::span<const Vec3> points);

/// The smallest capsule found around nearly all points, along one of their principal axes: up to a tenth of them
/// may lie farther from its axis than its radius, and two in a hundred beyond either end. Corners at its round ends
/// stick out of these.
/// @param along  a preferred axis; of any length but 0
[[nodiscard]] Shape capsule_around(std::span<const Vec3> points, const std::optional<Vec3>& along = {});

}  // namespace tweenfall
