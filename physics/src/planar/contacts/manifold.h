#pragma once

#include <array>
#include <cstdint>

#include "planar/contacts/plate.h"
#include "planar/turning.h"

namespace tweenfall::planar::inner {

struct Placed {
  const Plate* plate = nullptr;
  Vec2 center{0, 0};
  Turn turn;
};

/// A point of contact: where the two cores, without their skins, are nearest.
struct FoundPoint {
  Vec2 core_a{0, 0}, core_b{0, 0};  ///< from the centers, world axes, m
  double gap = 0;                   ///< between the skins, m
  std::uint32_t feature = 0;
};

struct Found {
  Vec2 normal{0, 1};  ///< unit, from a to b, world
  std::array<FoundPoint, 2> points{};
  int count = 0;
  double clear = 0;  ///< without points: how far apart the skins are at least, as far as that is known, m
};

/// Where two plates touch, or nearly: points with a gap up to `limit`. For separated plates, the nearest point is
/// always among them. Sources: Ericson, Real-Time Collision Detection, 2005, 5.2 (separating axes), 8.3 (clipping).
[[nodiscard]] Found find_manifold(const Placed& a, const Placed& b, double limit);

}  // namespace tweenfall::planar::inner
