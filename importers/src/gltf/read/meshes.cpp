#include "gltf/read/meshes.h"

#include "gltf/format.h"
#include "gltf/read/influences.h"

#include <algorithm>

namespace tweenfall::gltf {

namespace {

/// An attribute of vectors, one per vertex (of any count where VERTICES is 0); empty when absent or wrong.
template <class Vector>
std::vector<Vector> vertex_vectors(const Fields& attributes, const char* name, std::size_t vertices,
                                   Accessors& accessors, Wanted wanted = Wanted::any) {
  constexpr int width = Vector::RowsAtCompileTime;
  std::vector<Vector> all;
  const auto index = attributes.index(name, accessors.size());
  if (!index) return all;
  const std::string kind = "VEC" + std::to_string(width), place = attributes.place_of(name);
  const auto decoded = accessors.read(*index, place, {kind.c_str()}, wanted);
  if (!decoded) return all;
  if (vertices != 0 && decoded->count != vertices) {
    attributes.problems().add(
        place, "has " + std::to_string(decoded->count) + " elements for " + std::to_string(vertices) + " vertices");
    return all;
  }
  all.resize(decoded->count);
  for (std::size_t i = 0; i < decoded->count; ++i)
    for (int k = 0; k < width; ++k) all[i][k] = decoded->at(i)[k];
  return all;
}

/// Corners in drawing order, as the file lists them.
std::vector<std::uint32_t> corners(const Fields& primitive, std::size_t vertices, Accessors& accessors) {
  std::vector<std::uint32_t> all;
  if (!primitive.has("indices")) {
    for (std::size_t i = 0; i < vertices; ++i) all.push_back(static_cast<std::uint32_t>(i));
    return all;
  }
  const auto index = primitive.index("indices", accessors.size());
  if (!index) return all;
  const auto decoded = accessors.read(*index, primitive.place_of("indices"), {"SCALAR"}, Wanted::indices);
  if (!decoded) return all;
  for (const double corner : decoded->numbers) {
    if (corner >= static_cast<double>(vertices)) {
      primitive.problems().add(primitive.place_of("indices"),
                               "corner " + std::to_string(static_cast<std::size_t>(corner)) + " points past the " +
                                   std::to_string(vertices) + " vertices");
      return {};
    }
    all.push_back(static_cast<std::uint32_t>(corner));
  }
  return all;
}

/// Plain triangles from a list, strip or fan. Source: glTF 2.0 specification, section 3.7.2.1.
std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& c, std::size_t mode) {
  std::vector<std::uint32_t> all;
  if (mode == triangles) {
    all.assign(c.begin(), c.end() - static_cast<std::ptrdiff_t>(c.size() % 3));
    return all;
  }
  for (std::size_t i = 0; i + 2 < c.size(); ++i) {
    if (mode == fan)
      all.insert(all.end(), {c[i + 1], c[i + 2], c[0]});
    else
      all.insert(all.end(), {c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]});
  }
  return all;
}

void read_targets(const Fields& primitive, const std::vector<std::string>& names, Mesh& mesh, Accessors& accessors) {
  const std::size_t count = primitive.list("targets").size(), vertices = mesh.positions.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Fields target = primitive.at("targets", i);
    MorphTarget morph;
    morph.name = i < names.size() ? names[i] : "morph_" + std::to_string(i);
    morph.position_offsets = vertex_vectors<Vec3>(target, "POSITION", vertices, accessors);
    morph.position_offsets.resize(vertices, Vec3(0, 0, 0));
    morph.normal_offsets = vertex_vectors<Vec3>(target, "NORMAL", vertices, accessors);
    morph.tangent_offsets = vertex_vectors<Vec3>(target, "TANGENT", vertices, accessors, Wanted::spare);
    mesh.morphs.push_back(std::move(morph));
  }
}

Color base_color(const Fields& root, const Fields& primitive) {
  const auto index = primitive.index("material", root.list("materials").size());
  if (!index) return Color{Vec4(1, 1, 1, 1)};
  const Fields surface = root.at("materials", *index).inside("pbrMetallicRoughness");
  const std::vector<double> c = surface.numbers("baseColorFactor", 4);
  return c.empty() ? Color{Vec4(1, 1, 1, 1)} : Color{Vec4(c[0], c[1], c[2], c[3])};
}

class MeshReader {
 public:
  MeshReader(const Fields& root, Accessors& accessors) : root_(root), accessors_(accessors) {}

