#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/convex_hull.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "shapes/hulls/hull_polygons.h"
#include "shapes/hulls/hull_triangles.h"

namespace tweenfall {

struct ConvexHull::Data {
  std::vector<Vec3> vertices;
  std::vector<Face> faces;
  std::vector<std::uint32_t> corners;  ///< of all faces
  std::vector<Edge> edges;
  std::vector<std::uint32_t> neighbors;
  std::vector<std::uint32_t> first_neighbor;  ///< by vertex, and the end
  MeshMeasures measures;
  double inner_radius = 0, outer_radius = 0;

  /// With planes as thick as `flat`; false if rounding spoils it.
  bool make(std::span<const Vec3> points, double flat);
  /// From the vertices, and each face's corners among them.
  bool assemble(std::span<const std::vector<std::uint32_t>> loops);
  bool connect();
  void finish(const SurfaceMesh& surface);
  [[nodiscard]] bool holds(std::span<const Vec3> points, double within) const;
};

namespace shapes {
namespace {

/// How often the thickness of planes may be increased, and by which factor each time.
constexpr int most_attempts = 4;
constexpr double thickening = 8;
/// How far a point may lie beyond a face, in thicknesses.
constexpr double slack = 32;
constexpr double most_slack = 2 * slack * thickening * thickening * thickening;

constexpr double least_extent = 1e-6, greatest_extent = 1e6;  // m

void require_usable(std::span<const Vec3> points) {
  if (points.size() < 4)
    throw std::invalid_argument("a convex hull needs at least 4 points, but has " + std::to_string(points.size()));
  Vec3 low = points[0], high = low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& point = points[i];
    if (!point.allFinite())
      throw std::invalid_argument("points of a convex hull must be finite, but point " + std::to_string(i) + " is (" +
                                  number_text(point.x()) + ", " + number_text(point.y()) + ", " +
                                  number_text(point.z()) + ")");
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double extent = (high - low).maxCoeff();
  if (extent > greatest_extent || (extent > 0 && extent < least_extent))
    throw std::invalid_argument("a convex hull must be between 1e-6 m and 1e6 m wide, but is " + number_text(extent) +
                                " m wide");
}

[[noreturn]] void refuse_rounding(std::size_t count) {
  throw std::invalid_argument("the convex hull of these " + std::to_string(count) +
                              " points depends on rounding errors; leave out points that nearly coincide");
}

/// The normal from the area that the loop encloses (Newell), the offset from the farthest of all vertices.
ConvexHull::Face face_of(std::span<const Vec3> vertices, std::span<const std::uint32_t> loop, std::uint32_t first) {
  Vec3 area(0, 0, 0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += (vertices[loop[i]] - vertices[loop[0]]).cross(vertices[loop[i + 1]] - vertices[loop[0]]);
  ConvexHull::Face face{area / area.norm(), 0, first, static_cast<std::uint32_t>(loop.size())};
  face.offset = face.normal.dot(vertices[0]);
  for (const Vec3& vertex : vertices) face.offset = std::max(face.offset, face.normal.dot(vertex));
  return face;
}

}  // namespace
}  // namespace shapes

bool ConvexHull::Data::make(std::span<const Vec3> points, double flat) {
  const std::vector<std::vector<std::uint32_t>> loops = shapes::hull_polygons(points, flat);
  // Vertices are numbered in the order of the points.
  std::vector<std::uint32_t> number(points.size(), 0);
  for (const auto& loop : loops)
    for (const std::uint32_t corner : loop) number[corner] = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] == 0) continue;
    number[i] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(points[i]);
  }
  if (vertices.size() > most_vertices) return true;  // the caller refuses this
  std::vector<std::vector<std::uint32_t>> numbered = loops;
  for (auto& loop : numbered)
    for (std::uint32_t& corner : loop) corner = number[corner];
  return assemble(numbered) && holds(points, shapes::slack * flat);
}

bool ConvexHull::Data::assemble(std::span<const std::vector<std::uint32_t>> loops) {
  for (const auto& loop : loops) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), loop.begin(), loop.end());
    faces.push_back(shapes::face_of(vertices, std::span(corners).subspan(first), first));
  }
  return connect();
}

/// Finds the edges; each has a face on either side.
bool ConvexHull::Data::connect() {
  using DirectedEdge = std::array<std::uint32_t, 3>;  // from, to, face
  std::vector<DirectedEdge> directed;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const std::span<const std::uint32_t> loop = std::span(corners).subspan(faces[i].first, faces[i].corners);
    for (std::size_t k = 0; k < loop.size(); ++k) directed.push_back({loop[k], loop[(k + 1) % loop.size()], i});
  }
  std::sort(directed.begin(), directed.end());
  for (std::size_t i = 0; i < directed.size(); ++i) {
    const auto& [from, to, face] = directed[i];
    if (from == to || (i > 0 && directed[i - 1][0] == from && directed[i - 1][1] == to)) return false;
  }
  for (const auto& [from, to, face] : directed) {
    const auto back = std::lower_bound(directed.begin(), directed.end(), DirectedEdge{to, from, 0});
    if (back == directed.end() || (*back)[0] != to || (*back)[1] != from) return false;
    if (from < to) edges.push_back({from, to, face, (*back)[2]});
    first_neighbor.resize(from + 1, static_cast<std::uint32_t>(neighbors.size()));
    neighbors.push_back(to);
  }
  first_neighbor.push_back(static_cast<std::uint32_t>(neighbors.size()));
  return vertices.size() + faces.size() == edges.size() + 2;
}

