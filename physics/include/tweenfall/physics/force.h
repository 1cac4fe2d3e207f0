#pragma once

/// Forces that act on bodies between contacts: drag, springs, and the caller's own.

#include <tweenfall/curves/pose.h>

#include <cstdint>
#include <functional>
#include <variant>

namespace tweenfall {

struct BodyId {
  std::uint32_t index = 0xffffffffu;
  std::uint32_t generation = 0;  ///< so that the handle of a removed body is not mistaken for its successor
  bool operator==(const BodyId&) const = default;
};

/// Resistance of a medium on every body: -linear v - quadratic |v| v, and -angular w for the spin.
struct Drag {
  double linear = 0;     ///< kg/s
  double quadratic = 0;  ///< kg/m
  double angular = 0;    ///< kg m^2/s
};

/// A damped spring between a point of a body and a point of another, or of the world. Of any stiffness: one that would
/// swing by about a radian or more within a step is taken implicitly, which is stable and damps it.
struct Spring {
  BodyId a;                ///< pulled
  BodyId b = {};           ///< pulled the other way; the default handle means the world
  Vec3 anchor_a{0, 0, 0};  ///< on a's node, m
  Vec3 anchor_b{0, 0, 0};  ///< on b's node, or in the world, m
  double rest_length = 0;  ///< m
  double stiffness = 0;    ///< N/m
  double damping = 0;      ///< N s/m, along the spring
};

/// A force field: force in N on a body, from its mass and the motion of its center of mass. A world with a field keeps
/// its bodies awake, for a field may change. It may read the world that it acts in and throw, but not change it: calls
/// that would change it throw std::logic_error, and it must not be destroyed or assigned to.
using Field = std::function<Vec3(double mass, const Vec3& position, const Vec3& velocity, double time)>;

using Force = std::variant<Drag, Spring, Field>;

}  // namespace tweenfall
