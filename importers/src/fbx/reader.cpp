#include "fbx/reader.h"

#include "fbx/surface/deformers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tweenfall::fbx {

namespace {

class SceneReader {
 public:
  SceneReader(const Objects& objects, models::ModelProblems& problems)
      : objects_(objects), problems_(problems), nodes_(objects, problems) {}

  Model read() {
    model_.nodes = nodes_.nodes();
    for (const FileNode& file : nodes_.files())
      for (const std::size_t geometry : objects_.below(file.object, "Geometry")) add_geometry(geometry, file);
    for (const Stack& stack : read_stacks(objects_, problems_)) model_.clips.push_back(clip_of(stack));
    tell_what_is_left_out();
    return std::move(model_);
  }

 private:
  /// The morph shapes of a node's meshes, which all have the same.
  struct Molded {
    std::size_t node;
    std::vector<Shape> shapes;
  };

  std::vector<Color> colors_of(std::size_t model) const {
    std::vector<Color> colors;
    for (const std::size_t material : objects_.below(model, "Material"))
      colors.push_back(base_color(objects_[material], objects_));
    return colors;
  }

  void add_geometry(std::size_t index, const FileNode& file) {
    const Object& geometry = objects_[index];
    if (geometry.form != "Mesh") {
      problems_.repair("geometry \"" + geometry.name + "\"",
                       "is a " + std::string(geometry.form) + " and not a mesh; it was not read");
      return;
    }
    Geometry made = read_geometry(geometry, colors_of(file.object), objects_, problems_);
    SkinData skinned = read_skin(index, file.object, made.control_points, objects_, nodes_, problems_);
    std::vector<Shape> shapes = read_shapes(index, objects_, problems_);
    const Affine own = geometric_transform(objects_, file.object);
    const std::vector<Channel<double>> weights = shape_weights(shapes, objects_, nullptr);
    std::size_t skin = no_node;
    if (!skinned.skin.joints.empty()) {
      skin = model_.skins.size();
      model_.skins.push_back(skinned.skin);
    }
    for (Part& part : made.parts) {
      if (part.mesh.name.empty()) part.mesh.name = objects_[file.object].name;
      if (skin != no_node)
        for (const std::uint32_t point : part.control_points) part.mesh.influences.add(skinned.influences[point]);
      for (const Shape& shape : shapes) add_morph(shape, made.control_points, part);
      for (const Channel<double>& weight : weights) part.mesh.rest_weights.push_back(weight.curve.value(0));
      place(own, part.mesh);
      model_.instances.push_back({file.node, model_.meshes.size(), skin});
      model_.meshes.push_back(std::move(part.mesh));
    }
    if (!shapes.empty()) molded_.push_back({file.node, std::move(shapes)});
  }

  void add_morph(const Shape& shape, std::size_t control_points, Part& part) const {
    std::vector<Vec3> moved(control_points, Vec3(0, 0, 0)), bent;
    if (!shape.normal_offsets.empty() && !part.mesh.normals.empty()) bent.assign(control_points, Vec3(0, 0, 0));
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      if (shape.points[i] >= control_points)
        objects_.source().fail(objects_[shape.channel].record->at,
                               "the shape \"" + shape.name + "\" moves point " + std::to_string(shape.points[i]) +
                                   "; the mesh has " + std::to_string(control_points));
      moved[shape.points[i]] += shape.position_offsets[i];
      if (!bent.empty()) bent[shape.points[i]] += shape.normal_offsets[i];
    }
    MorphTarget morph;
    morph.name = shape.name;
    for (const std::uint32_t point : part.control_points) {
      morph.position_offsets.push_back(moved[point]);
      if (!bent.empty()) morph.normal_offsets.push_back(bent[point]);
    }
    part.mesh.morphs.push_back(std::move(morph));
  }

