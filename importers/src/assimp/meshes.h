#pragma once

// Meshes and skins of an assimp scene.

#include "model/model_problems.h"

#include <tweenfall/importers/model.h>

#include <map>
#include <string>
#include <vector>

struct aiScene;

namespace tweenfall::assimp {

/// The scene's meshes in its own order, each with the skin made from its bones; no_node for none.
struct SceneMeshes {
  std::vector<Mesh> meshes;
  std::vector<std::size_t> skin_of;
  std::vector<Skin> skins;
};

/// @param nodes  index of the first node of each name
[[nodiscard]] SceneMeshes scene_meshes(const aiScene& scene, const std::map<std::string, std::size_t>& nodes,
                                       models::ModelProblems& problems);

}  // namespace tweenfall::assimp
