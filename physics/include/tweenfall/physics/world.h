#pragma once

/// The world: rigid bodies, forces, contacts, and one step after another.
///
/// The world knows drives and targets, never clips or curves: whoever owns the animation tells
/// a keyed body where it must be at the end of the step and with which twist, and the world
/// takes it there exactly, pushing aside whatever stands in the way.

#include <tweenfall/physics/contact.h>
#include <tweenfall/physics/drive.h>
#include <tweenfall/physics/executor.h>
#include <tweenfall/physics/force.h>
#include <tweenfall/physics/joint.h>
#include <tweenfall/physics/shape.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall {

namespace queries {
class Inside;
}
namespace soft {
class Inside;
}

// `strategies.h` declares their values; {} is the default of each.
enum class ContactSolver : std::uint8_t;
enum class Parting : std::uint8_t;
enum class Detection : std::uint8_t;
enum class PairSearch : std::uint8_t;

/// How the state of a free body advances through a step in which nothing touches it. All but the first two evaluate
/// forces and torques (gravity, drag, springs, fields, damping) at states of their own choosing. Of these, all but the
/// last two are explicit: a damping or a swing too fast for their steps grows until `step` throws NotFinite. The last
/// two are implicit: by Newton's method they take forces of any stiffness as they will be at the end of the step.
/// Contacts and joints work with the mean force that the integrator finds.
enum class Integrator {
  exact_quadratic,      ///< x += v h + a h^2/2: exact under constant force (the default); drag is of first order
  semi_implicit_euler,  ///< v += a h, then x += v h; first order
  explicit_euler,       ///< forces at the start of the step; first order
  midpoint,             ///< forces halfway through the step; second order
  trapezoid,            ///< mean of the forces at both ends, Heun's method; second order
  rk4,                  ///< the classic Runge-Kutta method; fourth order
  verlet,               ///< velocity Verlet: positions from the speed halfway; second order, a swing keeps its energy
  backward_euler,       ///< forces at the end of the step; first order, and a swing dies away
  implicit_trapezoid,   ///< mean of the forces at the start and at the end; second order, a swing keeps its energy
};

/// A plane through the world's origin in which all bodies lie and turn.
enum class WorldPlane : std::uint8_t { none, xy, xz, yz };

struct WorldSettings {
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
  Integrator integrator = Integrator::exact_quadratic;
  int iterations = 20;          ///< passes of the contact solver over all contacts of a step, 1 to 10,000
  double sleep_speed = 0.02;    ///< m/s (and rad/s times size) below which a body counts as still
  double sleep_after = 0.5;     ///< s of stillness after which a body sleeps; infinity: never
  double push_out_speed = 0.5;  ///< greatest speed at which overlapping bodies are pushed apart, m/s
  ContactSolver solver{};       ///< how the contacts of an island are solved
  Parting separation{};         ///< how overlapping bodies are pushed apart
  Detection collision{};        ///< when bodies are found to meet
  PairSearch broad_phase{};     ///< how pairs that may meet are found
  /// When set, bodies collide as their sections in this plane, by the solver of `planar_world.h`, and not one bit
  /// leaves the plane. Then `iterations`, `threads` and the parts of forces that point out of the plane are ignored,
  /// the strategies above must be the defaults, there are no universal and no swing-twist joints, and no surface may
  /// move, spin or be made of faces.
  WorldPlane plane{};
  int threads = 0;  ///< threads that share a step, 0 to 256; 0 and 1: the calling thread alone. Never changes a bit
};

/// How the frictions, or restitutions, of two bodies are combined. When two bodies name different rules, the one that
/// is listed later here holds: any other rule beats `usual`, and `maximum` beats all.
/// Source of the order from `average` on: PhysX's PxCombineMode, where the greater value holds too.
enum class Combine : std::uint8_t {
  usual,           ///< frictions by their geometric mean, restitutions by the larger
  geometric_mean,  ///< sqrt(a b)
  average,         ///< (a + b) / 2
  minimum,
  multiply,  ///< a b
  maximum,
};

