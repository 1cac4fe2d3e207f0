#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/triangle_mesh.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "collision/surfaces/surface.h"
#include "state/countable.h"

namespace tweenfall {

namespace surfaces {

class MeshSurface : public Surface {
 public:
  explicit MeshSurface(SurfaceMesh mesh)
      : Surface(1), vertices_(std::move(mesh.positions)), corners_(std::move(mesh.triangles)) {
    std::vector<Bounds> boxes;
    boxes.reserve(triangle_count());
    for (std::uint32_t i = 0; i < triangle_count(); ++i) boxes.push_back(triangle(i).bounds());
    plant(boxes);
    find_neighbors();
  }

  [[nodiscard]] std::uint32_t triangle_count() const noexcept override {
    return static_cast<std::uint32_t>(corners_.size() / 3);
  }
  [[nodiscard]] SurfaceTriangle triangle(std::uint32_t index) const noexcept override {
    const std::size_t first = std::size_t{3} * index;
    const std::array<std::uint32_t, 3> its = {corners_[first], corners_[first + 1], corners_[first + 2]};
    return {{vertices_[its[0]], vertices_[its[1]], vertices_[its[2]]}, its};
  }
  [[nodiscard]] std::uint32_t across(std::uint32_t index, std::size_t side) const noexcept override {
    return across_[std::size_t{3} * index + side];
  }

  [[nodiscard]] const std::vector<Vec3>& vertices() const noexcept { return vertices_; }
  [[nodiscard]] const std::vector<std::uint32_t>& corners() const noexcept { return corners_; }

 private:
  /// Two triangles share a side if they run along it in opposite directions; if more than two do, none of them share
  /// it.
  void find_neighbors() {
    struct Side {
      std::uint32_t low, high, place;
      bool rising;
    };
    std::vector<Side> sides;
    sides.reserve(corners_.size());
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      const std::uint32_t from = corners_[i], to = corners_[i % 3 == 2 ? i - 2 : i + 1];
      sides.push_back({std::min(from, to), std::max(from, to), i, from < to});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      if (a.low != b.low) return a.low < b.low;
      return a.high != b.high ? a.high < b.high : a.place < b.place;
    });
    across_.assign(corners_.size(), none);
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
      if (end - begin != 2 || sides[begin].rising == sides[begin + 1].rising) continue;
      across_[sides[begin].place] = sides[begin + 1].place / 3;
      across_[sides[begin + 1].place] = sides[begin].place / 3;
    }
  }

  std::vector<Vec3> vertices_;
  std::vector<std::uint32_t> corners_, across_;
};

namespace {

void require_mesh(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("a triangle mesh " + what);
}

/// The mesh checked, with each vertex once, and without triangles that have no area.
SurfaceMesh sound(const SurfaceMesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    require_mesh(state::countable(p), "has vertex " + std::to_string(i) + " at (" + number_text(p.x()) + ", " +
                                          number_text(p.y()) + ", " + number_text(p.z()) +
                                          "); vertices must be finite and at most 1e30 m away");
  }
  require_mesh(mesh.triangles.size() % 3 == 0,
               "has " + std::to_string(mesh.triangles.size()) + " corners, which is not three per triangle");
  require_mesh(mesh.triangles.size() / 3 <= TriangleMesh::most_triangles,
               "can have " + std::to_string(TriangleMesh::most_triangles) + " triangles, but has " +
                   std::to_string(mesh.triangles.size() / 3));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    require_mesh(mesh.triangles[i] < mesh.positions.size(),
                 "has a triangle, number " + std::to_string(i / 3) + ", with vertex " +
                     std::to_string(mesh.triangles[i]) + ", but there are " + std::to_string(mesh.positions.size()));
  SurfaceMesh thick;
  thick.positions = mesh.positions;
  thick.triangles.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Vec3& a = mesh.positions[mesh.triangles[i]];
    const Vec3 along = mesh.positions[mesh.triangles[i + 1]] - a, other = mesh.positions[mesh.triangles[i + 2]] - a;
    const double length = std::max({along.norm(), other.norm(), (other - along).norm()});
    // Each factor by itself: the square of a very small or very great length is not finite or 0.
    if (!(length > 0) || !((along / length).cross(other / length).norm() > 1e-9)) continue;
    for (std::size_t k = 0; k < 3; ++k) thick.triangles.push_back(mesh.triangles[i + k]);
  }
  SurfaceMesh result = welded(thick);
  require_mesh(!result.triangles.empty(), mesh.triangles.empty()
                                              ? "needs at least one triangle"
                                              : "needs a triangle with an area; all of these " +
                                                    std::to_string(mesh.triangles.size() / 3) + " have none");
  return result;
}

}  // namespace
}  // namespace surfaces

TriangleMesh::TriangleMesh(const SurfaceMesh& mesh)
    : surface_(std::make_shared<const surfaces::MeshSurface>(surfaces::sound(mesh))) {}

std::span<const Vec3> TriangleMesh::vertices() const noexcept {
  return surface_->vertices();
}
std::span<const std::uint32_t> TriangleMesh::triangles() const noexcept {
  return surface_->corners();
}
const surfaces::Surface& TriangleMesh::inside() const noexcept {
  return *surface_;
}

SurfaceMesh TriangleMesh::surface() const {
  SurfaceMesh mesh;
  mesh.positions = surface_->vertices();
  mesh.triangles = surface_->corners();
  return mesh;
}

}  // namespace tweenfall
