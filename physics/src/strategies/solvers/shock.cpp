#include <algorithm>
#include <utility>

#include "strategies/solvers/solvers.h"

namespace tweenfall::strategies {

namespace {

constexpr int not_reached = -1;

/// How many touches each party is above an immovable one; what hangs free is in the first layer.
std::vector<int> layers_of(const Gathering& island) {
  std::vector<int> layers(island.parties.size(), not_reached);
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (!island.parties[i].movable) layers[i] = 0;
  for (int layer = 0; std::find(layers.begin(), layers.end(), layer) != layers.end(); ++layer)
    for (const Touch& touch : island.touches)
      for (const auto& [from, to] : {std::pair(touch.a, touch.b), std::pair(touch.b, touch.a)})
        if (layers[from] == layer && layers[to] == not_reached) layers[to] = layer + 1;
  for (int& layer : layers) layer = std::max(layer, 0);
  return layers;
}

}  // namespace

/// Passes over all collisions, and then a wave from the ground up: layer by layer, with everything below as firm as the
/// ground. So a stack stands after one wave, however tall; the ground bears only the weight of the lowest layer, and
/// momentum is not kept.
/// Source: Guendelman, Bridson and Fedkiw, Nonconvex Rigid Bodies with Stacking, SIGGRAPH 2003, section 8.
void shock(Gathering& island) {
  iterative(island);
  const std::vector<int> layers = layers_of(island);
  const auto layer_of = [&](const Touch& touch) { return std::max(layers[touch.a], layers[touch.b]); };
  const int highest = layers.empty() ? 0 : *std::max_element(layers.begin(), layers.end());
  for (int layer = 1; layer <= highest; ++layer) {
    // A wave changes nothing below it.
    std::vector<std::pair<std::size_t, Party>> below;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      Party& party = island.parties[i];
      if (layers[i] >= layer || !party.movable) continue;
      below.emplace_back(i, party);
      party.inverse_mass = 0;
      party.inverse_inertia = Mat3::Zero();
    }
    for (int pass = 0; pass < island.passes; ++pass)
      for (Touch& touch : island.touches) {
        if (layer_of(touch) != layer) continue;
        island.press(touch);
        island.rub(touch);
      }
    for (const auto& [place, party] : below) {
      island.parties[place].inverse_mass = party.inverse_mass;
      island.parties[place].inverse_inertia = party.inverse_inertia;
    }
  }
}

}  // namespace tweenfall::strategies
