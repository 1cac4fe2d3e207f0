#pragma once

#include <tweenfall/physics/soft_body.h>

#include <memory>
#include <vector>

namespace tweenfall::soft {

/// A pin as it goes from step to step.
struct PinState {
  SoftPin pin;
  Vec3 target{0, 0, 0};    ///< of one to the world: where it shall be at the end of the step, m
  Vec3 velocity{0, 0, 0};  ///< there, m/s
  Vec3 force{0, 0, 0};     ///< on what holds it, mean of the last step, N
};

/// What the tears of a soft body have taken along; follows from which edges are torn.
struct Gone {
  std::vector<char> bends, tetrahedra, enclosures, triangles;
};

/// Everything the world knows about one soft body. Plain values: a copy of it steps to the same bits.
struct SoftBody {
  bool alive = false;
  std::uint32_t generation = 0;
  std::shared_ptr<const SoftSettings> made;  ///< with lengths and volumes at rest; never null while alive
  std::vector<Vec3> positions, velocities;
  std::vector<char> torn;      ///< by edge
  std::vector<PinState> pins;  ///< by node
  Gone gone;
  std::vector<SoftTear> tears;  ///< of the last step

  [[nodiscard]] const PinState* pin_of(std::uint32_t node) const;
  [[nodiscard]] PinState* pin_of(std::uint32_t node);
};

/// The settings with what is at rest filled in, apart from pins. @throws std::invalid_argument for what makes none
[[nodiscard]] SoftSettings checked(const SoftSettings& settings);
/// The state that a soft body begins with, without pins.
[[nodiscard]] SoftBody begun(SoftSettings checked);
/// Finds again what the torn edges have taken along.
void find_gone(SoftBody& body);
void tear(SoftBody& body, std::size_t edge);

[[nodiscard]] inline double volume_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).dot((c - a).cross(d - a)) / 6;
}

/// What a surface encloses, about its first corner: far from the origin nothing is lost.
[[nodiscard]] double enclosed_by(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 const std::vector<Vec3>& positions);

}  // namespace tweenfall::soft
