#include "fbx/surface/geometry.h"

#include "fbx/surface/triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace tweenfall::fbx {

namespace {

/// Values for the corners of a mesh, from one of the file's "layer elements".
class LayerElement {
 public:
  enum class Need { must_be_finite, may_be_left_out };

  LayerElement(const Record* layer, const char* values, const char* indices, std::size_t width, const Objects& objects,
               Need need = Need::must_be_finite)
      : width_(width) {
    if (!layer) return;
    const auto word = [&](const char* name) {
      const Record* record = layer->find(name);
      return record ? record->text(0) : std::string_view();
    };
    values_ = layer->reals(values);
    const std::string_view mapping = word("MappingInformationType"), reference = word("ReferenceInformationType");
    by_point_ = mapping == "ByVertice" || mapping == "ByVertex";
    by_polygon_ = mapping == "ByPolygon";
    all_same_ = mapping == "AllSame";
    const bool by_corner = mapping == "ByPolygonVertex";
    if (reference == "IndexToDirect" || reference == "Index") indices_ = layer->integers(indices);
    indexed_ = !indices_.empty();
    present_ = (by_point_ || by_polygon_ || all_same_ || by_corner) && values_.size() >= width_;
    broken_ = std::ranges::any_of(values_, [](double value) { return !std::isfinite(value); });
    if (broken_ && need == Need::must_be_finite)
      objects.source().fail(layer->at, "a value in \"" + std::string(values) + "\" is not finite");
  }

  [[nodiscard]] bool present() const { return present_ && !broken_; }
  [[nodiscard]] bool broken() const { return broken_; }  ///< some value is not finite

  /// Pointer to the values of a corner; null where the element has none for it.
  [[nodiscard]] const double* at(std::size_t corner, std::size_t point, std::size_t polygon) const {
    std::size_t index = all_same_ ? 0 : by_point_ ? point : by_polygon_ ? polygon : corner;
    if (indexed_) {
      if (index >= indices_.size() || indices_[index] < 0) return nullptr;
      index = static_cast<std::size_t>(indices_[index]);
    }
    return index < values_.size() / width_ ? values_.data() + index * width_ : nullptr;
  }

 private:
  std::size_t width_;
  Reals values_;
  Integers indices_;
  bool by_point_ = false, by_polygon_ = false, all_same_ = false, indexed_ = false, present_ = false, broken_ = false;
};

/// Everything that distinguishes a vertex from others, to the bit.
struct VertexKey {
  std::uint32_t point = 0;
  double numbers[9]{};  // normal, texture coordinates, tangent and its hand

  bool operator==(const VertexKey& other) const {
    return point == other.point && std::memcmp(numbers, other.numbers, sizeof numbers) == 0;
  }
};

struct VertexHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t hash = key.point * 0x9E3779B97F4A7C15u;
    for (const double number : key.numbers) {
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof bits);
      hash = (hash ^ bits) * 0xFF51AFD7ED558CCDu;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

class GeometryReader {
 public:
  GeometryReader(const Object& geometry, const std::vector<Color>& colors, const Objects& objects,
                 models::ModelProblems& problems)
      : geometry_(geometry),
        record_(*geometry.record),
        objects_(objects),
        problems_(problems),
        colors_(colors),
        normals_(record_.find("LayerElementNormal"), "Normals", "NormalsIndex", 3, objects),
        coordinates_(record_.find("LayerElementUV"), "UV", "UVIndex", 2, objects),
        tangents_(record_.find("LayerElementTangent"), "Tangents", "TangentsIndex", 3, objects,
                  LayerElement::Need::may_be_left_out),
        across_(record_.find("LayerElementBinormal"), "Binormals", "BinormalsIndex", 3, objects,
                LayerElement::Need::may_be_left_out) {
    // Exporters write non-finite tangents where a texture has no extent.
    has_tangents_ = tangents_.present() && normals_.present() && !across_.broken();
    if (tangents_.broken() || across_.broken())
      problems_.repair("mesh \"" + geometry_.name + "\"", "has tangents that are not finite; they were left out");
    if (colors_.empty()) colors_.push_back(plain_color());
    find_color_parts();
  }

