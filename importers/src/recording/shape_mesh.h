#pragma once

// The surface of a solid as triangles, for files that draw bodies.

#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/shape.h>

namespace tweenfall {

/// Triangles of the shape in its node's space, counter-clockwise seen from outside, with normals. A plane becomes a
/// square of 20 m.
[[nodiscard]] Mesh shape_mesh(const Shape& shape);

}  // namespace tweenfall
