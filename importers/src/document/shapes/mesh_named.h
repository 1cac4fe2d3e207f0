#pragma once

// Meshes from a document's imports, by name.

#include <tweenfall/curves/surface_mesh.h>

#include "document/content.h"

#include <optional>

namespace tweenfall::document::shapes {

// The mesh of the imported node of that name, in the node's own space; or all meshes of the import of that name, at
// rest in its file's space. Empty where there is none, which is reported.
[[nodiscard]] std::optional<SurfaceMesh> mesh_named(const json::Value& name, Building& building);

}  // namespace tweenfall::document::shapes
