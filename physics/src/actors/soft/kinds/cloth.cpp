#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <map>

#include "actors/soft/skin.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall {

namespace soft {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

/// An edge and what lies on it.
struct Hem {
  double area = 0;                       ///< of its triangles, m^2
  std::vector<std::uint32_t> opposites;  ///< their third corners
};

double cotangent(const Vec3& a, const Vec3& b) {
  return a.dot(b) / a.cross(b).norm();
}

/// For an edge 01 with triangles 012 and 103. It is a third of that in the source: so a sheet rolled to a cylinder,
/// which is how cloth bends, holds half of its bending over the square of the radius; in the source, a sphere does.
/// Source: Bergou et al., 2006, section 3.
SoftBend hinge(const std::vector<Vec3>& x, const Ends& ends, const Hem& hem, double bending) {
  const auto [n0, n1] = ends;
  const std::uint32_t n2 = hem.opposites[0], n3 = hem.opposites[1];
  const Vec3 e0 = x[n1] - x[n0];
  const double c01 = cotangent(e0, x[n2] - x[n0]), c02 = cotangent(e0, x[n3] - x[n0]);
  const double c03 = cotangent(-e0, x[n2] - x[n1]), c04 = cotangent(-e0, x[n3] - x[n1]);
  return {.nodes = {n0, n1, n2, n3},
          .weights = {c03 + c04, c01 + c02, -c01 - c03, -c02 - c04},
          .stiffness = bending / hem.area};
}

void check(const ClothMaterial& material) {
  state::require(material.density >= state::smallest && material.density <= state::largest,
                 "the density of a cloth must be above 0 kg/m^2, not " + number_text(material.density));
  state::require(material.stretching > 0 && state::countable(material.stretching),
                 "a cloth must resist stretching with more than 0 N/m, not " + number_text(material.stretching));
  state::require_amount(material.damping, "damping of a cloth");
  state::require_amount(material.bending, "bending of a cloth");
  state::require(material.tear > 0, "a cloth must tear at a strain above 0, not " + number_text(material.tear));
}

}  // namespace

SoftSettings skin(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
                  const ClothMaterial& material) {
  check(material);
  SoftSettings made;
  std::vector<double> areas(positions.size(), 0);
  std::map<Ends, Hem> hems;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& triangle = triangles[i];
    const Vec3 first = positions[triangle[1]] - positions[triangle[0]];
    const Vec3 second = positions[triangle[2]] - positions[triangle[0]];
    const double area = 0.5 * first.cross(second).norm();
    state::require(area >= 1e-9 * first.norm() * second.norm() && area >= state::smallest,
                   "triangle " + std::to_string(i) + " of a cloth has no area");
    for (std::size_t k = 0; k < 3; ++k) {
      areas[triangle[k]] += area / 3;
      const Ends ends = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      Hem& hem = hems[ends];
      hem.area += area;
      hem.opposites.push_back(triangle[(k + 2) % 3]);
    }
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    state::require(areas[i] > 0, "vertex " + std::to_string(i) + " of a cloth belongs to no triangle");
    made.masses.push_back(material.density * areas[i]);
  }
  for (const auto& [ends, hem] : hems) {
    const double square = (positions[ends.second] - positions[ends.first]).squaredNorm();
    made.edges.push_back({.a = ends.first,
                          .b = ends.second,
                          .length = {},
                          .stiffness = material.stretching * hem.area / square,
                          .damping = material.damping * hem.area / square,
                          .tear = material.tear});
    if (material.bending > 0 && hem.opposites.size() == 2)
      made.bends.push_back(hinge(positions, ends, hem, material.bending));
  }
  made.positions = std::move(positions);
  made.triangles = std::move(triangles);
  return made;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const SurfaceMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
    triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
  return triangles;
}

SurfaceMesh checked_mesh(const SurfaceMesh& mesh, const char* what) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!state::countable(mesh.positions[i]))
      state::require_finite(mesh.positions[i], ("vertex " + std::to_string(i) + " of " + what).c_str());
  for (const std::uint32_t corner : mesh.triangles)
    state::require(corner < mesh.positions.size(), std::string("a triangle of ") + what + " names vertex " +
                                                       std::to_string(corner) + "; there are " +
                                                       std::to_string(mesh.positions.size()));
  SurfaceMesh result = welded(mesh);
  state::require(!result.triangles.empty(), std::string(what) + " needs a triangle with an area");
  return result;
}

}  // namespace soft

SoftSettings cloth(const ClothSettings& settings) {
  using state::require;
  require(settings.columns >= 1 && settings.columns <= 1000 && settings.rows >= 1 && settings.rows <= 1000,
          "a cloth has 1 to 1000 columns and rows, not " + std::to_string(settings.columns) + " and " +
              std::to_string(settings.rows));
  state::require_finite(settings.corner, "corner of a cloth");
  state::require_finite(settings.along, "side of a cloth");
  state::require_finite(settings.across, "side of a cloth");
  require(settings.along.cross(settings.across).norm() > 1e-9 * settings.along.norm() * settings.across.norm(),
          "the two sides of a cloth must have lengths and not lie on one line");
  const auto columns = static_cast<std::uint32_t>(settings.columns), rows = static_cast<std::uint32_t>(settings.rows);
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      positions.push_back(settings.corner + settings.along * (static_cast<double>(i) / columns) +
                          settings.across * (static_cast<double>(j) / rows));
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      // Diagonals in turn one way and the other, so that no direction is favored.
      if ((i + j) % 2 == 0) {
        triangles.push_back({a, d, b});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, c, b});
        triangles.push_back({b, c, d});
      }
    }
  return soft::skin(std::move(positions), std::move(triangles), settings.material);
}

SoftSettings cloth(const SurfaceMesh& mesh, const ClothMaterial& material) {
  const SurfaceMesh checked = soft::checked_mesh(mesh, "a cloth");
  return soft::skin(checked.positions, soft::triangles_of(checked), material);
}

}  // namespace tweenfall
