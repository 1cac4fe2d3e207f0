#pragma once

// Solids as triangles.

#include <tweenfall/anim/mesh.h>
#include <tweenfall/physics/shape.h>

namespace tweenfall::figures {

/// The surface of `shape` in its node's space, with normals; a plane as a square of 20 m around its nearest point to
/// the origin.
[[nodiscard]] Mesh shape_mesh(const Shape& shape);

}  // namespace tweenfall::figures