struct BodySettings {
  Shape shape = {};
  std::optional<double> mass{};                     ///< kg; absent: density times volume
  double density = 1000;                            ///< kg/m^3
  std::optional<MassProperties> mass_properties{};  ///< instead of those of an even solid; only without `mass`
  double friction = 0.5;   ///< Coulomb coefficient; a pair takes sqrt(f1 f2) unless told otherwise
  double restitution = 0;  ///< 0 to 1; a pair takes the larger unless told otherwise
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  double rolling_friction = 0;  ///< resistance to turning, as a length: torque <= length times normal force, m
  double spinning_friction =
      0;                        ///< in addition, only against turning about the normal; a pair takes the larger ones, m
  Twist surface_velocity = {};  ///< of the surface relative to the body, at its center of mass, node axes
  bool sensor = false;          ///< reports what overlaps it, but neither pushes nor is pushed
  /// When it is found to meet others, whatever the world says. Of two bodies that say different things, the more
  /// careful holds: time of impact before ahead, ahead before discrete. Absent: as the other body says, or else the
  /// world. See `strategies.h` for what else follows from it. Sensors take none, and in a plane there is none.
  std::optional<Detection> collision{};
  double linear_damping = 0;   ///< 1/s
  double angular_damping = 0;  ///< 1/s
  bool fixed = false;          ///< part of the scenery: never moves
  std::uint64_t groups = 1;    ///< the groups it belongs to, one bit each
  std::uint64_t collides_with =
      ~std::uint64_t{0};  ///< groups; two bodies meet when each collides with a group of the other
  Drive drive = Drive::free();
  Motion motion = {};  ///< of the node's origin, world axes
};

/// A touching pair after a step; for compounds, a touching pair of parts.
struct Contact {
  BodyId a, b;
  Manifold manifold;
  double impulse = 0;           ///< sum of normal impulses of the step, N s; >= 0
  Vec3 total_impulse{0, 0, 0};  ///< on b, friction included, N s
  double approach_speed = 0;    ///< normal speed at which the two met, before the step's impulses, m/s
  bool began = false;           ///< the pair, or these parts of it, did not touch in the step before
  std::uint32_t part_a = 0,
                part_b = 0;  ///< index of the touching part of a compound; of a mesh or field: of the contact place
};

/// Two bodies that touched before and no longer do, with any of their parts.
struct EndedContact {
  BodyId a, b;  ///< may have been removed
};

/// A body in a sensor. Sensors never report other sensors, and fixed sensors no fixed bodies; groups and ignored pairs
/// count as they do for contacts.
struct SensorOverlap {
  BodyId sensor, body;
  bool began = false;  ///< the body was not in the sensor at the end of the step before
};

/// Thrown when a body's position or velocity is no number or exceeds 1e30 m, m/s or rad/s, or a force is not finite.
class NotFinite : public std::runtime_error {
 public:
  NotFinite(BodyId body, double time, const std::string& cause);
  BodyId body;        ///< in the world that stepped; when a stage throws, in the stage's own world
  double time = 0;    ///< world time at the end of the step that went wrong, s
  std::string cause;  ///< the likely cause, in words that end a sentence

 protected:
  /// The same fault with another text.
  NotFinite(const NotFinite& fault, const std::string& text);
};

