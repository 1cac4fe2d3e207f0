#pragma once

#include <tweenfall/physics/planar_world.h>

#include <array>
#include <cstdint>
#include <vector>

#include "planar/contacts/plate.h"
#include "planar/turning.h"

namespace tweenfall::planar::inner {

/// The part of a body that steps use again and again.
struct Body {
  Vec2 center{0, 0};  ///< of mass, world, m
  double angle = 0;
  Turn turn;
  Vec2 velocity{0, 0};  ///< of the center of mass
  double spin = 0;
  double inverse_mass = 0, inverse_moment = 0;  ///< 0 if nothing moves it
  double reach = 0;                             ///< farthest point from the center of mass, m; 0 for a half-plane
  double skin = 0;                              ///< m; for a compound that of its first part
  double least = 0;                             ///< about how thin it is, m
  double travel = 0;  ///< how far a point of it may get in the step, if nothing else moves it, m
  Vec2 force{0, 0};   ///< for the next step
  double torque = 0;
  Vec2 borne{0, 0};  ///< the force with which it fell asleep, N
  double borne_torque = 0;
  double still_for = 0;
  // Its enlarged box in the tree, for where it was then.
  Vec2 boxed_center{0, 0};
  double boxed_angle = 0, boxed_room = 0;
  bool boxed = false;
  bool has_target = false;
  bool alive = false, asleep = false;
  bool movable = false;   ///< neither fixed nor keyed
  bool lone = false;      ///< a circle
  bool compound = false;  ///< of several plates
  bool driven = false;
  bool damped = false;
  bool under_way = false;  ///< in this step: awake and movable, or keyed and moving

  [[nodiscard]] Vec2 velocity_at(const Vec2& arm) const { return velocity + spin * quarter(arm); }
};

/// The rest of a body.
struct Makeup {
  std::uint32_t generation = 0;
  Shape shape;
  std::vector<Plate> plates;
  MassProperties mass;
  double friction = 0, restitution = 0, rolling_friction = 0;
  Combine friction_combine = Combine::usual, restitution_combine = Combine::usual;
  double linear_damping = 0, angular_damping = 0;
  bool fixed = false, sensor = false, saturated = false;
  std::uint64_t groups = 1, collides_with = 0;
  Drive drive = Drive::free();
  Motion motion;  ///< of the node's origin, for fixed and keyed bodies: exactly the numbers that were set
  Motion target;
  Vec2 reaction{0, 0};

  [[nodiscard]] bool endless() const { return !plates.empty() && plates[0].endless; }
};

/// Of a part.
[[nodiscard]] inline double skin_of(const Body& body, const Makeup& makeup, std::uint32_t part) {
  return body.compound ? makeup.plates[part].skin : body.skin;
}

/// Two bodies, or parts of them, whose boxes meet, and how they touch.
struct Meeting {
  std::uint32_t a = 0, b = 0;            ///< a < b
  std::uint32_t part_a = 0, part_b = 0;  ///< of compounds
  double friction = 0, restitution = 0, rolling_friction = 0;
  bool sensing = false;   ///< one is a sensor
  bool touching = false;  ///< in the last step
  int count = 0;          ///< points in contact or about to be
  bool exact = false;     ///< found where the bodies are, not where they are going to meet
  double clear = 0;       ///< without points: how far apart they were then, at least, m
  // Found when b was at this pose relative to a:
  Vec2 apart{0, 0};  ///< in a's axes
  Turn relative;
  Vec2 normal{0, 1};                                                                   ///< in a's axes
  std::array<Vec2, 2> core_a{Vec2(0, 0), Vec2(0, 0)}, core_b{Vec2(0, 0), Vec2(0, 0)};  ///< in a's axes, and in b's
  std::array<std::uint32_t, 2> feature{};
  std::array<double, 2> pressing{}, dragging{};  ///< impulses of the last sub-step, N s
  double rolling = 0;                            ///< the rolling torque on b, likewise, N m s
};

struct Joint {
  static constexpr std::size_t most_held = 3;

  bool alive = false;
  std::uint32_t generation = 0;
  JointSettings settings;
  // Impulses of the last sub-step: of the rows that hold, in order, and of those that drive or bound the coordinate
  std::array<double, most_held> held{};
  double motor = 0, lower = 0, upper = 0;
  double spring = 0;                  ///< of a wheel's suspension
  double turned_a = 0, turned_b = 0;  ///< of a gear: the angles by which its wheels have turned, rad
  // Of the last step in which an end moved, on b
  Vec2 total{0, 0};
  double total_turn = 0;  ///< about its point
};

}  // namespace tweenfall::planar::inner
