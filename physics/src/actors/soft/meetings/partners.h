#pragma once

#include <optional>
#include <vector>

#include "forces/free_flight.h"
#include "state/body.h"

namespace tweenfall::soft {

/// The pose of a rigid body, and its twist at its center of mass.
struct Place {
  Vec3 center{0, 0, 0};
  Quat rotation{1, 0, 0, 0};
  Twist twist;
};

/// A rigid body that soft ones touch or hold on to in a step that it has already been through: along its course, and
/// off it by what they give it.
struct Partner {
  std::uint32_t body = 0;
  // Including resistance through the step, which acts as if the body had more of both
  double mass = 0, inverse_mass = 0;                            ///< kg; inverse 0 for an immovable body
  Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();  ///< world axes
  Place start, end;                                             ///< of the step
  bool along_parabola = false;  ///< its velocities belong to its displacement: no blow has changed them
  // Off its course so far
  Vec3 shift{0, 0, 0}, turn{0, 0, 0};  ///< m, rad
  Vec3 push{0, 0, 0}, spin{0, 0, 0};   ///< m/s, rad/s
  // In the present sub-step
  Place before, now;                     ///< at its start, and at its end if nothing more is given
  Vec3 moved{0, 0, 0}, turned{0, 0, 0};  ///< by what has been given in it, m and rad
  Vec3 taken{0, 0, 0};                   ///< impulse of the whole step, N s
  int givers = 0;                        ///< soft bodies that give it something in the sub-step

  [[nodiscard]] bool moves() const { return inverse_mass > 0; }
  /// A point of the body at the end of the sub-step, as far as it is known. @param arm  from its center, then
  [[nodiscard]] Vec3 point(const Vec3& arm) const { return now.center + arm + moved + turned.cross(arm); }
  /// How far a push of 1 kg m along a unit direction moves that point, 1/kg.
  [[nodiscard]] double give_along(const Vec3& direction, const Vec3& arm) const {
    const Vec3 lever = arm.cross(direction);
    return inverse_mass + lever.dot(inverse_inertia * lever);
  }
  /// Moves the body by a push, kg m: an impulse times the length of the sub-step h.
  void give(const Vec3& pushed, const Vec3& arm, double h) {
    moved += inverse_mass * pushed;
    turned += inverse_inertia * arm.cross(pushed);
    taken += pushed / h;
  }
};

/// What one soft body gives a partner in a sub-step.
struct Gift {
  Vec3 moved{0, 0, 0}, turned{0, 0, 0}, taken{0, 0, 0};
};

/// All bodies that soft ones meet in a step.
class Partners {
 public:
  /// Begins a step.
  /// @param starts  by body, as they were before the step
  /// @param loads      of the step, by body
  /// @param sub_steps  of a world in a plane
  void begin(std::vector<state::Body>& bodies, const std::vector<Place>& starts, const std::vector<forces::Load>& loads,
             const WorldSettings& settings, int sub_steps, double dt);

  [[nodiscard]] std::uint32_t number_of(std::uint32_t body);
  [[nodiscard]] Partner& operator[](std::uint32_t number) { return all_[number]; }
  [[nodiscard]] const Partner& operator[](std::uint32_t number) const { return all_[number]; }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const state::Body& body(std::uint32_t index) const { return (*bodies_)[index]; }
  [[nodiscard]] const Place& start(std::uint32_t index) const { return (*starts_)[index]; }

  /// Advances to a time since the start of the step, by a sub-step of length h.
  void go_to(double time, double h);
  /// What each has been given so far in the sub-step, by index. `take_back` subtracts what one soft body has given.
  void tell_given(std::vector<Gift>& gifts) const;
  void take_back(const std::vector<Gift>& gifts);
  /// Applies what the bodies were given in the sub-step.
  void accept(double h);
  /// Writes the results to the bodies, and wakes them.
  void finish();

 private:
  std::vector<state::Body>* bodies_ = nullptr;
  const std::vector<Place>* starts_ = nullptr;
  const std::vector<forces::Load>* loads_ = nullptr;
  WorldPlane plane_{};
  Integrator integrator_{};
  int sub_steps_ = 1;
  double dt_ = 0;
  std::vector<Partner> all_;
  std::vector<std::uint32_t> numbers_;  ///< by body, plus 1
};

}  // namespace tweenfall::soft
