#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "actors/soft/resolved.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall::soft {

namespace {

using state::require;

constexpr std::size_t most_nodes = 1'000'000, most_parts = 10'000'000;

std::string numbered(const char* what, std::size_t index) {
  return std::string(what) + " " + std::to_string(index);
}

/// Stiffness may be infinite where constraints are used.
void require_stiffness(double stiffness, const std::string& whose, SoftSolver solver) {
  require(stiffness > 0, whose + " must have a stiffness above 0, but has " + number_text(stiffness));
  if (std::isinf(stiffness))
    require(
        solver == SoftSolver::positions,
        whose +
            " has an infinite stiffness, which only the positions solver supports: give it a finite one for springs");
  else
    require(state::countable(stiffness), whose + " must have a stiffness of at most 1e30");
}

void require_tear(double tear, double stiffness, const std::string& whose) {
  require(tear > 0, whose + " must tear at a strain above 0, not " + number_text(tear));
  require(std::isinf(tear) || !std::isinf(stiffness), whose +
                                                          " never stretches, so no strain can tear it: give it a "
                                                          "stiffness");
}

template <std::size_t count>
void require_nodes(const std::array<std::uint32_t, count>& nodes, std::size_t size, const std::string& whose) {
  for (std::size_t i = 0; i < count; ++i) {
    require(nodes[i] < size, whose + " names node " + std::to_string(nodes[i]) + "; there are " + std::to_string(size));
    for (std::size_t k = 0; k < i; ++k)
      require(nodes[i] != nodes[k], whose + " names node " + std::to_string(nodes[i]) + " twice");
  }
}

void check_nodes(const SoftSettings& settings) {
  const std::size_t size = settings.positions.size();
  require(size >= 1, "a soft body needs nodes");
  require(size >= 2, "a soft body needs at least two nodes; for a single one, use a rigid body or a particle");
  require(size <= most_nodes, "a soft body of " + std::to_string(size) + " nodes is too large; a million are allowed");
  require(settings.masses.size() == size, "a soft body of " + std::to_string(size) + " nodes has " +
                                              std::to_string(settings.masses.size()) + " masses");
  require(settings.velocities.empty() || settings.velocities.size() == size,
          "a soft body of " + std::to_string(size) + " nodes has " + std::to_string(settings.velocities.size()) +
              " velocities");
  for (std::size_t i = 0; i < size; ++i) {
    if (!state::countable(settings.positions[i]))
      state::require_finite(settings.positions[i], ("the place of " + numbered("node", i)).c_str());
    const double mass = settings.masses[i];
    if (!(mass >= state::smallest && mass <= state::largest))
      require(false,
              "the mass of " + numbered("node", i) + " must lie in 1e-30 to 1e30 kg, but is " + number_text(mass));
  }
  for (std::size_t i = 0; i < settings.velocities.size(); ++i)
    if (!state::countable(settings.velocities[i]))
      state::require_finite(settings.velocities[i], ("the velocity of " + numbered("node", i)).c_str());
}

void check_edges(SoftSettings& settings) {
  require(settings.edges.size() <= most_parts, "a soft body may have ten million edges");
  for (std::size_t i = 0; i < settings.edges.size(); ++i) {
    SoftEdge& edge = settings.edges[i];
    const auto whose = [i] { return numbered("edge", i); };
    const std::size_t size = settings.positions.size();
    if (edge.a >= size || edge.b >= size || edge.a == edge.b) require_nodes(std::array{edge.a, edge.b}, size, whose());
    if (!edge.length) edge.length = (settings.positions[edge.b] - settings.positions[edge.a]).norm();
    if (!(*edge.length >= state::smallest && *edge.length <= state::largest))
      require(false, whose() + " has no length: its nodes, " + std::to_string(edge.a) + " and " +
                         std::to_string(edge.b) + ", are " + number_text(*edge.length) + " m apart at rest");
    require_stiffness(edge.stiffness, whose(), settings.solver);
    state::require_amount(edge.damping, "damping of an edge");
    require_tear(edge.tear, edge.stiffness, whose());
  }
}

void check_bends(const SoftSettings& settings) {
  require(settings.bends.size() <= most_parts, "a soft body may have ten million bends");
  for (std::size_t i = 0; i < settings.bends.size(); ++i) {
    const SoftBend& bend = settings.bends[i];
    const std::string whose = numbered("bend", i);
    double sum = 0, size = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      require(bend.nodes[k] < settings.positions.size(), whose + " names node " + std::to_string(bend.nodes[k]));
      require(std::abs(bend.weights[k]) <= 1e6, whose + " has a weight beyond 1e6");
      for (std::size_t other = 0; other < k; ++other)
        require(bend.nodes[k] != bend.nodes[other] || bend.weights[k] == 0 || bend.weights[other] == 0,
                whose + " names node " + std::to_string(bend.nodes[k]) + " twice");
      sum += bend.weights[k];
      size += std::abs(bend.weights[k]);
    }
    require(size > 1e-6 && std::abs(sum) <= 1e-9 * size, whose + " must have weights that sum to 0");
    require_stiffness(bend.stiffness, whose, settings.solver);
  }
}

