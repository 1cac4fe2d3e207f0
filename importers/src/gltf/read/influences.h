#pragma once

// Joints and weights of a primitive's vertices.

#include "gltf/read/accessors.h"

#include <tweenfall/anim/mesh.h>

#include <vector>

namespace tweenfall::gltf {

/// The joints of each vertex, their weights scaled to sum to 1; empty for a primitive without skin.
/// @param joint_count  written: one more than the largest joint with a weight
[[nodiscard]] Influences read_influences(const Fields& attributes, std::size_t vertices, Accessors& accessors,
                                         std::size_t& joint_count);

}  // namespace tweenfall::gltf
