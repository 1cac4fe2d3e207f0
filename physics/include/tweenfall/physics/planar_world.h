#pragma once

/// The world in a plane: bodies that slide and turn in it, contacts, joints, and one step after another.
///
/// It is used like `World`, with vectors of two numbers and an angle in place of a rotation, and has a solver of its
/// own, made for two dimensions: much faster than a three-dimensional world whose bodies stay in a plane.

#include <tweenfall/physics/planar_joint.h>
#include <tweenfall/physics/planar_shape.h>
#include <tweenfall/physics/world.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tweenfall::planar {

/// A position and an angle, and their rates.
struct Motion {
  Vec2 position{0, 0};  ///< m
  double angle = 0;     ///< rad, counterclockwise, any number of turns
  Vec2 velocity{0, 0};  ///< of the position, m/s
  double spin = 0;      ///< rate of the angle, rad/s
};

struct WorldSettings {
  Vec2 gravity{0, -9.81};  ///< m/s^2
  /// Sub-steps per step for contacts and joints, 1 to 64; absent: 4, and up to 24 where bodies are piled up, or up to
  /// 10 if there are more than 128 contacts.
  std::optional<int> sub_steps{};
  double sleep_speed = 0.02;    ///< m/s (and rad/s times size) below which a body counts as still
  double sleep_after = 0.5;     ///< s of stillness after which a body sleeps; infinity: never
  double push_out_speed = 0.5;  ///< greatest speed at which overlapping bodies are pushed apart, m/s
};

/// As `tweenfall::BodySettings`, in a plane.
struct BodySettings {
  Shape shape = {};
  std::optional<double> mass{};    ///< kg; absent: density times area
  std::optional<double> moment{};  ///< of inertia about the center of mass, kg m^2; absent: a uniform plate's
  std::optional<Vec2> center{};    ///< of mass, on the node, m; absent: a uniform plate's
  double density = 1000;           ///< kg/m^2
  double friction = 0.5;           ///< Coulomb coefficient; a pair takes sqrt(f1 f2) unless told otherwise
  double restitution = 0;          ///< 0 to 1; a pair takes the larger unless told otherwise
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  /// Resistance to rolling, as a length: the torque against the relative spin of a pair is at most this times the force
  /// that presses the two together, m; a pair takes the larger. A wheel of radius r with moment k m r^2
  /// loses c g / (r (1 + k)) of its speed in a second,
  /// and stays on a slope of at most c / r.
  double rolling_friction = 0;
  bool sensor = false;         ///< reports what overlaps it, but neither pushes nor is pushed
  double linear_damping = 0;   ///< 1/s: the share of a velocity that remains after t seconds is exp(-damping t)
  double angular_damping = 0;  ///< 1/s
  bool fixed = false;          ///< part of the scenery: never moves
  std::uint64_t groups = 1;    ///< the groups it belongs to, one bit each
  std::uint64_t collides_with =
      ~std::uint64_t{0};  ///< groups; two bodies meet when each collides with a group of the other
  Drive drive = Drive::free();
  Motion motion = {};  ///< of the node's origin
};

/// A touching pair after a step.
struct Contact {
  BodyId a, b;
  Manifold manifold;
  double impulse = 0;                    ///< sum of normal impulses of the step, N s; >= 0
  Vec2 total_impulse{0, 0};              ///< on b, friction included, N s
  double approach_speed = 0;             ///< normal speed at which the two met, before the step's impulses, m/s
  bool began = false;                    ///< the pair, or these parts of it, did not touch in the step before
  std::uint32_t part_a = 0, part_b = 0;  ///< for compounds: which parts touch
};

/// The state of a joint after a step.
struct JointReading {
  double value = 0;            ///< of its coordinate, rad or m; 0 for a weld, which has none
  double rate = 0;             ///< per second
  Vec2 impulse{0, 0};          ///< on b at its anchor, in the last step, N s
  double angular_impulse = 0;  ///< on b about its anchor, N m s
  double gap = 0;              ///< distance between the two points that the joint should hold together, m
  double turned_a = 0;         ///< for a gear: the angle by which a has turned, rad
  double way = 0;              ///< for a wheel: position along its line, m
  double way_rate = 0;         ///< m/s
};