  /// Applies the geometry's own transform to its points, since children do not inherit it.
  static void place(const Affine& own, Mesh& mesh) {
    if (own.linear == Mat3::Identity() && own.translation.isZero(0)) return;
    for (Vec3& point : mesh.positions) point = own.linear * point + own.translation;
    const double side = own.linear.determinant() < 0 ? -1 : 1;
    // Normals are transformed by the inverse transpose, here by the cofactors, which exist for singular scales too;
    // `side` corrects for mirroring.
    Mat3 normal;
    for (int i = 0; i < 3; ++i)
      normal.col(i) = side * Vec3(own.linear.col((i + 1) % 3)).cross(Vec3(own.linear.col((i + 2) % 3)));
    for (Vec3& each : mesh.normals) {
      const Vec3 turned = normal * each;
      const double length = turned.norm();
      if (length > 0) each = turned / length;
    }
    for (Vec4& tangent : mesh.tangents) {
      const Vec3 turned = own.linear * tangent.head<3>();
      const double length = turned.norm();
      if (length > 0) tangent.head<3>() = turned / length;
      tangent[3] *= side;
    }
    for (MorphTarget& morph : mesh.morphs) {
      for (Vec3& offset : morph.position_offsets) offset = own.linear * offset;
      for (Vec3& offset : morph.normal_offsets) offset = own.linear * offset;
    }
    if (side < 0)
      for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
        std::swap(mesh.triangles[i], mesh.triangles[i + 1]);
  }

  Clip clip_of(const Stack& stack) const {
    Clip clip;
    clip.name = stack.name;
    clip.tracks = nodes_.tracks(stack);
    for (const Molded& each : molded_) {
      const std::vector<Channel<double>> weights = shape_weights(each.shapes, objects_, &stack);
      if (std::ranges::none_of(weights, &Channel<double>::driven)) continue;
      WeightCurves curves;
      for (const Channel<double>& weight : weights) curves.push_back(weight.curve);
      clip.tracks.push_back({model_.nodes[each.node].name, "weights", std::move(curves)});
    }
    clip.duration = stack.end;
    if (!(clip.duration > 0)) clip.duration = std::max(0.0, last_key(clip));
    return clip;
  }

  static double last_key(const Clip& clip) {
    double last = 0;
    for (const Track& track : clip.tracks) {
      const double end = extent(track.curve).second;
      if (std::isfinite(end)) last = std::max(last, end);
    }
    return last;
  }

  void tell_what_is_left_out() {
    std::map<std::string_view, std::size_t> count;
    for (std::size_t i = 0; i < objects_.all().size(); ++i) {
      const Object& object = objects_[i];
      if (object.kind == "NodeAttribute") {
        const bool read = std::ranges::any_of(objects_.above(i, "Model"),
                                              [&](std::size_t model) { return nodes_.of(model) != no_node; });
        if (read && (object.form == "Camera" || object.form == "Light")) ++count[object.form];
      } else if (object.kind == "Texture" || object.kind == "Constraint") {
        ++count[object.kind];
      } else if (object.kind == "Deformer" && object.form == "VertexCacheDeformer") {
        ++count["Cache"];
      } else if (object.kind == "Model" && nodes_.of(i) == no_node) {
        ++count["Model"];
      }
    }
    const auto tell = [&](std::string_view kind, const std::string& one, const std::string& many) {
      if (const auto found = count.find(kind); found != count.end())
        problems_.repair("", models::counted(found->second, one, many));
    };
    tell("Texture", "texture is not read; materials show their base color alone",
         "textures are not read; materials show their base color alone");
    tell("Camera", "camera is read as a plain node", "cameras are read as plain nodes");
    tell("Light", "light is read as a plain node", "lights are read as plain nodes");
    tell("Model", "view of the program that wrote it (\"Producer ...\") is left out",
         "views of the program that wrote it (\"Producer ...\") are left out");
    tell("Constraint", "constraint is not read; nodes move as their own keys say",
         "constraints are not read; nodes move as their own keys say");
    tell("Cache", "cache of vertices is not read", "caches of vertices are not read");
  }

  const Objects& objects_;
  models::ModelProblems& problems_;
  Nodes nodes_;
  Model model_;
  std::vector<Molded> molded_;
};

}  // namespace

Model read(std::string_view bytes, const std::filesystem::path& file, models::ModelProblems& problems) {
  const Source source(bytes, file, !is_binary(bytes));
  const File records = read_records(source);
  const Objects objects(records, source, problems);
  Model model = SceneReader(objects, problems).read();
  problems.throw_if_any(file);
  return model;
}

}  // namespace tweenfall::fbx
