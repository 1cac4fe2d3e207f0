#include <algorithm>

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

namespace {

template <class Nodes>
bool holds(const Nodes& nodes, std::uint32_t a, std::uint32_t b) {
  return std::ranges::find(nodes, a) != nodes.end() && std::ranges::find(nodes, b) != nodes.end();
}

bool weighs(const SoftBend& bend, std::uint32_t node) {
  for (std::size_t k = 0; k < 4; ++k)
    if (bend.nodes[k] == node && bend.weights[k] != 0) return true;
  return false;
}

/// Parts that lie on the edge between two nodes are removed with it.
void take_along(SoftBody& body, std::uint32_t a, std::uint32_t b) {
  const SoftSettings& made = *body.made;
  for (std::size_t i = 0; i < made.bends.size(); ++i)
    if (weighs(made.bends[i], a) && weighs(made.bends[i], b)) body.gone.bends[i] = 1;
  for (std::size_t i = 0; i < made.tetrahedra.size(); ++i)
    if (holds(made.tetrahedra[i].nodes, a, b)) body.gone.tetrahedra[i] = 1;
  for (std::size_t i = 0; i < made.triangles.size(); ++i)
    if (holds(made.triangles[i], a, b)) body.gone.triangles[i] = 1;
  for (std::size_t i = 0; i < made.enclosures.size(); ++i)
    for (const auto& triangle : made.enclosures[i].triangles)
      if (holds(triangle, a, b)) body.gone.enclosures[i] = 1;
}

}  // namespace

void find_gone(SoftBody& body) {
  const SoftSettings& made = *body.made;
  body.gone.bends.assign(made.bends.size(), 0);
  body.gone.tetrahedra.assign(made.tetrahedra.size(), 0);
  body.gone.enclosures.assign(made.enclosures.size(), 0);
  body.gone.triangles.assign(made.triangles.size(), 0);
  for (std::size_t i = 0; i < made.edges.size(); ++i)
    if (body.torn[i] != 0) take_along(body, made.edges[i].a, made.edges[i].b);
}

void tear(SoftBody& body, std::size_t edge) {
  body.torn[edge] = 1;
  take_along(body, body.made->edges[edge].a, body.made->edges[edge].b);
}

const PinState* SoftBody::pin_of(std::uint32_t node) const {
  const auto found = std::ranges::lower_bound(pins, node, {}, [](const PinState& state) { return state.pin.node; });
  return found != pins.end() && found->pin.node == node ? &*found : nullptr;
}
PinState* SoftBody::pin_of(std::uint32_t node) {
  return const_cast<PinState*>(const_cast<const SoftBody*>(this)->pin_of(node));
}

}  // namespace tweenfall::soft
