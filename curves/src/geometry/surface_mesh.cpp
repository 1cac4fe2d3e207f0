#include <tweenfall/curves/surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tweenfall {

SurfaceMesh welded(const SurfaceMesh& mesh) {
  const std::vector<Vec3>& p = mesh.positions;
  const auto before = [&p](std::uint32_t a, std::uint32_t b) {
    for (int i = 0; i < 3; ++i)
      if (p[a][i] != p[b][i]) return p[a][i] < p[b][i];
    return a < b;
  };
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), before);
  std::vector<std::uint32_t> first(p.size());  // the first vertex at the same place
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && p[order[i]] == p[order[i - 1]] ? first[order[i - 1]] : order[i];

  SurfaceMesh result;
  constexpr std::uint32_t unused = 0xffffffffu;
  std::vector<std::uint32_t> made(p.size(), unused);
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const std::uint32_t corners[3] = {first[mesh.triangles[i]], first[mesh.triangles[i + 1]],
                                      first[mesh.triangles[i + 2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (const std::uint32_t corner : corners) {
      if (made[corner] == unused) {
        made[corner] = static_cast<std::uint32_t>(result.positions.size());
        result.positions.push_back(p[corner]);
      }
      result.triangles.push_back(made[corner]);
    }
  }
  return result;
}

bool is_closed(const SurfaceMesh& mesh) {
  const SurfaceMesh whole = welded(mesh);
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges, reversed;
  for (std::size_t i = 0; i < whole.triangles.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = whole.triangles[i + k], b = whole.triangles[i + (k + 1) % 3];
      edges.emplace_back(a, b);
      reversed.emplace_back(b, a);
    }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return !edges.empty() && edges == reversed && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

MeshMeasures measure(const SurfaceMesh& mesh) noexcept {
  MeshMeasures result;
  if (mesh.positions.empty()) return result;
  // Relative to a point among the vertices, so that a mesh far from the origin loses no digits.
  Vec3 middle(0, 0, 0);
  for (const Vec3& p : mesh.positions) middle += p;
  middle /= static_cast<double>(mesh.positions.size());

  Vec3 first(0, 0, 0);         // integral of the position
  Mat3 second = Mat3::Zero();  // integral of the position times itself, transposed
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.triangles[i]] - middle, b = mesh.positions[mesh.triangles[i + 1]] - middle,
               c = mesh.positions[mesh.triangles[i + 2]] - middle;
    const Vec3 normal = (b - a).cross(c - a);
    const double volume = a.dot(b.cross(c)) / 6;
    const Vec3 sum = a + b + c;
    result.area += 0.5 * normal.norm();
    result.volume += volume;
    first += (volume / 4) * sum;
    second += (volume / 20) * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  result.center = middle;
  if (result.volume == 0) return result;
  const Vec3 offset = first / result.volume;
  result.center += offset;
  second -= result.volume * (offset * offset.transpose());
  result.inertia = second.trace() * Mat3::Identity() - second;
  return result;
}

}  // namespace tweenfall