/// Bodies and what acts on them. After a world was moved from, its `noexcept` members answer as for an empty world, and
/// all others throw std::logic_error, until another world is assigned to it.
class World {
 public:
  explicit World(const WorldSettings& settings = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  World(const World&);  ///< a copy steps to the same bits as the original
  World& operator=(const World&);

  // Bodies
  BodyId add(const BodySettings& body);  ///< @throws std::invalid_argument naming what is wrong
  void remove(BodyId body);              ///< wakes what it touched. @throws std::invalid_argument for a stale handle
  [[nodiscard]] bool contains(BodyId body) const noexcept;
  [[nodiscard]] std::vector<BodyId> bodies() const;

  // State; every call throws std::invalid_argument for a stale handle
  [[nodiscard]] Motion motion(BodyId body) const;  ///< of the node's origin
  [[nodiscard]] Twist twist(BodyId body) const;    ///< at the center of mass, world axes
  /// Of needles, the least principal moment of inertia is raised to a ten-thousandth of the greatest: what is 1 m long
  /// and less than 8 mm thick would spin too easily for any step.
  [[nodiscard]] const MassProperties& mass(BodyId body) const;
  [[nodiscard]] const Shape& shape(BodyId body) const;
  [[nodiscard]] Owner owner(BodyId body) const;
  [[nodiscard]] Drive drive(BodyId body) const;
  [[nodiscard]] bool is_fixed(BodyId body) const;
  [[nodiscard]] bool is_sensor(BodyId body) const;
  [[nodiscard]] double still_for(BodyId body) const;  ///< s of stillness so far
  [[nodiscard]] bool asleep(BodyId body) const;
  /// Whether, in the last step, the drive of a driven body needed more than its greatest force or torque.
  [[nodiscard]] bool saturated(BodyId body) const;
  /// Whether, in the last step, keyed bodies squeezed it out between them, or between themselves and fixed ones, more
  /// than three times as fast as they move. Then it got at most ten times as fast, unless something brought more
  /// energy.
  [[nodiscard]] bool squeezed(BodyId body) const;
  [[nodiscard]] Vec3 reaction(
      BodyId body) const;  ///< sum of contact impulses on a keyed or fixed body since it was added, N s
  [[nodiscard]] double kinetic_energy() const;  ///< of all free bodies, J
  [[nodiscard]] double time() const noexcept;   ///< sum of the steps, s

  // Changes; each wakes the body. All throw std::invalid_argument for a stale handle, for numbers that are not finite
  // or beyond 1e30, and for a quaternion that cannot be normalized; and std::logic_error when a field calls them.
  /// Moves the body: pose and velocity of the node's origin. Contacts use this velocity, not the speed of the jump.
  void set_motion(BodyId body, const Motion& motion);
  /// Hands the body over to another drive. A body that leaves `keyed` keeps the pose and twist of its last target;
  /// accumulated impulses are cleared.
  void set_drive(BodyId body, const Drive& drive);
  /// Where a keyed body must be at the end of the next step, and the velocity of its path there.
  void set_target(BodyId body, const Motion& end_of_step);
  void apply_force(BodyId body, const Vec3& force, const Vec3& point);  ///< N, at a world point, during the next step
  void apply_torque(BodyId body, const Vec3& torque);                   ///< N m, during the next step
  void apply_impulse(BodyId body, const Vec3& impulse, const Vec3& point);  ///< N s, at once
  void wake(BodyId body);

  /// How the body's surface moves relative to the body, at its center of mass in the axes of its node: friction carries
  /// along what lies on it. Wakes what touches it.
  void set_surface_velocity(BodyId body, const Twist& velocity);
  [[nodiscard]] Twist surface_velocity(BodyId body) const;

  // Which bodies meet. A change wakes the bodies concerned, at once and with no impulse; if they overlap and now meet,
  // they are pushed apart as any overlapping bodies are. All throw std::invalid_argument for a stale handle.
  void set_groups(BodyId body, std::uint64_t groups, std::uint64_t collides_with);
  [[nodiscard]] std::uint64_t groups(BodyId body) const;
  [[nodiscard]] std::uint64_t collides_with(BodyId body) const;
  void ignore(BodyId a, BodyId b);   ///< they pass through each other. @throws std::invalid_argument for the same body
  void collide(BodyId a, BodyId b);  ///< undoes `ignore`
  /// Whether two bodies may meet: neither is a sensor, and no groups, joint or call of `ignore` keep them apart.
  [[nodiscard]] bool collides(BodyId a, BodyId b) const;

  // Joints; all throw std::invalid_argument for a stale handle. Removing a body removes its joints
  JointId add_joint(
      const JointSettings& joint);   ///< wakes both ends. @throws std::invalid_argument naming what is wrong
  void remove_joint(JointId joint);  ///< wakes both ends
  [[nodiscard]] bool contains(JointId joint) const noexcept;
  [[nodiscard]] std::vector<JointId> joints() const;
  [[nodiscard]] const JointSettings& joint(JointId joint) const;
  /// Gives a joint other limits, motors and so on, of the same kind of joint; wakes both ends.
  void set_joint(JointId joint, const JointKind& kind);
  [[nodiscard]] JointReading reading(JointId joint) const;
  /// Joints that broke in the last step, in order; they no longer exist.
  [[nodiscard]] std::span<const JointId> broken_joints() const noexcept;

  // Forces
  /// @returns a number that identifies the force in the calls below
  /// @throws std::invalid_argument naming what is wrong
  std::size_t add_force(Force force, ForceSettings settings = {});
  // All throw std::invalid_argument for a number that identifies no force
  void remove_force(std::size_t number);
  void set_strength(std::size_t force, const Strength& strength);
  /// Potential energy of the free bodies in one force, at its present strength, J: for springs, attractors, potentials,
  /// steady pushes, and for buoyancy where gravity is perpendicular to the surface. Empty for all other forces.
  [[nodiscard]] std::optional<double> potential_energy(std::size_t force) const;
  /// The sum over the forces that have one, plus that of gravity, which is 0 at the origin, J.
  [[nodiscard]] double potential_energy() const;

  // Time
  /// Advances by `dt` seconds. The result of n steps depends on their lengths alone, bit for bit.
  /// @throws std::invalid_argument when dt is not positive and finite
  /// @throws NotFinite when a body stops being finite: `step` throws again until it is removed or moved by
  /// `set_motion`. When a spring or a field is the cause, nothing has moved yet.
  /// @throws what a field throws; nothing has moved then
  void step(double dt);
  /// The same for a part of a step that is `whole` seconds long: contacts are as soft as in the whole step, so that
  /// resting bodies stay where they are however a step is split. @throws std::invalid_argument unless `whole` is finite
  void step(double dt, double whole);
  /// Sets who does the parts of a step, in place of the threads of the settings; null: the calling thread. Copies of
  /// the world share it, as they share the threads of the settings. Only the calling thread calls fields.
  void set_executor(std::shared_ptr<Executor> executor);

  /// Pairs that touched in the last step, in a fixed order.
  [[nodiscard]] std::span<const Contact> contacts() const noexcept;
  /// Pairs that touched before the last step and not in it, or that lost a body before it. A contact that is among
  /// `contacts` and did not begin has persisted.
  [[nodiscard]] std::span<const EndedContact> ended_contacts() const noexcept;
  /// Bodies in sensors at the end of the last step, awake or asleep, by index of the sensor and then of the body.
  [[nodiscard]] std::span<const SensorOverlap> sensor_overlaps() const noexcept;
  /// Bodies that were in sensors one step earlier and were not any more, or were removed.
  [[nodiscard]] std::span<const SensorOverlap> ended_sensor_overlaps() const noexcept;

  // Saving
  /// A number that changes when any bit of the world changes that affects its next steps.
  [[nodiscard]] std::uint64_t state_hash() const noexcept;
  /// The world as bytes, from which `load` restores it, with the same handles: it then steps to the same bits.
  /// @throws std::invalid_argument when the world has a `Field`, since a function cannot be saved: remove it with
  /// `remove_force` and add it again after loading; or when a body is not finite
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Becomes the world that was saved.
  /// @throws std::invalid_argument saying what is wrong with the bytes; nothing has changed then
  void load(std::span<const std::byte> saved);

 private:
  friend class queries::Inside;
  friend class soft::Inside;
  struct Implementation;
  [[nodiscard]] const Implementation& inside() const;  ///< @throws std::logic_error when moved from
  [[nodiscard]] Implementation& changing();            ///< @throws std::logic_error when moved from or in a step

  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tweenfall
