#pragma once

// A model as bytes, on its way from the helper to whoever asked for it. Curves are joined by straight lines and
// shortest arcs, as all that assimp reads.

#include <tweenfall/importers/model.h>

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall::assimp {

[[nodiscard]] std::string bytes_of(const Model& model);

/// Nothing where the bytes break off or contradict themselves: what sent them may have been taken over by the file.
[[nodiscard]] std::optional<Model> model_of(std::string_view bytes);

}  // namespace tweenfall::assimp
