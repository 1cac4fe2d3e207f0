#include "assimp/helper.h"

/// Used instead of assimp where that is left out.

namespace tweenfall::assimp {

Model read_in_helper(const std::string&, const std::filesystem::path& file, models::ModelProblems&) {
  throw ModelError(file.string() +
                   ": error: Collada and OBJ are read by assimp, which this tweenfall was built without "
                   "(TWEENFALL_ASSIMP=OFF); build it with assimp, or save the model as .glb, .gltf, .fbx or .bvh");
}

}  // namespace tweenfall::assimp
