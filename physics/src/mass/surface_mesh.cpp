#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>

#include "mass/weighing.h"

namespace tweenfall {

namespace mass {
namespace {

std::string text_of_vertex(const Vec3& p) {
  return "(" + number_text(p.x()) + ", " + number_text(p.y()) + ", " + number_text(p.z()) + ")";
}

/// Six times the volume between a point and a triangle: negative if the triangle faces the point.
double six_volumes(const SurfaceMesh& mesh, std::size_t triangle, const Vec3& from) {
  const auto corner = [&](std::size_t k) { return Vec3(mesh.positions[mesh.triangles[3 * triangle + k]] - from); };
  return corner(0).dot(corner(1).cross(corner(2)));
}

/// Corners that name no vertex, and vertices that are not finite.
std::string fault_of_lists(const SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) return "a mesh with mass needs triangles; this one has none";
  if (mesh.triangles.size() % 3 != 0)
    return "a triangle has three corners, but this mesh has " + std::to_string(mesh.triangles.size()) + " in all";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t vertex = mesh.triangles[i];
    if (vertex >= mesh.positions.size())
      return "triangle " + std::to_string(i / 3) + " of a mesh names vertex " + std::to_string(vertex) +
             ", but there are only " + std::to_string(mesh.positions.size());
    if (!mesh.positions[vertex].allFinite())
      return "vertex " + std::to_string(vertex) + " of a mesh must be finite, but is " +
             text_of_vertex(mesh.positions[vertex]);
  }
  return {};
}

/// For each vertex, the first one at its position.
std::vector<std::uint32_t> first_at_place(const SurfaceMesh& mesh) {
  const std::vector<Vec3>& p = mesh.positions;
  std::vector<std::uint32_t> order(p.size()), first(p.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::ranges::stable_sort(order, [&p](std::uint32_t a, std::uint32_t b) {
    return std::tie(p[a][0], p[a][1], p[a][2]) < std::tie(p[b][0], p[b][1], p[b][2]);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && p[order[i]] == p[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

/// A side of a triangle, in the direction in which the triangle runs along it.
struct Side {
  std::uint32_t from, to;
  std::size_t triangle;
};

std::string fault_of_edges(const SurfaceMesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_place(mesh);
  std::vector<Side> sides;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const std::uint32_t corners[3] = {first[mesh.triangles[i]], first[mesh.triangles[i + 1]],
                                      first[mesh.triangles[i + 2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) sides.push_back({corners[k], corners[(k + 1) % 3], i / 3});
  }
  if (sides.empty()) return "no triangle of this mesh has an area";
  const auto before = [](const Side& a, const Side& b) {
    return std::tie(a.from, a.to, a.triangle) < std::tie(b.from, b.to, b.triangle);
  };
  std::ranges::sort(sides, before);
  const auto edge = [&](const Side& side) {
    return "the edge from " + text_of_vertex(mesh.positions[side.from]) + " to " +
           text_of_vertex(mesh.positions[side.to]);
  };
  // Inconsistent triangles are reported before edges with a single side, since they leave such edges elsewhere.
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i - 1].from == sides[i].from && sides[i - 1].to == sides[i].to)
      return "triangles " + std::to_string(sides[i - 1].triangle) + " and " + std::to_string(sides[i].triangle) +
             " of a mesh run the same way along " + edge(sides[i]) +
             ": one of them is wound inwards, or more than two meet there";
  for (const Side& side : sides) {
    const Side other{side.to, side.from, 0};
    const auto found = std::ranges::lower_bound(sides, other, before);
    if (found == sides.end() || found->from != other.from || found->to != other.to)
      return "only a closed mesh has mass properties; this one has open edges: " + edge(side) + " of triangle " +
             std::to_string(side.triangle) + " has no triangle on its other side";
  }
  return {};
}

/// Triangles that hang together, and what they enclose.
struct MeshPart {
  std::vector<std::size_t> triangles;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double volume = 0;  ///< m^3
};

std::vector<MeshPart> mesh_parts(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> over = first_at_place(mesh);
  const auto top = [&over](std::uint32_t vertex) {
    while (over[vertex] != vertex) vertex = over[vertex] = over[over[vertex]];
    return vertex;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) over[top(mesh.triangles[i])] = top(mesh.triangles[i - i % 3]);
  std::vector<MeshPart> parts;
  std::vector<std::size_t> number(mesh.positions.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::size_t& which = number[top(mesh.triangles[i])];
    if (which == mesh.positions.size()) {
      which = parts.size();
      parts.emplace_back();
    }
    MeshPart& part = parts[which];
    part.triangles.push_back(i / 3);
    for (std::size_t k = i; k < i + 3; ++k) {
      part.low = part.low.cwiseMin(mesh.positions[mesh.triangles[k]]);
      part.high = part.high.cwiseMax(mesh.positions[mesh.triangles[k]]);
    }
    const Vec3& from = mesh.positions[mesh.triangles[3 * part.triangles.front()]];
    part.volume += six_volumes(mesh, i / 3, from) / 6;
  }
  return parts;
}

/// How often a part goes around a point: 1 inside of it, -1 if it is inside out, 0 outside.
/// Source of the solid angles: Van Oosterom, Strackee, The Solid Angle of a Plane Triangle, 1983.
double turns_around(const SurfaceMesh& mesh, const MeshPart& part, const Vec3& point) {
  if ((point.array() < part.low.array()).any() || (point.array() > part.high.array()).any()) return 0;
  double angle = 0;
  for (const std::size_t triangle : part.triangles) {
    const auto corner = [&](std::size_t k) { return Vec3(mesh.positions[mesh.triangles[3 * triangle + k]] - point); };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * elementary::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Parts that are inside out are hollows, which lie inside of others.
std::string fault_of_parts(const SurfaceMesh& mesh) {
  const std::vector<MeshPart> parts = mesh_parts(mesh);
  for (const MeshPart& part : parts) {
    // Sheets with two sides enclose nothing but rounding.
    const double size = (part.high - part.low).norm();
    if (!(part.volume < -1e-12 * size * size * size)) continue;
    const std::size_t triangle = part.triangles.front();
    Vec3 middle(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.triangles[3 * triangle + k]] / 3;
    double turns = 0;
    for (const MeshPart& other : parts)
      if (&other != &part) turns += turns_around(mesh, other, middle);
    if (turns < 0.5)
      return "a part of this mesh is inside out, as its triangle " + std::to_string(triangle) + " at " +
             text_of_vertex(middle) + " shows, and is no hollow inside of another; it encloses " +
             number_text(part.volume) + " m^3";
  }
  return {};
}

std::string fault_of_volume(const SurfaceMesh& mesh) {
  const MeshMeasures measures = measure(mesh);
  if (measures.volume > 0) return fault_of_parts(mesh);
  const std::string volume = "; it encloses " + number_text(measures.volume) + " m^3";
  const std::string all = "a mesh with mass must enclose a volume, its triangles wound outwards";
  if (!(measures.volume < 0)) return all + volume;
  std::size_t most = 0;
  for (std::size_t i = 1; i < mesh.triangles.size() / 3; ++i)
    if (six_volumes(mesh, i, measures.center) < six_volumes(mesh, most, measures.center)) most = i;
  return all + "; this one is inside out, as its triangle " + std::to_string(most) + " shows" + volume;
}

}  // namespace

Pieces pieces_of(const SurfaceMesh& mesh, const Vec3& apex) {
  Pieces pieces;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.triangles[i]] - apex, b = mesh.positions[mesh.triangles[i + 1]] - apex,
               c = mesh.positions[mesh.triangles[i + 2]] - apex;
    const double six = a.dot(b.cross(c));
    if (six == 0) continue;
    // The triangle grows from the apex with u; v goes from one corner to the opposite side.
    pieces.emplace_back([=](double u, double v, double w) {
      const Vec3 across = a + v * ((1 - w) * (b - a) + w * (c - a));
      return Image{apex + u * across, six * u * u * v};
    });
  }
  return pieces;
}

}  // namespace mass

std::string fault_of_solid(const SurfaceMesh& mesh) {
  std::string fault = mass::fault_of_lists(mesh);
  if (fault.empty()) fault = mass::fault_of_edges(mesh);
  if (fault.empty()) fault = mass::fault_of_volume(mesh);
  return fault;
}

MassProperties mass_properties(const SurfaceMesh& mesh, double mass) {
  mass::require_mass(mass);
  if (const std::string fault = fault_of_solid(mesh); !fault.empty()) throw std::invalid_argument(fault);
  const MeshMeasures measures = measure(mesh);
  return {mass, measures.center, mass / measures.volume * measures.inertia};
}

WeighedProperties weigh(const SurfaceMesh& mesh, const Density& density, const Quadrature& quadrature) {
  if (const std::string fault = fault_of_solid(mesh); !fault.empty()) throw std::invalid_argument(fault);
  const MeshMeasures measures = measure(mesh);
  if (density.even()) return {mass_properties(mesh, density.at({0, 0, 0}) * measures.volume)};
  return mass::weigh_pieces({mass::pieces_of(mesh, measures.center),
                             {},
                             measures.center,
                             std::sqrt(measures.inertia.trace() / measures.volume)},
                            density, quadrature);
}

}  // namespace tweenfall
