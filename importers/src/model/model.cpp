#include "assimp/helper.h"
#include "bvh/reader.h"
#include "fbx/reader.h"
#include "gltf/read/reader.h"
#include "model/model_bytes.h"
#include "model/model_problems.h"

#include <tweenfall/importers/model.h>
#include <tweenfall/importers/shown_text.h>

#include <new>

namespace tweenfall {

namespace models {
namespace {

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

Model read_any(const std::string& bytes, const std::filesystem::path& file, ModelProblems& problems) {
  const std::string ending = ending_of(file);
  if (ending == ".glb" || ending == ".gltf" || bytes.starts_with("glTF")) return gltf::read(bytes, file, problems);
  if (ending == ".bvh") return bvh::read_bvh(bytes, file, problems);
  if (ending == ".fbx") return fbx::read(bytes, file, problems);
  if (ending == ".dae" || ending == ".obj") return assimp::read_in_helper(bytes, file, problems);
  throw ModelError(file.string() + ": error: files ending in \"" + ending +
                   "\" cannot be read; .glb, .gltf, .fbx, .bvh, .dae and .obj can");
}

Model read_file(const std::filesystem::path& file) {
  try {
    std::string reason;
    const auto bytes = model_bytes(file, reason);
    if (!bytes) throw ModelError(file.string() + ": error: " + reason);
    ModelProblems problems;
    Model model = read_any(*bytes, file, problems);
    model.name = utf8_text(file.stem().string());
    model.repairs = problems.repairs();
    return model;
  } catch (const ModelError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw ModelError(file.string() + ": error: needs more memory than there is");
  } catch (const std::exception& error) {
    throw ModelError(file.string() + ": error: " + error.what());
  }
}

}  // namespace
}  // namespace models

Model load_model(const std::filesystem::path& file) {
  try {
    Model model = models::read_file(file);
    for (std::string& repair : model.repairs) repair = terminal_text(repair);
    return model;
  } catch (const ModelError& error) {
    // Messages of readers quote the file's bytes, which can be anything.
    throw ModelError(terminal_lines(error.what()));
  }
}

}  // namespace tweenfall