  Geometry read() {
    read_points();
    const Integers corners = record_.integers("PolygonVertexIndex");
    const LayerElement materials = material_layer();
    std::vector<std::size_t> polygon, points;
    std::size_t polygons = 0, points_and_lines = 0;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      // The last corner of a polygon is stored with all bits inverted.
      const bool last = corners[corner] < 0;
      const std::int64_t point = last ? ~corners[corner] : corners[corner];
      if (point < 0 || static_cast<std::size_t>(point) >= points_.size())
        objects_.source().fail(record_.at, "corner " + std::to_string(corner) + " of the mesh \"" + geometry_.name +
                                               "\" points past its " + std::to_string(points_.size()) + " points");
      polygon.push_back(corner);
      points.push_back(static_cast<std::size_t>(point));
      if (!last) continue;
      const double* material = materials.present() ? materials.at(polygon[0], points[0], polygons) : nullptr;
      if (polygon.size() >= 3)
        add_polygon(polygon, points, polygons, part_for(material ? *material : 0));
      else
        ++points_and_lines;
      polygon.clear();
      points.clear();
      ++polygons;
    }
    if (points_and_lines)
      problems_.repair(
          "mesh \"" + geometry_.name + "\"",
          models::counted(points_and_lines, "point or line was not read", "points or lines were not read"));
    result_.control_points = points_.size();
    std::erase_if(result_.parts, [](const Part& part) { return part.mesh.triangles.empty(); });
    return std::move(result_);
  }

