#pragma once

// Animations of an assimp scene.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <map>
#include <string>

struct aiScene;

namespace tweenfall::assimp {

/// Clips whose tracks drive the model's nodes; keys are joined by straight lines and shortest arcs, as assimp gives
/// them.
/// @param nodes  index of the first node of each of assimp's names
[[nodiscard]] std::vector<Clip> scene_clips(const aiScene& scene, const Model& model,
                                            const std::map<std::string, std::size_t>& nodes,
                                            models::ModelProblems& problems);

}  // namespace tweenfall::assimp
