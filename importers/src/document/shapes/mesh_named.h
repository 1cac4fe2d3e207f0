#pragma once

// Meshes of a document: written out, or from its imports by name.

#include <tweenfall/curves/surface_mesh.h>

#include "document/content.h"
#include "document/grammar/grammar_parts.h"

#include <optional>

namespace tweenfall::document::shapes {

// The mesh of the imported node of that name, in the node's own space; or all meshes of the import of that name, at
// rest in its file's space. Empty where there is none, which is reported.
[[nodiscard]] std::optional<SurfaceMesh> mesh_named(const json::Value& name, Building& building);

// A mesh written out or named.
[[nodiscard]] const Form* mesh_form(FormStore& store, const ValueForms& values);
// Empty for one that was reported.
[[nodiscard]] std::optional<SurfaceMesh> read_mesh(const json::Value& place, Building& building);

}  // namespace tweenfall::document::shapes
