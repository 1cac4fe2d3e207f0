#pragma once

// A geometry of an FBX file as triangles, and the control point of each vertex.

#include "fbx/objects.h"

#include <tweenfall/anim/mesh.h>

#include <vector>

namespace tweenfall::fbx {

/// Triangles of one color.
struct Part {
  Mesh mesh;
  std::vector<std::uint32_t> control_points;  ///< one per vertex
};

struct Geometry {
  std::size_t control_points = 0;  ///< number of control points
  std::vector<Part> parts;         ///< one per color of the materials
};

/// @param colors  of the node's materials, in order
/// @throws ModelError with the place of an index beyond its list.
[[nodiscard]] Geometry read_geometry(const Object& geometry, const std::vector<Color>& colors, const Objects& objects,
                                     models::ModelProblems& problems);

/// The base color of a material.
[[nodiscard]] Color base_color(const Object& material, const Objects& objects);

/// The color without any material.
[[nodiscard]] Color plain_color();

}  // namespace tweenfall::fbx
