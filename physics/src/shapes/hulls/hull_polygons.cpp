#include "shapes/hulls/hull_polygons.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shapes/hulls/hull_triangles.h"

namespace tweenfall::shapes {

namespace {

using HullLoop = std::vector<std::uint32_t>;

constexpr std::uint32_t no_region = 0xffffffffu;

/// Regions of triangles that lie in one plane: grown from the largest triangles, whose planes are the most certain.
std::vector<std::uint32_t> plane_regions(std::span<const Vec3> points, const std::vector<HullTriangle>& triangles,
                                         double flat) {
  std::vector<Vec3> normals;
  std::vector<double> areas;
  for (const HullTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
    areas.push_back(normal.norm());
    normals.push_back(normal / areas.back());
  }
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });

  std::vector<std::uint32_t> region(triangles.size(), no_region), grown;
  for (const std::uint32_t seed : order) {
    if (region[seed] != no_region) continue;
    const double offset = normals[seed].dot(points[triangles[seed].corners[0]]);
    const auto in_plane = [&](std::uint32_t corner) {
      return std::abs(normals[seed].dot(points[corner]) - offset) <= flat;
    };
    region[seed] = seed;
    grown = {seed};
    for (std::size_t i = 0; i < grown.size(); ++i)
      for (const std::uint32_t next : triangles[grown[i]].across) {
        const auto& corners = triangles[next].corners;
        if (region[next] != no_region || !std::all_of(corners.begin(), corners.end(), in_plane)) continue;
        region[next] = seed;
        grown.push_back(next);
      }
  }
  return region;
}

/// The border of a region, starting from its smallest corner; empty if it is not one simple loop.
HullLoop border(const std::vector<HullTriangle>& triangles, const std::vector<std::uint32_t>& region,
                const std::vector<std::uint32_t>& members, std::vector<std::uint32_t>& next) {
  HullLoop starts;
  bool simple = true;
  for (const std::uint32_t member : members)
    for (std::size_t k = 0; k < 3; ++k) {
      const HullTriangle& triangle = triangles[member];
      if (region[triangle.across[k]] == region[member]) continue;
      const std::uint32_t from = triangle.corners[k];
      simple = simple && next[from] == no_region;
      next[from] = triangle.corners[(k + 1) % 3];
      starts.push_back(from);
    }
  HullLoop loop;
  const std::uint32_t first = *std::min_element(starts.begin(), starts.end());
  for (std::uint32_t at = first; simple && loop.size() <= starts.size(); at = next[at]) {
    if (at == first && !loop.empty()) break;
    loop.push_back(at);
  }
  for (const std::uint32_t start : starts) next[start] = no_region;
  return loop.size() == starts.size() ? loop : HullLoop{};
}

/// Removes vertices at which only two faces meet, on a straight edge, and faces of which nothing then remains.
void straighten(std::vector<HullLoop>& loops, std::size_t points) {
  std::vector<int> faces(points);
  bool changed = true;
  while (changed) {
    changed = false;
    std::fill(faces.begin(), faces.end(), 0);
    for (const HullLoop& loop : loops)
      for (const std::uint32_t corner : loop) ++faces[corner];
    for (HullLoop& loop : loops)
      changed = std::erase_if(loop, [&](std::uint32_t corner) { return faces[corner] < 3; }) > 0 || changed;
    changed = std::erase_if(loops, [](const HullLoop& loop) { return loop.size() < 3; }) > 0 || changed;
  }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> hull_polygons(std::span<const Vec3> points, double flat) {
  const std::vector<HullTriangle> triangles = hull_triangles(points, flat);
  // Twice the thickness of planes on either side: the triangles of one plane lie anywhere within it.
  std::vector<std::uint32_t> region = plane_regions(points, triangles, 4 * flat);
  std::vector<std::vector<std::uint32_t>> members(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) members[region[i]].push_back(i);

  std::vector<HullLoop> loops;
  std::vector<std::uint32_t> next(points.size(), no_region);
  for (const std::vector<std::uint32_t>& region_members : members) {
    if (region_members.empty()) continue;
    const HullLoop loop = border(triangles, region, region_members, next);
    if (!loop.empty()) {
      loops.push_back(loop);
      continue;
    }
    for (const std::uint32_t member : region_members) {
      const auto& corners = triangles[member].corners;
      loops.emplace_back(corners.begin(), corners.end());
    }
  }
  straighten(loops, points.size());
  for (HullLoop& loop : loops) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  std::sort(loops.begin(), loops.end());
  return loops;
}

}  // namespace tweenfall::shapes
