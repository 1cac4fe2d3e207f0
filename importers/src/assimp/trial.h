#pragma once

// A file handed to assimp, first in a process of its own: assimp's assertions are compiled in, and a malformed file can
// end the process or overflow its stack. What survives there is read again here.

#include <filesystem>
#include <string>

struct aiScene;
namespace Assimp {
class Importer;
}

namespace tweenfall {

/// How names of Collada nodes are chosen; other formats have only names.
enum class ColladaNames { names, ids };

/// The scene, owned by `importer`. @throws ModelError
[[nodiscard]] const aiScene& import_scene(Assimp::Importer& importer, const std::string& bytes,
                                          const std::filesystem::path& file, ColladaNames names);

/// Lets a child process import the file and reports what happened to it.
/// @throws ModelError when assimp refuses the file, ends the process, or takes more than 30 s of processor time
void try_import(const std::string& bytes, const std::filesystem::path& file);

}  // namespace tweenfall
