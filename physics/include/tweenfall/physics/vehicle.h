#pragma once

/// Wheels with suspension and tires that carry a body: a car that drives, brakes, slides and climbs.
///
/// A vehicle is not part of a world: before each step it looks where its wheels stand and applies their forces to the
/// chassis, and the opposite forces to the ground bodies. It is a plain value, to be copied or kept beside a world.

#include <tweenfall/physics/world.h>

#include <cstddef>
#include <vector>

namespace tweenfall {

struct WheelSettings {
  Vec3 mount{0, 0, 0};        ///< where the strut starts, on the chassis' node, m
  double radius = 0.3;        ///< m; > 0
  double rest_length = 0.3;   ///< of the strut, from mount to hub, unloaded, m; > 0
  double stiffness = 30'000;  ///< N/m; > 0
  double damping = 3'000;     ///< N s/m
  double moment = 1;          ///< of inertia about the axle, kg m^2; > 0
  double grip = 1;            ///< Coulomb coefficient along the wheel's heading
  double side_grip = 1;       ///< and across it
  double sharpness = 10;  ///< how quickly grip builds up with slip: half of it at a slip of tan(pi/6) / sharpness; > 0
};

struct VehicleSettings {
  BodyId chassis = {};
  Vec3 forward{1, 0, 0};      ///< on the chassis' node, unit
  Vec3 up{0, 1, 0};           ///< likewise, perpendicular to `forward`; struts point the other way
  Vec3 gravity{0, -9.81, 0};  ///< of the world: a wheel that stands still holds against it, m/s^2
  std::vector<WheelSettings> wheels;
};

/// What a driver does to a wheel.
struct WheelControl {
  double torque = 0;  ///< of the engine, forward, N m
  double brake = 0;   ///< greatest torque of the brake, N m; >= 0
  double steer = 0;   ///< turns the heading about `up`, counterclockwise from above, rad
};

struct WheelReading {
  bool touches = false;  ///< all but spin and angle are of the last `act` in which it touched
  double length = 0;     ///< of the strut, m
  double spin = 0;       ///< rad/s; positive when it rolls forward
  double angle = 0;      ///< the angle it has turned by, rad
  double load = 0;       ///< N
  double slip = 0;       ///< sliding speed of the contact over the ground, divided by the rolling speed
  Vec3 point{0, 0, 0};   ///< where it stands, world, m
  Vec3 force{0, 0, 0};   ///< on the chassis, load included, N
  double steer = 0;      ///< angle of the heading, as last set by `control`, rad
};

/// The pose of a wheel from its reading: at its hub, with its y along the axle to the left.
/// @param chassis  pose of the chassis' node, in the space in which the wheel's pose is wanted
[[nodiscard]] Pose wheel_pose(const VehicleSettings& settings, std::size_t wheel, const WheelReading& reading,
                              const Pose& chassis);

class Vehicle {
 public:
  /// @throws std::invalid_argument naming what is wrong
  explicit Vehicle(VehicleSettings settings);

  [[nodiscard]] const VehicleSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] std::size_t wheels() const noexcept { return readings_.size(); }
  /// Holds until the next call. @throws std::invalid_argument for a wheel that does not exist, or bad numbers
  void control(std::size_t wheel, const WheelControl& control);
  [[nodiscard]] const WheelReading& reading(std::size_t wheel) const { return readings_.at(wheel); }
  [[nodiscard]] const std::vector<WheelReading>& readings() const noexcept { return readings_; }
  /// Continues from earlier readings, such as those from when the world was saved.
  /// @throws std::invalid_argument unless there is one per wheel, or for numbers that are not finite
  void restore(std::vector<WheelReading> readings);

  /// Applies what the wheels do in the next step of `dt` seconds. A strut is a spring and a damper from the mount to
  /// the hub; a tire grips by P = load * sin(atan(sharpness * slip)), times its grips along and across by the ellipse,
  /// and never by more than what ends its slip within the step: so it can also stand still.
  /// Sources: Pacejka, Tire and Vehicle Dynamics, 2012, 3.2 (slip of the tread, friction circle) and 4.3 (the magic
  /// formula, here with C = 1, so that a locked wheel slides by Coulomb's law).
  /// @throws std::invalid_argument for a chassis that does not exist, or a dt that is not positive and finite
  /// @throws NotFinite when a wheel is pressed beyond 1e30 N
  void act(World& world, double dt);

 private:
  struct Stand;
  [[nodiscard]] Stand find_stand(const World& world, const Motion& chassis, std::size_t wheel) const;
  void press_at_end(const World& world, std::vector<Stand>& stands, double dt) const;
  [[nodiscard]] Vec3 grip(const Stand& stand, double share, double borne, std::size_t wheel, double dt);

  VehicleSettings settings_;
  std::vector<WheelControl> controls_;
  std::vector<WheelReading> readings_;
};

}  // namespace tweenfall
