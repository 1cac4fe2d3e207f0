#pragma once

/// Joints between bodies in a plane.

#include <tweenfall/curves/values.h>
#include <tweenfall/physics/force.h>
#include <tweenfall/physics/joint.h>

#include <optional>
#include <variant>

namespace tweenfall::planar {

// Limits and motors are those of joints in space: hard stops or springs, a speed or a spring toward a position.

/// Two points stay together; the bodies turn about them. Coordinate: b's angle relative to a's.
struct Hinge {
  std::optional<Limits> limits{};  ///< rad
  std::optional<Motor> motor{};
};

/// b's point slides along a line through a's that is fixed to a, and b does not turn relative to a. Coordinate: the
/// position along the line.
struct Slider {
  Vec2 axis{1, 0};                 ///< of the line, in the axes of a's node, or of the world; any length but 0
  double angle = 0;                ///< of b's node relative to a's, rad
  std::optional<Limits> limits{};  ///< m
  std::optional<Motor> motor{};
};

/// Nothing moves. No coordinate.
struct Weld {
  double angle = 0;  ///< of b's node relative to a's, rad
};

/// The distance of two points stays within limits: a rod, or a rope if the limits differ. Coordinate: the distance.
struct Distance {
  Limits limits{1, 1};  ///< m
};

/// A damped spring between two points, of any stiffness: within each sub-step it is evaluated as it will be at the
/// end, which slightly damps fast swings. Coordinate: the distance.
struct Spring {
  double length = 0;     ///< at rest, m
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
};

/// A rope from a over two pulleys to b: length at a plus ratio times length at b does not exceed `length`.
/// Coordinate: that sum.
struct Pulley {
  Vec2 pulley_a{0, 0}, pulley_b{0, 0};  ///< in the world, m
  double ratio = 1;                     ///< > 0
  std::optional<double> length{};       ///< m; absent: as it is when added
};

/// Two wheels, each on a hinge of its own: b turns by minus `ratio` times the angle a turns. Coordinate: the angle b
/// has turned during steps.
struct Gear {
  double ratio = 1;  ///< teeth of a's wheel divided by those of b's; negative for wheels that turn the same way; not 0
  double turned_a = 0, turned_b = 0;  ///< angles the wheels have turned when the joint is added, rad
};

/// A wheel b on a's suspension: b's point slides along a line through a's that is fixed to a, pulled to a's point by a
/// spring, and b turns freely. Coordinates: b's angle relative to a's, and its position along the line.
struct Wheel {
  Vec2 axis{0, 1};                     ///< of the line, in the axes of a's node, or of the world; any length but 0
  double hz = 2, zeta = 0.7;           ///< of the spring
  std::optional<Limits> suspension{};  ///< of the position, m
  std::optional<Motor> motor{};        ///< of the angle
};

using JointKind = std::variant<Hinge, Distance, Slider, Weld, Spring, Pulley, Gear, Wheel>;

struct JointSettings {
  BodyId a = {};        ///< the default handle means the world
  BodyId b = {};        ///< likewise; not both
  Vec2 anchor_a{0, 0};  ///< on a's node, or in the world, m
  Vec2 anchor_b{0, 0};  ///< on b's node, or in the world, m
  JointKind kind = Hinge{};
  bool collide = false;  ///< whether the two bodies also touch each other
};

}  // namespace tweenfall::planar