  FileMesh read(const Fields& mesh, const std::string& name) {
    FileMesh result;
    const std::size_t count = mesh.list("primitives").size();
    const std::vector<double> weights = mesh.numbers("weights", 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Fields primitive = mesh.at("primitives", i);
      const std::size_t morphs = primitive.list("targets").size();
      if (i == 0) result.morphs = morphs;
      if (morphs != result.morphs)
        mesh.problems().add(primitive.place_of("targets"), "has " + std::to_string(morphs) + " morph targets where " +
                                                               "the first primitive has " +
                                                               std::to_string(result.morphs));
      if (!drawn_as_triangles(primitive)) continue;
      result.primitives.push_back(read_primitive(primitive, target_names(mesh), result));
      Mesh& made = result.primitives.back();
      made.name = result.primitives.size() == 1 ? name : name + "#" + std::to_string(result.primitives.size());
      made.rest_weights = weights;
      made.rest_weights.resize(made.morphs.size(), 0);
    }
    if (!weights.empty() && weights.size() != result.morphs)
      mesh.problems().add(mesh.place_of("weights"), "has " + std::to_string(weights.size()) + " weights for " +
                                                        std::to_string(result.morphs) + " morph targets");
    return result;
  }

 private:
  static bool drawn_as_triangles(const Fields& primitive) {
    const std::size_t mode = primitive.whole("mode").value_or(triangles);
    if (mode > fan) {
      primitive.problems().add(primitive.place_of("mode"), "must be 0 to 6");
      return false;
    }
    if (mode < triangles) {
      primitive.problems().repair(primitive.place(), "is made of points or lines, which were not read");
      return false;
    }
    if (primitive.inside("attributes").has("POSITION")) return true;
    primitive.problems().repair(primitive.place(), "has no positions and was not read");
    return false;
  }

  static std::vector<std::string> target_names(const Fields& mesh) {
    std::vector<std::string> names;
    // Extras may hold anything; these names are a custom of the large modeling programs.
    const json::Value extras = mesh.find("extras");
    const json::Value list = extras ? extras.find("targetNames") : json::Value();
    if (list)
      for (const json::Value& name : list.items()) names.emplace_back(name.text());
    return names;
  }

  Mesh read_primitive(const Fields& primitive, const std::vector<std::string>& names, FileMesh& file_mesh) {
    const Fields attributes = primitive.inside("attributes");
    Mesh mesh;
    mesh.positions = vertex_vectors<Vec3>(attributes, "POSITION", 0, accessors_);
    mesh.base_color = base_color(root_, primitive);
    file_mesh.joint_counts.push_back(0);
    if (mesh.positions.empty()) return mesh;
    const std::size_t vertices = mesh.positions.size();
    mesh.normals = vertex_vectors<Vec3>(attributes, "NORMAL", vertices, accessors_);
    mesh.tangents = vertex_vectors<Vec4>(attributes, "TANGENT", vertices, accessors_, Wanted::spare);
    for (Vec4& tangent : mesh.tangents) tangent[3] = tangent[3] < 0 ? -1 : 1;
    mesh.texture_coordinates = vertex_vectors<Vec2>(attributes, "TEXCOORD_0", vertices, accessors_);
    mesh.triangles =
        triangle_list(corners(primitive, vertices, accessors_), primitive.whole("mode").value_or(triangles));
    mesh.influences = read_influences(attributes, vertices, accessors_, file_mesh.joint_counts.back());
    read_targets(primitive, names, mesh, accessors_);
    return mesh;
  }

  const Fields& root_;
  Accessors& accessors_;
};

}  // namespace

std::vector<FileMesh> read_meshes(const Fields& root, Accessors& accessors) {
  std::vector<FileMesh> meshes;
  MeshReader reader(root, accessors);
  for (std::size_t i = 0; i < root.list("meshes").size(); ++i) {
    const Fields mesh = root.at("meshes", i);
    meshes.push_back(reader.read(mesh, mesh.text("name", "mesh_" + std::to_string(i))));
  }
  return meshes;
}

std::vector<Skin> read_skins(const Fields& root, Accessors& accessors) {
  std::vector<Skin> skins;
  const std::size_t nodes = root.list("nodes").size();
  for (std::size_t i = 0; i < root.list("skins").size(); ++i) {
    const Fields fields = root.at("skins", i);
    Skin skin;
    skin.joints = fields.indices("joints", nodes);
    if (fields.list("joints").empty()) fields.problems().add(fields.place(), "has no joints");
    skin.inverse_binds.resize(skin.joints.size());
    if (const auto index = fields.index("inverseBindMatrices", accessors.size())) {
      const std::string place = fields.place_of("inverseBindMatrices");
      const auto matrices = accessors.read(*index, place, {"MAT4"}, Wanted::reals);
      if (matrices && matrices->count < fields.list("joints").size())
        fields.problems().add(place, "has " + std::to_string(matrices->count) + " matrices for " +
                                         std::to_string(fields.list("joints").size()) + " joints");
      for (std::size_t joint = 0; matrices && joint < std::min(skin.joints.size(), matrices->count); ++joint) {
        const double* m = matrices->at(joint);
        for (int k = 0; k < 9; ++k) skin.inverse_binds[joint].linear(k % 3, k / 3) = m[4 * (k / 3) + k % 3];
        skin.inverse_binds[joint].translation = Vec3(m[12], m[13], m[14]);
      }
    }
    skins.push_back(std::move(skin));
  }
  return skins;
}

}  // namespace tweenfall::gltf