/// Whether all points are behind all faces, and all faces are flat.
bool ConvexHull::Data::holds(std::span<const Vec3> points, double within) const {
  for (const Face& face : faces) {
    for (const Vec3& point : points)
      if (!(face.normal.dot(point) <= face.offset + within)) return false;
    for (const std::uint32_t corner : std::span(corners).subspan(face.first, face.corners))
      if (!(face.normal.dot(vertices[corner]) >= face.offset - within)) return false;
  }
  return true;
}

ConvexHull::ConvexHull(std::span<const Vec3> points) {
  shapes::require_usable(points);
  std::shared_ptr<Data> data;
  // Points that are too inexact for the usual thickness of planes may suit a greater one.
  double flat = shapes::flat_distance(points);
  for (int attempt = 0; attempt < shapes::most_attempts && !data; ++attempt, flat *= shapes::thickening) {
    auto made = std::make_shared<Data>();
    if (made->make(points, flat)) data = std::move(made);
  }
  if (!data) shapes::refuse_rounding(points.size());
  if (data->vertices.size() > most_vertices)
    throw std::invalid_argument("a convex hull can have " + std::to_string(most_vertices) +
                                " vertices, but these points make " + std::to_string(data->vertices.size()) +
                                "; take fewer points, or fewer sides around");
  data_ = data;
  data->finish(surface());
}

void ConvexHull::Data::finish(const SurfaceMesh& surface) {
  measures = measure(surface);
  const Vec3& center = measures.center;
  inner_radius = shapes::greatest_extent;
  for (const Face& face : faces) inner_radius = std::min(inner_radius, face.offset - face.normal.dot(center));
  for (const Vec3& vertex : vertices) outer_radius = std::max(outer_radius, (vertex - center).norm());
}

ConvexHull::ConvexHull(std::span<const Vec3> vertices, std::span<const std::vector<std::uint32_t>> faces) {
  shapes::require_usable(vertices);
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("these vertices and faces are no convex hull: ") + what);
  };
  require(vertices.size() <= most_vertices, "there are too many vertices");
  std::vector<std::size_t> used(vertices.size(), 0);
  for (const auto& loop : faces) {
    require(loop.size() >= 3 && loop.size() <= vertices.size(), "a face needs 3 corners, and each vertex only once");
    for (const std::uint32_t corner : loop) {
      require(corner < vertices.size(), "a corner is not one of the vertices");
      ++used[corner];
    }
  }
  require(std::ranges::all_of(used, [](std::size_t count) { return count >= 3; }), "a vertex has fewer than 3 faces");
  auto data = std::make_shared<Data>();
  data->vertices.assign(vertices.begin(), vertices.end());
  require(data->assemble(faces), "faces do not meet at edges, two at each");
  require(data->holds(vertices, shapes::most_slack * shapes::flat_distance(vertices)),
          "a face is not flat or not outside");
  data_ = data;
  data->finish(surface());
  require(data->measures.volume > 0, "it is inside out");
}

ConvexHull::ConvexHull(const SurfaceMesh& mesh) : ConvexHull(std::span<const Vec3>(mesh.positions)) {}

std::span<const Vec3> ConvexHull::vertices() const noexcept {
  return data_->vertices;
}
std::span<const ConvexHull::Face> ConvexHull::faces() const noexcept {
  return data_->faces;
}
std::span<const ConvexHull::Edge> ConvexHull::edges() const noexcept {
  return data_->edges;
}
std::span<const std::uint32_t> ConvexHull::corners(const Face& face) const noexcept {
  return std::span<const std::uint32_t>(data_->corners).subspan(face.first, face.corners);
}
std::span<const std::uint32_t> ConvexHull::neighbors(std::size_t vertex) const noexcept {
  const std::uint32_t first = data_->first_neighbor[vertex];
  return std::span<const std::uint32_t>(data_->neighbors).subspan(first, data_->first_neighbor[vertex + 1] - first);
}
const MeshMeasures& ConvexHull::measures() const noexcept {
  return data_->measures;
}
double ConvexHull::inner_radius() const noexcept {
  return data_->inner_radius;
}
double ConvexHull::outer_radius() const noexcept {
  return data_->outer_radius;
}

SurfaceMesh ConvexHull::surface() const {
  SurfaceMesh mesh;
  for (const Face& face : faces()) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t corner : corners(face)) {
      mesh.positions.push_back(vertices()[corner]);
      mesh.normals.push_back(face.normal);
    }
    for (std::uint32_t i = 2; i < face.corners; ++i)
      mesh.triangles.insert(mesh.triangles.end(), {first, first + i - 1, first + i});
  }
  return mesh;
}

}  // namespace tweenfall
