#pragma once

/// Simple solids around meshes: what collides in their place. Each comes with its place in the mesh's space.

#include <tweenfall/physics/shape.h>

#include <optional>
#include <span>

namespace tweenfall {

// All throw std::invalid_argument for points that are not finite and for those that span no volume.

/// The convex hull of any number of points. Where more than `most` of them are its vertices, that of those which stand
/// out most: the others then lie outside of it by little.
/// @param most  4 to `ConvexHull::most_vertices`
[[nodiscard]] ConvexHull hull_around(std::span<const Vec3> points, std::size_t most = ConvexHull::most_vertices);

/// The smallest box found about all of the points: flush with a face of their hull and one of its edges, or along their
/// principal axes, and turned a little from there where that is smaller.
[[nodiscard]] Shape box_around(std::span<const Vec3> points);

/// The smallest capsule found about nearly all of the points, along one of their principal axes: of a tenth of them it
/// may be too thin, and for two in a hundred too short at either end.
/// @param along  an axis to be preferred; of any length but 0
[[nodiscard]] Shape capsule_around(std::span<const Vec3> points, const std::optional<Vec3>& along = {});

}  // namespace tweenfall
