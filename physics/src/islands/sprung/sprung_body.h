#pragma once

#include "forces/free_flight.h"
#include "step/keyed_step.h"

namespace tweenfall::sprung {

/// A body on springs: its momentum instead of its spin, and its principal axes instead of those of its node.
struct SprungBody {
  static constexpr std::uint32_t nobody = 0xffffffffu;
  std::uint32_t index = nobody;
  bool movable = false;
  bool spherical = false;
  bool led = false;
  double inverse_mass = 0;
  Vec3 moments{0, 0, 0}, inverse_moments{0, 0, 0};  ///< about the principal axes, kg m^2
  Quat axes{1, 0, 0, 0};                            ///< from principal axes to those of the node
  Vec3 center{0, 0, 0}, linear{0, 0, 0};
  Quat rotation{1, 0, 0, 0};  ///< from principal axes to the world
  Vec3 momentum{0, 0, 0};     ///< angular, N m s
  Vec3 angular{0, 0, 0};      ///< of a led one, rad/s
  Vec3 acceleration{0, 0, 0}, torque{0, 0, 0};
  double drag = 0, angular_drag = 0, angular_damping = 0;
  step::KeyedCourse course;
  double stiffness = 0;  ///< bound of the squared frequency that its springs give it, 1/s^2

  [[nodiscard]] static SprungBody of(const state::Body& body, std::uint32_t index, double dt);
  [[nodiscard]] Vec3 spin() const;  ///< rad/s, world axes
  [[nodiscard]] Vec3 turned_by(const Vec3& angular_impulse) const;
  [[nodiscard]] Vec3 velocity_at(const Vec3& arm) const { return linear + spin().cross(arm); }
  void push(const Vec3& impulse, const Vec3& arm);
  /// What the loads give it in the time h.
  void load(double h);
  /// Flies freely for the time h.
  void fly(double h);
  /// The state of the body at the end.
  void put_back(state::Body& body) const;
};

}  // namespace tweenfall::sprung
