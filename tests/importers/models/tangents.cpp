// Tangents of meshes, from files and back: along growing texture coordinates, and which way the second direction
// points.

#include "importers/models/fbx_files.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

std::string list_of(const std::string& name, const std::string& numbers) {
  return name + ": *" + std::to_string(std::ranges::count(numbers, ',') + 1) + " { a: " + numbers + " }\n";
}

/// A square in the plane of x and y, seen from +z, whose texture lies along x and y.
Model square(const ScratchFolder& folder, const std::string& properties, const std::string& binormals) {
  const auto layer = [](const std::string& kind, const std::string& name, const std::string& numbers) {
    return kind + ": 0 {\nMappingInformationType: \"AllSame\"\nReferenceInformationType: \"Direct\"\n" +
           list_of(name, numbers) + "}\n";
  };
  FbxText file;
  const int node = file.model("square", properties);
  file.object("Geometry", "Geometry::square", "Mesh",
              list_of("Vertices", "0,0,0,1,0,0,1,1,0,0,1,0") + list_of("PolygonVertexIndex", "0,1,2,-4") +
                  layer("LayerElementNormal", "Normals", "0,0,1") + layer("LayerElementTangent", "Tangents", "3,0,0") +
                  (binormals.empty() ? "" : layer("LayerElementBinormal", "Binormals", binormals)),
              node);
  return load_model(folder.file("square.fbx", file.text()));
}

/// How far the tangents of a mesh keep to its texture coordinates: over all triangles, the least cosine between them
/// and the direction in which the first coordinate grows.
double least_along(const Mesh& mesh) {
  double least = 1;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const auto [a, b, c] = std::array{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]};
    const Vec2 u = mesh.texture_coordinates[b] - mesh.texture_coordinates[a],
               v = mesh.texture_coordinates[c] - mesh.texture_coordinates[a];
    const Vec3 p = mesh.positions[b] - mesh.positions[a], q = mesh.positions[c] - mesh.positions[a];
    const Vec3 growing = (v[1] * p - u[1] * q) * (u[0] * v[1] - u[1] * v[0] < 0 ? -1.0 : 1.0);
    if (growing.norm() < 1e-12) continue;
    for (const std::uint32_t corner : {a, b, c})
      least = std::min(least, mesh.tangents[corner].head<3>().dot(growing.normalized()));
  }
  return least;
}

}  // namespace

TEST_CASE("tangents of FBX files are unit, and say by the binormals which way lies across") {
  const ScratchFolder folder("fbx-tangents");
  const Mesh plain = square(folder, "", "").meshes.at(0), other = square(folder, "", "0,-1,0").meshes.at(0);
  REQUIRE(plain.tangents.size() == 4);
  CHECK(plain.tangents[0] == Vec4(1, 0, 0, 1));
  CHECK(other.tangents[3] == Vec4(1, 0, 0, -1));
}

TEST_CASE("tangents that are not finite are left out of an FBX file with a word, and all else is read") {
  const ScratchFolder folder("fbx-broken-tangents");
  for (const char* broken : {"0,1e999,0", "0,nan,0"}) {
    CAPTURE(std::string(broken));
    const Model model = square(folder, "", broken);
    CHECK(model.meshes.at(0).positions.size() == 4);
    CHECK(model.meshes[0].normals.size() == 4);
    CHECK(model.meshes[0].tangents.empty());
    REQUIRE(model.repairs.size() == 1);
    CHECK(model.repairs[0].find("tangents that are not finite") != std::string::npos);
  }
}

TEST_CASE("a geometry that is mirrored keeps its normals outward, and its tangents along the texture") {
  const ScratchFolder folder("fbx-mirrored");
  const Mesh mirrored = square(folder, FbxText::vector("GeometricScaling", {-2, 1, 1}), "0,1,0").meshes.at(0);
  REQUIRE(mirrored.tangents.size() == 4);
  CHECK(near(mirrored.normals[0], Vec3(0, 0, 1), 1e-15));
  CHECK(near(mirrored.tangents[0].head<3>(), Vec3(-1, 0, 0), 1e-15));
  // z cross -x is -y, and the texture's second direction is y.
  CHECK(mirrored.tangents[0][3] == -1);
  const auto corner = [&](std::size_t i) { return mirrored.positions[mirrored.triangles[i]]; };
  CHECK((corner(1) - corner(0)).cross(corner(2) - corner(0)).z() > 0);
  const Mesh side = square(folder, FbxText::vector("GeometricScaling", {1, 1, -1}), "0,1,0").meshes.at(0);
  CHECK(near(side.normals[0], Vec3(0, 0, -1), 1e-15));
}

TEST_CASE("tangents and how morph targets bend them are saved in glTF and read back") {
  const ScratchFolder folder("saved-tangents");
  Model model;
  model.nodes = {{"leaf"}};
  Mesh mesh{.name = "leaf",
            .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
            .tangents = {{1, 0, 0, 1}, {0.6, 0.8, 0, -1}, {0, 1, 0, 1}},
            .texture_coordinates = {},
            .triangles = {0, 1, 2},
            .influences = {},
            .morphs = {},
            .rest_weights = {0.5}};
  const std::vector<Vec3> bent{{0, 0, 0.25}, {0, 0.5, 0}, {0.125, 0, 0}};
  mesh.morphs = {{"bend", std::vector<Vec3>(3, Vec3(0, 0, 1)), {}, bent}};
  model.meshes = {mesh};
  model.instances = {{0, 0, no_node}};
  save_glb(model, folder / "leaf.glb");
  const Mesh back = load_model(folder / "leaf.glb").meshes.at(0);
  REQUIRE(back.tangents.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(near(back.tangents[i], mesh.tangents[i], 1e-7));
  CHECK(back.morphs.at(0).tangent_offsets == bent);

  // A number of the second tangent, as the file holds it, becomes NaN.
  std::string bytes = text_of(folder / "leaf.glb");
  const float numbers[2] = {0.6F, 0.8F}, none = std::numeric_limits<float>::quiet_NaN();
  const std::size_t place = bytes.find(std::string(reinterpret_cast<const char*>(numbers), sizeof numbers));
  REQUIRE(place != std::string::npos);
  std::memcpy(bytes.data() + place, &none, sizeof none);
  const Model broken = load_model(folder.file("broken.glb", bytes));
  CHECK(broken.meshes.at(0).tangents.empty());
  CHECK(broken.meshes[0].normals.size() == 3);
  REQUIRE(broken.repairs.size() == 1);
  CHECK(broken.repairs[0].find("element 1 is not a finite number") != std::string::npos);
}

TEST_CASE("tangents of public models lie along their textures") {
  if (!std::filesystem::exists(models_folder())) {
    MESSAGE("SKIPPED: tangents of public models: " << models_folder() << " is not there");
    return;
  }
  // Not AnimatedMorphCube: it has no texture, and the tangents of its file are perpendicular to its sides.
  std::size_t meshes = 0;
  for (const char* name : {"gltf/AnimatedCube.gltf", "fbx/animation-rotation-pivot.fbx", "fbx/animation-layer.fbx"})
    for (const Mesh& mesh : load_model(models_folder() / name).meshes) {
      CAPTURE(std::string(name));
      if (mesh.tangents.empty()) continue;
      ++meshes;
      for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        CHECK(near(mesh.tangents[i].head<3>().norm(), 1, 1e-5));
        CHECK(std::abs(mesh.tangents[i].head<3>().dot(mesh.normals[i])) < 1e-3);
      }
      CHECK(least_along(mesh) > 0.9);
    }
  CHECK(meshes >= 3);
}
