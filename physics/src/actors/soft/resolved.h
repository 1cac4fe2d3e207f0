#pragma once

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

// Passes over constraints, one after the other, resolve what the inertia of the nodes withstands in a sub-step. What
// is stiffer or damped harder keeps a stretch that pulls no harder for it, but that its stiffness would count as
// energy: 348 J of a cloth that weighs 2 N, 200 kJ of a bar of rubber. So edges, bends and volumes that are passed over
// act with at most this stiffness. Damping takes only energy, however hard it is; beside tetrahedra it is limited, too:
// they answer what it changes.

struct Resolved {
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
};

/// Whether the edges are passed over: those of chains, and all of springs, are solved at once.
[[nodiscard]] bool passes_over_edges(const SoftBody& body);
/// The stiffness with which an edge that is passed over acts in sub-steps of h seconds, N/m.
[[nodiscard]] double resolved_stiffness(const SoftSettings& made, const SoftEdge& edge, double h);
[[nodiscard]] Resolved resolved(const SoftBody& body, const SoftEdge& edge);
[[nodiscard]] double resolved_stiffness(const SoftBody& body, const SoftBend& bend);
/// Of volumes: divided by that at rest, Pa/m^3.
[[nodiscard]] double resolved_stiffness(const SoftSettings& made, const SoftTetrahedron& solid, double h);
[[nodiscard]] double resolved_stiffness(const SoftSettings& made, const SoftEnclosure& enclosure, double h);

/// Passes that suffice for all edges, bends and volumes, if four do.
[[nodiscard]] int enough_iterations(const SoftSettings& made);

}  // namespace tweenfall::soft
