#pragma once

// Bodies and joints of a glTF document with the extensions KHR_implicit_shapes and KHR_physics_rigid_bodies.
// Source: Khronos Group, drafts of the two, 2024.

#include "gltf/read/meshes.h"
#include "gltf/read/nodes.h"

#include <tweenfall/importers/model.h>

#include <span>
#include <vector>

namespace tweenfall::gltf::physics {

/// The parts of the file read so far; indices are those of the file.
struct FileScene {
  const Fields& root;
  std::span<const FileNode> nodes;
  std::span<const FileMesh> meshes;
  std::vector<char> animated;  ///< by node: a clip moves it or an ancestor
};

/// By node: the nearest among itself and its ancestors that has a motion of its own, or `no_node`.
[[nodiscard]] std::vector<std::size_t> movers(const FileScene& scene);

/// The pose of a node in the space of an ancestor, or in the world for `no_node`; scales are multiplied.
[[nodiscard]] Pose pose_within(const FileScene& scene, std::size_t node, std::size_t ancestor);

/// Whatever is not supported here is reported as a repair.
[[nodiscard]] std::vector<ModelBody> read_bodies(const FileScene& scene);
/// @param bodies  those of the same file
[[nodiscard]] std::vector<JointDescription> read_joints(const FileScene& scene, std::span<const ModelBody> bodies);

/// The content of a node's extension; empty for none.
[[nodiscard]] Fields physics_of(const Fields& root, std::size_t node);
/// A finite number; `otherwise` when absent or wrong.
[[nodiscard]] std::optional<double> number_of(const Fields& fields, const char* name);
[[nodiscard]] Vec3 vector_of(const Fields& fields, const char* name, const Vec3& otherwise);

}  // namespace tweenfall::gltf::physics
