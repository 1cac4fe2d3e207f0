#pragma once

// The "meshes" and "materials" of a glTF document, and where its nodes wear them.

#include "buffer_writer.h"

#include <tweenfall/importers/model.h>

namespace tweenfall::gltf {

/// Adds meshes and materials, and "mesh" and "skin" to the nodes of `document`; meshes that cannot share their node
/// with an earlier one get a child node of their own.
void write_meshes(const Model& model, nlohmann::json& document, BufferWriter& buffer);

}  // namespace tweenfall::gltf
