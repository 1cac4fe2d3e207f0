#include "assimp/reader.h"

#include "assimp/clips.h"
#include "assimp/memory_files.h"
#include "assimp/meshes.h"
#include "assimp/values.h"
#include "model/model_matrix.h"
#include "model/model_names.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>

#include <charconv>
#include <map>
#include <set>

namespace tweenfall::assimp {

namespace {

/// A node of assimp with the index of its parent in our list.
struct Waiting {
  const aiNode* node;
  std::size_t parent;
};

/// All nodes, parents first; a list instead of recursion, since a file can nest deeper than the stack.
std::vector<Waiting> flattened(const aiNode& root) {
  std::vector<Waiting> all{{&root, no_node}};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (unsigned child = 0; child < all[i].node->mNumChildren; ++child)
      all.push_back({all[i].node->mChildren[child], i});
  return all;
}

bool has_double_names(const std::vector<Waiting>& nodes) {
  std::map<std::string, int> count;
  for (const Waiting& each : nodes)
    if (++count[text_of(each.node->mName)] > 1) return true;
  return false;
}

Pose rest_of(const aiNode& node, const std::string& name, models::ModelProblems& problems) {
  const Mat3 linear = linear_of(node.mTransformation);
  const Vec3 translation = translation_of(node.mTransformation);
  if (!models::is_finite(linear) || !translation.allFinite()) {
    problems.add("node \"" + name + "\"", "its placement is not finite");
    return {};
  }
  const models::TakenApart parts = models::take_apart(linear, translation);
  if (parts.shear > 1e-4)
    problems.repair("node \"" + name + "\"", "its placement holds shear, which was dropped; it moved points by up to " +
                                                 number_text(parts.shear) + " of their distance");
  return parts.pose;
}

/// How names of Collada nodes are chosen; other formats have only names.
enum class ColladaNames { names, ids };

/// The scene, owned by `importer`. @throws ModelError
const aiScene& import_scene(Assimp::Importer& importer, const std::string& bytes, const std::filesystem::path& file,
                            ColladaNames names, std::vector<std::string>& missing) {
  missing.clear();
  importer.SetIOHandler(memory_files(bytes, file, missing).release());
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, names == ColladaNames::names);
  const unsigned steps =
      aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs | aiProcess_ValidateDataStructure;
  const aiScene* scene = importer.ReadFile(file.string(), steps);
  if (!scene || !scene->mRootNode) throw ModelError(file.string() + ": error: " + importer.GetErrorString());
  return *scene;
}

/// Collada states counts, for which assimp allocates memory before it has seen the numbers.
void check_counts(const std::string& bytes, const std::filesystem::path& file) {
  for (std::size_t at = bytes.find("count=\""); at != std::string::npos; at = bytes.find("count=\"", at + 1)) {
    std::uint64_t count = 0;
    const char *begin = bytes.data() + at + 7, *end = bytes.data() + bytes.size();
    const auto read = std::from_chars(begin, end, count);
    // A number takes at least one digit, and all but the last a blank.
    if (read.ec == std::errc() && count <= bytes.size() / 2 + 1) continue;
    if (read.ec == std::errc::invalid_argument) continue;
    const json::TextPlace place = json::place_in(bytes, at);
    throw ModelError(file.string() + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                     ": error: a count of " + std::string(begin, read.ptr) + " cannot be in a file of " +
                     std::to_string(bytes.size()) + " bytes");
  }
}

std::string without_leading_space(const std::string& bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? std::string() : bytes.substr(first);
}

}  // namespace

Model read(const std::string& given, const std::filesystem::path& file, models::ModelProblems& problems) {
  std::string ending = file.extension().string();
  const bool collada = ending == ".dae" || ending == ".DAE";
  // assimp looks for "<?xml" at the very start.
  const std::string bytes = collada ? without_leading_space(given) : given;
  if (bytes.empty()) throw ModelError(file.string() + ": error: is empty");
  if (collada) check_counts(given, file);
  std::vector<std::string> missing;
  Assimp::Importer importer;
  const aiScene* scene = &import_scene(importer, bytes, file, ColladaNames::names, missing);
  std::vector<Waiting> waiting = flattened(*scene->mRootNode);
  if (collada && has_double_names(waiting)) {
    scene = &import_scene(importer, bytes, file, ColladaNames::ids, missing);
    waiting = flattened(*scene->mRootNode);
    problems.repair("", "several nodes have one name; all are called by their ids instead");
  }

  // If it does not find a material file, assimp also looks for one with the model's own name, which the file did not
  // name.
  std::erase(missing, std::filesystem::path(file).filename().replace_extension("mtl").string());
  std::set<std::filesystem::path> told;
  for (const std::string& name : missing)
    if (told.insert(std::filesystem::path(name).relative_path()).second)
      problems.repair("", "the file \"" + utf8_or_latin1(name) +
                              "\" that it names is not in its folder; what that says of materials is not read");

  Model model;
  models::UniqueNames names;
  std::map<std::string, std::size_t> first_named;
  for (const Waiting& each : waiting) {
    const std::string name = text_of(each.node->mName);
    first_named.emplace(name, model.nodes.size());
    Node node;
    node.name = names.unique(name.empty() ? "node_" + std::to_string(model.nodes.size()) : name);
    node.parent = each.parent;
    node.rest = rest_of(*each.node, node.name, problems);
    model.nodes.push_back(std::move(node));
  }
  SceneMeshes meshes = scene_meshes(*scene, first_named, problems);
  for (std::size_t i = 0; i < waiting.size(); ++i)
    for (unsigned k = 0; k < waiting[i].node->mNumMeshes; ++k) {
      const std::size_t mesh = waiting[i].node->mMeshes[k];
      if (mesh < meshes.meshes.size() && !meshes.meshes[mesh].triangles.empty())
        model.instances.push_back({i, mesh, meshes.skin_of[mesh]});
    }
  model.meshes = std::move(meshes.meshes);
  model.skins = std::move(meshes.skins);
  model.clips = scene_clips(*scene, model, first_named, problems);
  problems.throw_if_any(file);
  return model;
}

}  // namespace tweenfall::assimp