 private:
  void read_points() {
    const Reals numbers = record_.reals("Vertices");
    if (numbers.size() % 3 != 0 || numbers.size() / 3 > 0xFFFFFFFFu)
      objects_.source().fail(record_.at, "the mesh \"" + geometry_.name + "\" has " + std::to_string(numbers.size()) +
                                             " coordinates, which is not three per point");
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
      points_.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
      if (!points_.back().allFinite())
        objects_.source().fail(
            record_.at, "point " + std::to_string(i / 3) + " of the mesh \"" + geometry_.name + "\" is not finite");
    }
  }

  /// The polygons' materials are indices themselves, so the index list holds everything.
  LayerElement material_layer() {
    const Record* layer = record_.find("LayerElementMaterial");
    if (layer) {
      stripped_ = *layer;
      for (Record& each : stripped_.children)
        if (each.name == "ReferenceInformationType") each.values = {std::string("Direct")};
    }
    return {layer ? &stripped_ : nullptr, "Materials", "Materials", 1, objects_};
  }

  /// Materials of one color share a mesh.
  void find_color_parts() {
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      std::size_t part = 0;
      while (part < result_.parts.size() && !(result_.parts[part].mesh.base_color == colors_[i])) ++part;
      if (part == result_.parts.size()) {
        result_.parts.emplace_back();
        result_.parts.back().mesh.base_color = colors_[i];
        result_.parts.back().mesh.name = part == 0 ? geometry_.name : geometry_.name + "#" + std::to_string(part + 1);
      }
      part_of_material_.push_back(part);
    }
    vertices_.resize(result_.parts.size());
  }

  [[nodiscard]] std::size_t part_for(double material) const {
    const bool known = material >= 0 && material < static_cast<double>(part_of_material_.size());
    return part_of_material_[known ? static_cast<std::size_t>(material) : 0];
  }

  void add_polygon(const std::vector<std::size_t>& corners, const std::vector<std::size_t>& points, std::size_t polygon,
                   std::size_t part) {
    std::vector<Vec3> places;
    std::vector<std::uint32_t> vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      places.push_back(points_[points[i]]);
      vertices.push_back(vertex(corners[i], points[i], polygon, part));
    }
    std::vector<std::uint32_t>& triangles = result_.parts[part].mesh.triangles;
    for (const auto& triangle : triangles_of(places))
      for (const std::size_t corner : triangle) triangles.push_back(vertices[corner]);
  }

  std::uint32_t vertex(std::size_t corner, std::size_t point, std::size_t polygon, std::size_t index) {
    VertexKey key{static_cast<std::uint32_t>(point), {}};
    if (const double* n = normals_.present() ? normals_.at(corner, point, polygon) : nullptr)
      std::copy(n, n + 3, key.numbers);
    if (const double* uv = coordinates_.present() ? coordinates_.at(corner, point, polygon) : nullptr)
      std::copy(uv, uv + 2, key.numbers + 3);
    if (has_tangents_) copy_tangent(corner, point, polygon, key);
    Part& part = result_.parts[index];
    const auto next = static_cast<std::uint32_t>(part.control_points.size());
    const auto [found, added] = vertices_[index].emplace(key, next);
    if (!added) return found->second;
    part.control_points.push_back(key.point);
    part.mesh.positions.push_back(points_[point]);
    if (normals_.present()) part.mesh.normals.push_back(unit({key.numbers[0], key.numbers[1], key.numbers[2]}));
    if (has_tangents_) {
      const Vec3 along = unit({key.numbers[5], key.numbers[6], key.numbers[7]});
      part.mesh.tangents.emplace_back(along.x(), along.y(), along.z(), key.numbers[8]);
    }
    // Our texture coordinates count from the top, those of the file from the bottom.
    if (coordinates_.present()) part.mesh.texture_coordinates.emplace_back(key.numbers[3], 1 - key.numbers[4]);
    return next;
  }

  void copy_tangent(std::size_t corner, std::size_t point, std::size_t polygon, VertexKey& key) const {
    key.numbers[8] = 1;
    const double* along = tangents_.at(corner, point, polygon);
    if (!along) return;
    std::copy(along, along + 3, key.numbers + 5);
    const double* across = across_.present() ? across_.at(corner, point, polygon) : nullptr;
    if (!across) return;
    const Vec3 normal(key.numbers[0], key.numbers[1], key.numbers[2]);
    if (normal.cross(Vec3(along[0], along[1], along[2])).dot(Vec3(across[0], across[1], across[2])) < 0)
      key.numbers[8] = -1;
  }

  static Vec3 unit(const Vec3& direction) {
    const double length = direction.norm();
    return length > 1e-12 && std::isfinite(length) ? Vec3(direction / length) : Vec3(0, 0, 1);
  }

  const Object& geometry_;
  const Record& record_;
  const Objects& objects_;
  models::ModelProblems& problems_;
  std::vector<Color> colors_;
  Record stripped_;
  LayerElement normals_, coordinates_, tangents_, across_;
  bool has_tangents_ = false;
  std::vector<Vec3> points_;
  std::vector<std::size_t> part_of_material_;
  std::vector<std::unordered_map<VertexKey, std::uint32_t, VertexHash>> vertices_;
  Geometry result_;
};

}  // namespace

Geometry read_geometry(const Object& geometry, const std::vector<Color>& colors, const Objects& objects,
                       models::ModelProblems& problems) {
  return GeometryReader(geometry, colors, objects, problems).read();
}

Color plain_color() {
  return Color{Vec4(0.8, 0.8, 0.8, 1)};
}

Color base_color(const Object& material, const Objects& objects) {
  Color color = plain_color();
  const Vec3 own = color.rgba.head<3>();
  const Vec3 diffuse = objects.vector(material, "DiffuseColor", objects.vector(material, "Diffuse", own));
  const Vec3 rgb = diffuse * objects.number(material, "DiffuseFactor", 1);
  if (rgb.allFinite()) color.rgba.head<3>() = rgb;
  const double opacity = objects.number(material, "Opacity", 1);
  if (opacity > 0 && opacity <= 1) color.rgba[3] = opacity;
  return color;
}

}  // namespace tweenfall::fbx