void require_volume(double volume, const std::string& whose) {
  require(volume >= state::smallest && volume <= state::largest,
          whose + " must have a volume above 0, but has " + number_text(volume) +
              " m^3: it is flat, or its nodes run the wrong way round");
}

void check_volumes(SoftSettings& settings) {
  const std::vector<Vec3>& x = settings.positions;
  require(settings.tetrahedra.size() <= most_parts, "a soft body may have ten million tetrahedra");
  for (std::size_t i = 0; i < settings.tetrahedra.size(); ++i) {
    SoftTetrahedron& solid = settings.tetrahedra[i];
    const std::string whose = numbered("tetrahedron", i);
    require_nodes(solid.nodes, x.size(), whose);
    const auto& n = solid.nodes;
    require_volume(volume_of(x[n[0]], x[n[1]], x[n[2]], x[n[3]]), whose);
    if (!solid.volume) solid.volume = volume_of(x[n[0]], x[n[1]], x[n[2]], x[n[3]]);
    require_volume(*solid.volume, whose);
    require_stiffness(solid.stiffness, whose, settings.solver);
  }
  for (std::size_t i = 0; i < settings.enclosures.size(); ++i) {
    SoftEnclosure& enclosure = settings.enclosures[i];
    const std::string whose = numbered("enclosure", i);
    require(!enclosure.triangles.empty() && enclosure.triangles.size() <= most_parts, whose + " needs triangles");
    SurfaceMesh mesh;
    for (const auto& triangle : enclosure.triangles) {
      require_nodes(triangle, x.size(), whose);
      mesh.triangles.insert(mesh.triangles.end(), triangle.begin(), triangle.end());
    }
    mesh.positions = x;
    require(is_closed(mesh),
            whose + " is not closed: each edge must have a triangle on either side, both wound the same way");
    require_volume(enclosed_by(enclosure.triangles, x), whose);
    if (!enclosure.volume) enclosure.volume = enclosed_by(enclosure.triangles, x);
    require_volume(*enclosure.volume, whose);
    require_stiffness(enclosure.stiffness, whose, settings.solver);
  }
}

}  // namespace

double enclosed_by(const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<Vec3>& positions) {
  const Vec3& origin = positions[triangles[0][0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += (positions[a] - origin).dot((positions[b] - origin).cross(positions[c] - origin));
  return sum / 6;
}

SoftSettings checked(const SoftSettings& given) {
  SoftSettings settings = given;
  check_nodes(settings);
  check_edges(settings);
  check_bends(settings);
  check_volumes(settings);
  for (std::size_t i = 0; i < settings.triangles.size(); ++i)
    require_nodes(settings.triangles[i], settings.positions.size(), numbered("triangle", i));
  if (!settings.sub_step) settings.sub_step = settings.solver == SoftSolver::positions ? 1.0 / 1920 : 1.0 / 240;
  require(*settings.sub_step > 0 && state::countable(*settings.sub_step),
          "sub-steps of a soft body must be longer than 0 s, not " + number_text(*settings.sub_step));
  if (!settings.iterations) settings.iterations = enough_iterations(settings);
  require(*settings.iterations >= 1 && *settings.iterations <= 1000,
          "a soft body takes 1 to 1000 iterations, not " + std::to_string(*settings.iterations));
  require(settings.radius >= 1e-9 && state::countable(settings.radius),
          "the radius of a soft body's nodes must be at least 1e-9 m, not " + number_text(settings.radius));
  state::require_amount(settings.friction, "friction of a soft body");
  state::require_amount(settings.linear_damping, "damping of a soft body");
  state::require_amount(settings.air_drag, "air drag of a soft body");
  require(settings.thickness == 0 || (settings.thickness >= 1e-9 && state::countable(settings.thickness)),
          "the thickness of a soft body must be 0, or at least 1e-9 m, not " + number_text(settings.thickness));
  return settings;
}

SoftBody begun(SoftSettings settings) {
  SoftBody body;
  body.alive = true;
  body.positions = settings.positions;
  body.velocities = settings.velocities;
  body.velocities.resize(body.positions.size(), Vec3(0, 0, 0));
  body.torn.assign(settings.edges.size(), 0);
  settings.pins.clear();
  body.pace = *settings.sub_step;
  body.made = std::make_shared<const SoftSettings>(std::move(settings));
  find_gone(body);
  return body;
}

}  // namespace tweenfall::soft
