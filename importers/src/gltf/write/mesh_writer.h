#pragma once

// The meshes and materials of a model in glTF's form, and the nodes that have them.

#include "gltf/write/buffer_writer.h"

#include <tweenfall/importers/model.h>

#include <array>
#include <map>
#include <optional>

namespace tweenfall::gltf {

/// Accessors by the names of the attributes.
using Attributes = std::map<std::string, std::size_t>;

struct WrittenPrimitive {
  Attributes attributes;
  std::size_t indices = 0, material = 0;
  std::vector<Attributes> targets;  ///< one for each morph target
};

struct WrittenMesh {
  std::string name;
  std::vector<WrittenPrimitive> primitives;
  std::vector<double> weights;  ///< with as many names, or both empty
  std::vector<std::string> target_names;
};

/// The mesh of a node: indices of a written mesh and of the model's skins.
struct Worn {
  std::size_t mesh = 0;
  std::optional<std::size_t> skin;
};

/// A node beyond those of the model.
struct ExtraNode {
  std::size_t parent = 0;
  std::string name;
};

struct WrittenMeshes {
  std::vector<WrittenMesh> meshes;
  std::vector<std::array<double, 4>> materials;  ///< base colors, each part 0 to 1
  std::vector<ExtraNode> extra_nodes;            ///< their indices follow those of the model's nodes
  std::map<std::size_t, Worn> worn;              ///< by node
};

/// Meshes that cannot share their node with an earlier one get a child node of their own.
[[nodiscard]] WrittenMeshes write_meshes(const Model& model, BufferWriter& buffer);

}  // namespace tweenfall::gltf
