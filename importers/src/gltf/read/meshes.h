#pragma once

// Meshes, materials' base colors and skins of a glTF document.

#include "gltf/read/accessors.h"

#include <tweenfall/anim/mesh.h>

#include <vector>

namespace tweenfall::gltf {

/// A mesh of the file: one of our meshes for each primitive made of triangles.
struct FileMesh {
  std::vector<Mesh> primitives;
  std::size_t morphs = 0;                 ///< number of targets of every primitive
  std::vector<std::size_t> joint_counts;  ///< for each primitive, one more than the largest joint used
};

[[nodiscard]] std::vector<FileMesh> read_meshes(const Fields& root, Accessors& accessors);

/// Skins whose joints are indices of the file's nodes.
[[nodiscard]] std::vector<Skin> read_skins(const Fields& root, Accessors& accessors);

}  // namespace tweenfall::gltf
