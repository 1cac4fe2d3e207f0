#pragma once

/// Joints between bodies in a plane.

#include <tweenfall/physics/force.h>
#include <tweenfall/physics/joint.h>

#include <tweenfall/curves/values.h>

#include <limits>
#include <variant>

namespace tweenfall::planar {

/// Two points stay together; the bodies turn about them.
struct Hinge {
  double lower = -std::numeric_limits<double>::infinity();  ///< of b's angle against a's, rad
  double upper = std::numeric_limits<double>::infinity();   ///< rad; >= lower
  double motor_speed = 0;                                   ///< of b against a, rad/s
  double motor_torque = 0;                                  ///< at most, N m; 0: no motor
};

/// Two points stay as far apart as they shall: a rod, or with room between `shortest` and `longest` a rope.
struct Distance {
  double shortest = 1;  ///< m; >= 0
  double longest = 1;   ///< m; >= shortest, > 0
};

using JointKind = std::variant<Hinge, Distance>;

struct JointSettings {
  BodyId a = {};        ///< the default handle means the world
  BodyId b = {};        ///< likewise; not both
  Vec2 anchor_a{0, 0};  ///< on a's node, or in the world, m
  Vec2 anchor_b{0, 0};  ///< on b's node, or in the world, m
  JointKind kind = Hinge{};
  bool collide = false;  ///< whether the two bodies also touch each other
};

}  // namespace tweenfall::planar
