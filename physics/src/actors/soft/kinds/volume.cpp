#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <map>

#include "actors/soft/skin.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall {

namespace soft {
namespace {

using Four = std::array<std::uint32_t, 4>;
using Three = std::array<std::uint32_t, 3>;

/// A cell as five tetrahedra: one in the middle on every other corner, and one at each remaining corner. Cells
/// alternate between the two halves of the corners, so that their faces match.
void divide(const std::array<std::uint32_t, 8>& corners, bool odd, std::vector<Four>& solids) {
  constexpr std::array<std::size_t, 4> even_ones{0, 3, 5, 6}, odd_ones{1, 2, 4, 7};
  const auto& middle = odd ? odd_ones : even_ones;
  const auto& cut = odd ? even_ones : odd_ones;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    // Seen from the fourth, the first three run counter-clockwise; corners are numbered by bits x, y, z.
    const auto at = [](std::size_t corner) {
      return Vec3(static_cast<double>(corner & 1), static_cast<double>(corner >> 1 & 1),
                  static_cast<double>(corner >> 2 & 1));
    };
    if (volume_of(at(a), at(b), at(c), at(d)) < 0) std::swap(a, b);
    solids.push_back({corners[a], corners[b], corners[c], corners[d]});
  };
  add(middle[0], middle[1], middle[2], middle[3]);
  for (const std::size_t corner : cut) add(corner, corner ^ 1u, corner ^ 2u, corner ^ 4u);
}

/// The faces that only one tetrahedron has, seen from outside.
std::vector<Three> surface_of(const std::vector<Four>& solids) {
  std::map<Three, std::pair<int, Three>> sides;
  std::vector<Three> order;
  for (const auto& [a, b, c, d] : solids)
    for (const Three& side : {Three{a, c, b}, Three{a, b, d}, Three{b, c, d}, Three{a, d, c}}) {
      Three sorted = side;
      std::ranges::sort(sorted);
      auto& entry = sides[sorted];
      if (entry.first++ == 0) order.push_back(sorted);
      entry.second = side;
    }
  std::vector<Three> surface;
  for (const Three& side : order)
    if (const auto& [count, triangle] = sides[side]; count == 1) surface.push_back(triangle);
  return surface;
}

void check(const VolumeMaterial& material) {
  state::require(material.density >= state::smallest && material.density <= state::largest,
                 "the density of a soft volume must be above 0 kg/m^3, not " + number_text(material.density));
  state::require(material.stiffness > 0 && state::countable(material.stiffness),
                 "the stiffness of a soft volume must be above 0 Pa, not " + number_text(material.stiffness));
  state::require(material.bulk > 0,
                 "the bulk stiffness of a soft volume must be above 0 Pa, not " + number_text(material.bulk));
  state::require_amount(material.damping, "damping of a soft volume");
  state::require(material.tear > 0, "a soft volume must tear at a strain above 0, not " + number_text(material.tear));
}

SoftSettings filled(std::vector<Vec3> positions, const std::vector<Four>& solids, const VolumeMaterial& material) {
  SoftSettings made;
  made.masses.assign(positions.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> edges;
  for (const Four& nodes : solids) {
    const double volume = volume_of(positions[nodes[0]], positions[nodes[1]], positions[nodes[2]], positions[nodes[3]]);
    made.tetrahedra.push_back({.nodes = nodes, .stiffness = material.bulk, .volume = {}});
    for (std::size_t k = 0; k < 4; ++k) {
      made.masses[nodes[k]] += material.density * volume / 4;
      for (std::size_t other = 0; other < k; ++other) edges[std::minmax(nodes[k], nodes[other])] += volume;
    }
  }
  for (const auto& [ends, volume] : edges) {
    const double square = (positions[ends.second] - positions[ends.first]).squaredNorm();
    made.edges.push_back({.a = ends.first,
                          .b = ends.second,
                          .length = {},
                          .stiffness = material.stiffness * volume / square,
                          .damping = material.damping * volume / square,
                          .tear = material.tear});
  }
  made.positions = std::move(positions);
  made.triangles = surface_of(solids);
  return made;
}

}  // namespace
}  // namespace soft

SoftSettings soft_box(const SoftBoxSettings& settings) {
  using state::require;
  soft::check(settings.material);
  for (const int cells : settings.cells)
    require(cells >= 1 && cells <= 100, "a soft box has 1 to 100 cells along each axis, not " + std::to_string(cells));
  for (int axis = 0; axis < 3; ++axis)
    require(settings.half_extents[axis] >= 1e-9 && state::countable(settings.half_extents[axis]),
            "half extents of a soft box must be above 0 m, not " + number_text(settings.half_extents[axis]));
  state::require_finite(settings.pose.position, "position of a soft box");
  const Quat rotation = state::checked(Motion{settings.pose, {}, Vec3(0, 0, 0)}).pose.rotation;
  const auto x = static_cast<std::uint32_t>(settings.cells[0]), y = static_cast<std::uint32_t>(settings.cells[1]),
             z = static_cast<std::uint32_t>(settings.cells[2]);
  const auto number = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return (k * (y + 1) + j) * (x + 1) + i;
  };
  std::vector<Vec3> positions;
  for (std::uint32_t k = 0; k <= z; ++k)
    for (std::uint32_t j = 0; j <= y; ++j)
      for (std::uint32_t i = 0; i <= x; ++i) {
        const Vec3 share(2.0 * i / x - 1, 2.0 * j / y - 1, 2.0 * k / z - 1);
        positions.push_back(settings.pose.position + rotation * Vec3(share.cwiseProduct(settings.half_extents)));
      }
  std::vector<soft::Four> solids;
  for (std::uint32_t k = 0; k < z; ++k)
    for (std::uint32_t j = 0; j < y; ++j)
      for (std::uint32_t i = 0; i < x; ++i) {
        std::array<std::uint32_t, 8> corners{};
        for (std::uint32_t c = 0; c < 8; ++c) corners[c] = number(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
        soft::divide(corners, (i + j + k) % 2 == 1, solids);
      }
  return soft::filled(std::move(positions), solids, settings.material);
}

SoftSettings balloon(const SurfaceMesh& mesh, const BalloonMaterial& material) {
  const SurfaceMesh checked = soft::checked_mesh(mesh, "a balloon");
  state::require(is_closed(checked), "the mesh of a balloon must be closed: each edge needs a triangle on either side");
  state::require(material.bulk > 0,
                 "the bulk stiffness of a balloon must be above 0 Pa, not " + number_text(material.bulk));
  state::require(material.pressure >= 1e-6 && material.pressure <= 1e6,
                 "the pressure of a balloon must lie in 1e-6 to 1e6, not " + number_text(material.pressure));
  SoftSettings made = soft::skin(checked.positions, soft::triangles_of(checked), material.skin);
  const double volume = soft::enclosed_by(made.triangles, made.positions);
  state::require(volume > 0, "the mesh of a balloon is inside out: its triangles must run counter-clockwise");
  made.enclosures.push_back(
      {.triangles = made.triangles, .stiffness = material.bulk, .volume = volume * material.pressure});
  return made;
}

}  // namespace tweenfall
