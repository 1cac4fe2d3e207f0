#include "assimp/meshes.h"
#include "model/model_matrix.h"

#include "assimp/values.h"
#include "model/model_influences.h"

#include <assimp/scene.h>

#include <cmath>

namespace tweenfall::assimp {

namespace {

std::vector<Vec3> vectors(const aiVector3D* from, unsigned count) {
  std::vector<Vec3> all;
  for (unsigned i = 0; from && i < count; ++i) all.push_back(vector_of(from[i]));
  return all;
}

bool finite(const auto& all) {
  for (const auto& v : all)
    if (!v.allFinite()) return false;
  return true;
}

/// How far each vertex moves; assimp stores where it moves to.
std::vector<Vec3> offsets(const aiVector3D* to, const std::vector<Vec3>& from) {
  std::vector<Vec3> all;
  for (std::size_t i = 0; to && i < from.size(); ++i) all.push_back(vector_of(to[i]) - from[i]);
  return all;
}

Color base_color(const aiScene& scene, const aiMesh& mesh) {
  Color color{Vec4(0.8, 0.8, 0.8, 1)};
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return color;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiColor3D diffuse;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == aiReturn_SUCCESS) {
    const Vec3 rgb(static_cast<double>(diffuse.r), static_cast<double>(diffuse.g), static_cast<double>(diffuse.b));
    if (rgb.allFinite()) color.rgba.head<3>() = rgb;
  }
  ai_real opacity = 1;
  if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity > 0 && opacity <= 1)
    color.rgba[3] = static_cast<double>(opacity);
  return color;
}

void add_morphs(const aiMesh& from, Mesh& mesh) {
  for (unsigned i = 0; i < from.mNumAnimMeshes; ++i) {
    const aiAnimMesh& target = *from.mAnimMeshes[i];
    if (target.mNumVertices != from.mNumVertices) continue;
    MorphTarget morph;
    morph.name = text_of(target.mName);
    morph.position_offsets = offsets(target.mVertices, mesh.positions);
    morph.position_offsets.resize(mesh.positions.size(), Vec3(0, 0, 0));
    morph.normal_offsets = offsets(target.mNormals, mesh.normals);
    if (!finite(morph.position_offsets) || !finite(morph.normal_offsets)) continue;
    mesh.rest_weights.push_back(static_cast<double>(target.mWeight));
    mesh.morphs.push_back(std::move(morph));
  }
}

Mesh plain_mesh(const aiScene& scene, const aiMesh& from) {
  Mesh mesh;
  mesh.name = text_of(from.mName);
  mesh.positions = vectors(from.mVertices, from.mNumVertices);
  mesh.normals = vectors(from.mNormals, from.mNumVertices);
  if (!finite(mesh.normals)) mesh.normals.clear();
  for (unsigned i = 0; from.HasTangentsAndBitangents() && from.HasNormals() && i < from.mNumVertices; ++i) {
    const Vec3 along = vector_of(from.mTangents[i]), across = vector_of(from.mBitangents[i]);
    const double hand = vector_of(from.mNormals[i]).cross(along).dot(across) < 0 ? -1 : 1;
    mesh.tangents.emplace_back(along.x(), along.y(), along.z(), hand);
  }
  if (!finite(mesh.tangents)) mesh.tangents.clear();
  for (unsigned i = 0; from.HasTextureCoords(0) && i < from.mNumVertices; ++i)
    mesh.texture_coordinates.push_back(vector_of(from.mTextureCoords[0][i]).head<2>());
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices == 3) mesh.triangles.insert(mesh.triangles.end(), face.mIndices, face.mIndices + 3);
  }
  mesh.base_color = base_color(scene, from);
  add_morphs(from, mesh);
  return mesh;
}

Skin skin_of_bones(const aiMesh& from, const std::map<std::string, std::size_t>& nodes, Mesh& mesh,
                   models::ModelProblems& problems) {
  const std::string place = "mesh \"" + mesh.name + "\"";
  Skin skin;
  std::vector<std::vector<Influence>> pulls(mesh.positions.size());
  for (unsigned i = 0; i < from.mNumBones; ++i) {
    const aiBone& bone = *from.mBones[i];
    const auto node = nodes.find(text_of(bone.mName));
    if (node == nodes.end()) {
      problems.repair(place, "follows a bone \"" + text_of(bone.mName) + "\" that no node has; it was left out");
      continue;
    }
    const auto joint = static_cast<std::uint32_t>(skin.joints.size());
    skin.joints.push_back(node->second);
    skin.inverse_binds.push_back({linear_of(bone.mOffsetMatrix), translation_of(bone.mOffsetMatrix)});
    if (!models::is_finite(skin.inverse_binds.back().linear) || !skin.inverse_binds.back().translation.allFinite())
      problems.add(place, "the bind pose of bone \"" + text_of(bone.mName) + "\" is not finite");
    for (unsigned k = 0; k < bone.mNumWeights; ++k) {
      const aiVertexWeight& weight = bone.mWeights[k];
      if (weight.mVertexId < pulls.size() && std::isfinite(weight.mWeight))
        pulls[weight.mVertexId].push_back({joint, static_cast<double>(weight.mWeight)});
    }
  }
  if (skin.joints.empty()) return skin;
  models::InfluenceTally tally;
  for (auto& each : pulls) mesh.influences.add(models::summing_to_one(std::move(each), tally));
  tally.report(place, problems);
  return skin;
}

}  // namespace

SceneMeshes scene_meshes(const aiScene& scene, const std::map<std::string, std::size_t>& nodes,
                         models::ModelProblems& problems) {
  SceneMeshes all;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& from = *scene.mMeshes[i];
    Mesh mesh = plain_mesh(scene, from);
    if (!finite(mesh.positions)) problems.add("mesh \"" + mesh.name + "\"", "has a position that is not finite");
    all.skin_of.push_back(no_node);
    if (from.mNumBones > 0) {
      Skin skin = skin_of_bones(from, nodes, mesh, problems);
      if (!skin.joints.empty()) {
        all.skin_of.back() = all.skins.size();
        all.skins.push_back(std::move(skin));
      }
    }
    all.meshes.push_back(std::move(mesh));
  }
  return all;
}

}  // namespace tweenfall::assimp
