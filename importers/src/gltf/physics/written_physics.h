#pragma once

// Bodies and joints of a model in the form of the extensions KHR_implicit_shapes and KHR_physics_rigid_bodies.
// Source: Khronos Group, drafts of KHR_implicit_shapes and KHR_physics_rigid_bodies, 2024.

#include "gltf/physics/reduced_mass.h"
#include "gltf/write/buffer_writer.h"

#include <tweenfall/importers/model.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tweenfall::gltf::physics {

inline constexpr const char* shapes_extension = "KHR_implicit_shapes";
inline constexpr const char* bodies_extension = "KHR_physics_rigid_bodies";

/// A node beyond those of the model: a place for a collider or for an end of a joint.
struct PlacedNode {
  std::string name;
  std::size_t parent = no_node;
  Pose pose = {};
  std::optional<std::size_t> mesh{};
  bool in_scene = true;
};

/// The accessors of a mesh for collisions that is not drawn.
struct ColliderMesh {
  std::size_t positions = 0, indices = 0;
};

struct WrittenPhysics {
  std::vector<PlacedNode> nodes;                ///< their indices follow the existing ones
  std::vector<ColliderMesh> meshes;             ///< likewise
  std::map<std::size_t, std::string> of_nodes;  ///< by node, the content of its extension as JSON
  std::string shapes, physics;                  ///< content of the document's extensions as JSON; empty without bodies
};

/// @param nodes, meshes the numbers that the document has already
[[nodiscard]] WrittenPhysics write_physics(const Model& model, std::size_t nodes, std::size_t meshes,
                                           BufferWriter& buffer);

/// Limits and drives of a joint as JSON; empty for kinds that the extension has no form for.
[[nodiscard]] std::string joint_form(const Masses& masses, const JointDescription& joint);

}  // namespace tweenfall::gltf::physics
