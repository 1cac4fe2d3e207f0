#pragma once

#include <tweenfall/physics/soft_body.h>

#include <memory>
#include <vector>

namespace tweenfall::soft {

/// A pin as it is kept from step to step.
struct PinState {
  SoftPin pin;
  Vec3 target{0, 0, 0};    ///< of a pin to the world: where it must be at the end of the step, m
  Vec3 velocity{0, 0, 0};  ///< there, m/s
  Vec3 force{0, 0, 0};     ///< on what holds it, mean over the last step, N
};

/// The parts that torn edges took with them; follows from which edges are torn.
struct Gone {
  std::vector<char> bends, tetrahedra, enclosures, triangles;
};

/// Everything the world knows about one soft body. Plain values: a copy of it steps to the same bits.
struct SoftBody {
  bool alive = false;
  std::uint32_t generation = 0;
  std::shared_ptr<const SoftSettings> made;  ///< with rest lengths and rest volumes; never null while alive
  std::vector<Vec3> positions, velocities;
  std::vector<char> torn;      ///< by edge
  std::vector<PinState> pins;  ///< by node
  double pace = 0;             ///< length of the sub-steps of a whole step, s
  Gone gone;
  std::vector<SoftTear> tears;  ///< of the last step

  [[nodiscard]] const PinState* pin_of(std::uint32_t node) const;
  [[nodiscard]] PinState* pin_of(std::uint32_t node);
};

/// The settings with rest lengths and volumes filled in, apart from pins. @throws std::invalid_argument if impossible
[[nodiscard]] SoftSettings checked(const SoftSettings& settings);
/// The initial state of a soft body, without pins.
[[nodiscard]] SoftBody begun(SoftSettings checked);
/// Recomputes what the torn edges took with them.
void find_gone(SoftBody& body);
void tear(SoftBody& body, std::size_t edge);

[[nodiscard]] inline double volume_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a)) / 6;
}

/// The volume inside a surface, relative to its first corner, so that nothing is lost far from the origin.
[[nodiscard]] double enclosed_by(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 const std::vector<Vec3>& positions);

}  // namespace tweenfall::soft
