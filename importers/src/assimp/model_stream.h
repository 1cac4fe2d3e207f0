#pragma once

// A model as bytes, for the transfer from the helper to its caller. Keys are joined by straight lines and shortest
// arcs, as in all that assimp reads.

#include <tweenfall/importers/model.h>

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall::assimp {

[[nodiscard]] std::string bytes_of(const Model& model);

/// Empty where the bytes break off or contradict themselves: the sender may have been taken over by a hostile file.
[[nodiscard]] std::optional<Model> model_of(std::string_view bytes);

}  // namespace tweenfall::assimp