/// Bodies in a plane and what acts on them. A copy steps to the same bits as the original. Every call that takes a
/// handle throws std::invalid_argument for a stale one, and every call that takes numbers for those that are not finite
/// or exceed 1e30. After a world was moved from, its `noexcept` members answer as for an
/// empty world, and all others throw std::logic_error, until another world is assigned to it.
class World {
 public:
  explicit World(const WorldSettings& settings = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  World(const World&);
  World& operator=(const World&);

  // Bodies
  BodyId add(const BodySettings& body);  ///< @throws std::invalid_argument naming what is wrong
  void remove(BodyId body);              ///< with its joints; wakes what it touched
  [[nodiscard]] bool contains(BodyId body) const noexcept;
  [[nodiscard]] std::vector<BodyId> bodies() const;

  // State
  [[nodiscard]] Motion motion(BodyId body) const;         ///< of the node's origin
  [[nodiscard]] Vec2 center_velocity(BodyId body) const;  ///< of the center of mass, m/s
  [[nodiscard]] const MassProperties& mass(BodyId body) const;
  [[nodiscard]] const Shape& shape(BodyId body) const;
  [[nodiscard]] Owner owner(BodyId body) const;
  [[nodiscard]] Drive drive(BodyId body) const;
  [[nodiscard]] bool is_fixed(BodyId body) const;
  [[nodiscard]] bool is_sensor(BodyId body) const;
  [[nodiscard]] double still_for(BodyId body) const;  ///< s of stillness so far
  [[nodiscard]] bool asleep(BodyId body) const;
  [[nodiscard]] bool saturated(BodyId body) const;  ///< its drive pulled with its greatest force in the last step
  [[nodiscard]] Vec2 reaction(
      BodyId body) const;  ///< sum of contact impulses on a keyed or fixed body since it was added, N s
  [[nodiscard]] double kinetic_energy() const;   ///< of all free and driven bodies, J
  [[nodiscard]] double time() const noexcept;    ///< sum of the steps, s
  [[nodiscard]] int sub_steps() const noexcept;  ///< into which the last step was divided; 0 before the first

  // Changes; each wakes the body, except forces that stay the same
  void set_motion(BodyId body, const Motion& motion);
  /// Hands the body over to another drive. Leaving `keyed`, it keeps the position and velocity of its last target.
  void set_drive(BodyId body, const Drive& drive);
  /// Where a keyed body must be at the end of the next step, and the velocity of its path there: it then has exactly
  /// these numbers. For a driven body, where its spring pulls it.
  void set_target(BodyId body, const Motion& end_of_step);
  /// N, at a world point, during the next step. A force that is applied in every step and stays the same lets a resting
  /// body fall asleep, and sleep on: a sleeping body wakes when it begins a step with another force or torque than it
  /// fell asleep with.
  void apply_force(BodyId body, const Vec2& force, const Vec2& point);
  void apply_torque(BodyId body, double torque);                            ///< N m, during the next step
  void apply_impulse(BodyId body, const Vec2& impulse, const Vec2& point);  ///< N s, at once
  void wake(BodyId body);
  void set_groups(BodyId body, std::uint64_t groups, std::uint64_t collides_with);
  void ignore(BodyId a, BodyId b);   ///< they pass through each other. @throws std::invalid_argument for the same body
  void collide(BodyId a, BodyId b);  ///< undoes `ignore`

  // Joints
  JointId add_joint(const JointSettings& joint);  ///< @throws std::invalid_argument naming what is wrong
  void remove_joint(JointId joint);
  [[nodiscard]] bool contains(JointId joint) const noexcept;
  [[nodiscard]] const JointSettings& joint(JointId joint) const;
  [[nodiscard]] JointReading reading(JointId joint) const;

  // Time
  /// Advances by `dt` seconds. Bodies that nothing touches fly by x += v t + g t^2/2.
  /// @throws std::invalid_argument when dt is not positive and finite
  /// @throws NotFinite when a body stops being finite: `step` throws again until it is removed or moved by
  /// `set_motion`.
  void step(double dt);
  /// The same for a part of a step that is `whole` seconds long: contacts and joints are as soft, and are remembered,
  /// as in the whole step, so that resting bodies stay where they are however a step is split. @throws
  /// std::invalid_argument unless `whole` is finite
  void step(double dt, double whole);

  /// Pairs that touched in the last step, by the indices of their bodies and of their parts.
  [[nodiscard]] std::span<const Contact> contacts() const noexcept;
  /// Pairs that touched before the last step and not in it.
  [[nodiscard]] std::span<const EndedContact> ended_contacts() const noexcept;
  /// Bodies that were in sensors at the end of the last step, by index of the sensor and then of the body.
  [[nodiscard]] std::span<const SensorOverlap> sensor_overlaps() const noexcept;

  // Saving
  [[nodiscard]] std::uint64_t state_hash() const;  ///< changes when any bit changes that affects its next steps
  /// The world as bytes, from which `load` restores it, with the same handles: it then steps to the same bits.
  [[nodiscard]] std::vector<std::byte> save() const;
  /// @throws std::invalid_argument saying what is wrong with the bytes; nothing has changed then
  void load(std::span<const std::byte> saved);

 private:
  friend struct Questions;  // of planar_query.h
  struct Implementation;
  [[nodiscard]] Implementation& inside();              ///< @throws std::logic_error when moved from
  [[nodiscard]] const Implementation& inside() const;  ///< the same

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tweenfall::planar
