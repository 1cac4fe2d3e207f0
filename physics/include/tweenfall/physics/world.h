#pragma once

/// The world: rigid bodies, forces, contacts, and one step after another.
///
/// The world knows drives and targets, never clips or curves: whoever owns the animation tells
/// a keyed body where it must be at the end of the step and with which twist, and the world
/// takes it there exactly, pushing what stands in the way.

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

// Of these `strategies.h` tells the words; {} is the usual one.
enum class ContactSolver : std::uint8_t;
enum class Parting : std::uint8_t;
enum class Detection : std::uint8_t;
enum class PairSearch : std::uint8_t;

/// How a free body's state goes through a step in which nothing touches it. All but the first two ask for forces and
/// torques (gravity, drag, springs, fields, damping) at states of their own choosing. Of these all but the last two
/// know nothing that is implicit: what is damped or swings faster than their steps can follow grows, until `step`
/// throws NotFinite. The last two take what is of any stiffness as it will be at the end of the step, by Newton's
/// method. Contacts and joints work with the mean force that they find.
enum class Integrator {
  exact_quadratic,      ///< x += v h + a h^2/2: exact under constant force (the default); drag is of first order
  semi_implicit_euler,  ///< v += a h, then x += v h; first order
  explicit_euler,       ///< on by what there was at the start; first order
  midpoint,             ///< by what there is halfway; second order
  trapezoid,            ///< by the mean of both ends, Heun's; second order
  rk4,                  ///< the classic Runge-Kutta method; fourth order
  verlet,               ///< velocity Verlet: places by the speed halfway; second order, and a swing keeps its energy
  backward_euler,       ///< on by what there will be at the end; first order, and a swing dies away
  implicit_trapezoid,   ///< by the mean of the start and what will be at the end; second order, keeps a swing's energy
};

/// A plane through the world's origin in which all bodies lie and turn.
enum class WorldPlane : std::uint8_t { none, xy, xz, yz };

struct WorldSettings {
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
  Integrator integrator = Integrator::exact_quadratic;
  int iterations = 20;          ///< passes of the contact solver over all contacts of a step
  double sleep_speed = 0.02;    ///< m/s (and rad/s times size) below which a body counts as still
  double sleep_after = 0.5;     ///< s of stillness after which a body sleeps; infinity: never
  double push_out_speed = 0.5;  ///< greatest speed at which overlap is taken apart, m/s
  ContactSolver solver{};       ///< how the contacts of an island are met
  Parting separation{};         ///< how overlap is taken apart
  Detection collision{};        ///< when bodies are found to meet
  PairSearch broad_phase{};     ///< how pairs are found that may meet
  /// Where bodies meet as their sections do, by the solver of `planar_world.h`; nothing leaves the plane by a bit.
  /// There `iterations`, `threads` and what of forces points out of it are not read, the strategies above must be the
  /// usual ones, joints are balls, hinges, sliders, welds, distances, springs, and no surface moves, spins or is of
  /// faces.
  WorldPlane plane{};
  int threads = 0;  ///< that share a step, 0 to 256; 0 and 1: the one that calls. No bit depends on it
};

/// How two bodies' frictions, or restitutions, make one. Of two bodies that name different rules the one that comes
/// later here holds: any that is named beats the usual one, and `maximum` all.
/// Source of the order from `average` on: PhysX's PxCombineMode, of which the greater holds.
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
  std::optional<MassProperties> mass_properties{};  ///< instead of those that an even solid has; beside no `mass`
  double friction = 0.5;   ///< Coulomb coefficient; a pair takes sqrt(f1 f2) unless told otherwise
  double restitution = 0;  ///< 0 to 1; a pair takes the larger unless told otherwise
  Combine friction_combine = Combine::usual;
  Combine restitution_combine = Combine::usual;
  double rolling_friction = 0;  ///< resistance to turning, as a length: torque <= length times normal force, m
  double spinning_friction =
      0;                        ///< besides that, the torque about the normal alone, likewise; pairs take the larger, m
  Twist surface_velocity = {};  ///< of the surface against the body, at its center of mass, node axes: a belt's
  bool sensor = false;          ///< reports what overlaps it, and neither pushes nor is pushed
  double linear_damping = 0;    ///< 1/s
  double angular_damping = 0;   ///< 1/s
  bool fixed = false;           ///< part of the scenery: never moves
  std::uint64_t groups = 1;     ///< that it belongs to, one bit each
  std::uint64_t collides_with =
      ~std::uint64_t{0};  ///< groups; two bodies meet when each collides with one of the other's
  Drive drive = Drive::free();
  Motion motion = {};  ///< of the node's origin, world axes
};

/// A touching pair after a step; of compounds, a touching pair of parts.
struct Contact {
  BodyId a, b;
  Manifold manifold;
  double impulse = 0;           ///< sum of normal impulses of the step, N s; >= 0
  Vec3 total_impulse{0, 0, 0};  ///< on b, friction included, N s
  double approach_speed = 0;    ///< normal speed at which they met, before the step's impulses, m/s
  bool began = false;           ///< the pair did not touch in the step before
  std::uint32_t part_a = 0,
                part_b = 0;  ///< which part of a compound touches; at which place a mesh or field does, counted
};

/// Two bodies that touched and do not any more.
struct EndedContact {
  BodyId a, b;  ///< may have been removed
};

/// A body in a sensor. Never another sensor, nor a fixed body in a fixed sensor; and by groups and ignored pairs as for
/// contacts.
struct SensorOverlap {
  BodyId sensor, body;
  bool began = false;  ///< was not in it at the end of the step before
};

/// A body's place or velocity is no longer a number, or beyond 1e30 m, m/s or rad/s; or a force on it is not finite.
class NotFinite : public std::runtime_error {
 public:
  NotFinite(BodyId body, double time, const std::string& cause);
  BodyId body;        ///< of the world that stepped; of a stage's own world where a stage throws
  double time = 0;    ///< of the world, at the end of the step that went wrong, s
  std::string cause;  ///< the likely one, in words that end a sentence

 protected:
  /// The same fault, told in other words.
  NotFinite(const NotFinite& fault, const std::string& text);
};

/// Bodies and what acts on them. A world that was moved from holds nothing: its `noexcept` members answer as for an
/// empty world, all others throw std::logic_error, until another world is assigned to it.
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
  [[nodiscard]] const MassProperties& mass(BodyId body) const;
  [[nodiscard]] const Shape& shape(BodyId body) const;
  [[nodiscard]] Owner owner(BodyId body) const;
  [[nodiscard]] Drive drive(BodyId body) const;
  [[nodiscard]] bool is_fixed(BodyId body) const;
  [[nodiscard]] bool is_sensor(BodyId body) const;
  [[nodiscard]] double still_for(BodyId body) const;  ///< s of stillness so far
  [[nodiscard]] bool asleep(BodyId body) const;
  /// Whether the drive of a driven body pulled with its greatest force or torque in the last step, and not enough.
  [[nodiscard]] bool saturated(BodyId body) const;
  [[nodiscard]] Vec3 reaction(
      BodyId body) const;  ///< sum of contact impulses on a keyed or fixed body since it was added, N s
  [[nodiscard]] double kinetic_energy() const;  ///< of all free bodies, J
  [[nodiscard]] double time() const noexcept;   ///< sum of the steps, s

  // Changes; each wakes the body. All throw std::invalid_argument for a stale handle, for numbers that are not finite
  // or beyond 1e30, and for a quaternion that cannot be normalized; and std::logic_error when a field calls them.
  /// Moves the body: pose and velocity of the node's origin. Contacts across the jump use this velocity, not the jump.
  void set_motion(BodyId body, const Motion& motion);
  /// Hands the body over. Leaving `keyed`, it keeps the pose and the twist of its last target; accumulated impulses are
  /// cleared.
  void set_drive(BodyId body, const Drive& drive);
  /// Where a keyed body shall be at the end of the next step, and its path's own velocity there.
  void set_target(BodyId body, const Motion& end_of_step);
  void apply_force(BodyId body, const Vec3& force, const Vec3& point);  ///< N, at a world point, during the next step
  void apply_torque(BodyId body, const Vec3& torque);                   ///< N m, during the next step
  void apply_impulse(BodyId body, const Vec3& impulse, const Vec3& point);  ///< N s, at once
  void wake(BodyId body);

  /// How the body's surface moves against it, at its center of mass in its node's axes: friction takes along what lies
  /// on it. Wakes what touches it.
  void set_surface_velocity(BodyId body, const Twist& velocity);
  [[nodiscard]] Twist surface_velocity(BodyId body) const;

  // Which bodies meet. A change wakes whom it concerns, at once and with no impulse; where bodies that now meet lie in
  // each other they are taken apart as any overlap is. All throw std::invalid_argument for a stale handle.
  void set_groups(BodyId body, std::uint64_t groups, std::uint64_t collides_with);
  [[nodiscard]] std::uint64_t groups(BodyId body) const;
  [[nodiscard]] std::uint64_t collides_with(BodyId body) const;
  void ignore(BodyId a, BodyId b);   ///< they pass through each other. @throws std::invalid_argument for the same body
  void collide(BodyId a, BodyId b);  ///< takes back `ignore`
  /// Whether they may meet: two bodies, neither a sensor, that no groups, no joint and no call of `ignore` keep apart.
  [[nodiscard]] bool collides(BodyId a, BodyId b) const;

  // Joints; all throw std::invalid_argument for a stale handle. Removing a body removes its joints
  JointId add_joint(
      const JointSettings& joint);   ///< wakes both ends. @throws std::invalid_argument naming what is wrong
  void remove_joint(JointId joint);  ///< wakes both ends
  [[nodiscard]] bool contains(JointId joint) const noexcept;
  [[nodiscard]] std::vector<JointId> joints() const;
  [[nodiscard]] const JointSettings& joint(JointId joint) const;
  /// Other limits, motors and so on for a joint of the same kind; wakes both ends.
  void set_joint(JointId joint, const JointKind& kind);
  [[nodiscard]] JointReading reading(JointId joint) const;
  /// Those that broke in the last step, in order; they are gone.
  [[nodiscard]] std::span<const JointId> broken_joints() const noexcept;

  // Forces
  /// @returns a number for the calls below
  /// @throws std::invalid_argument naming what is wrong
  std::size_t add_force(Force force, ForceSettings settings = {});
  // All throw std::invalid_argument for a number that is none
  void remove_force(std::size_t number);
  void set_strength(std::size_t force, const Strength& strength);
  /// Energy of a force's free bodies in it, at the present strength, J: of springs, attractors, potentials, steady
  /// pushes, and of buoyancy where gravity is square to the surface. None for what has none.
  [[nodiscard]] std::optional<double> potential_energy(std::size_t force) const;
  /// The sum of those that have one, and of gravity, which is 0 at the origin, J.
  [[nodiscard]] double potential_energy() const;

  // Time
  /// Advances by `dt` seconds. The result of n steps depends on their lengths alone, bit for bit.
  /// @throws std::invalid_argument when dt is not positive and finite
  /// @throws NotFinite when a body stops being finite: `step` throws again until it is removed or moved by
  /// `set_motion`. When a spring or a field is the cause, nothing has moved yet.
  /// @throws what a field throws; nothing has moved then
  void step(double dt);
  /// The same for a part of a step that is `whole` seconds long: contacts give way as in the whole step, so that what
  /// rests stays where it is however a step is split. @throws std::invalid_argument for a whole that is no number
  void step(double dt, double whole);
  /// Who does the parts of a step, in place of the threads of the settings; null for the thread that calls. Copies
  /// share it, as they share the threads of the settings. Fields are called by the calling thread alone.
  void set_executor(std::shared_ptr<Executor> executor);

  /// Pairs that touched in the last step, in a fixed order.
  [[nodiscard]] std::span<const Contact> contacts() const noexcept;
  /// Pairs that touched before the last step and not in it, or of which a body was removed before it. A contact that is
  /// among `contacts` and did not begin has persisted.
  [[nodiscard]] std::span<const EndedContact> ended_contacts() const noexcept;
  /// What was in sensors at the end of the last step, awake or asleep, by index of the sensor and then of the body.
  [[nodiscard]] std::span<const SensorOverlap> sensor_overlaps() const noexcept;
  /// What was in them one step before and was not then, or was removed.
  [[nodiscard]] std::span<const SensorOverlap> ended_sensor_overlaps() const noexcept;

  // Keeping it
  /// A number that changes when any bit does of what the world is: of all that tells on its next steps.
  [[nodiscard]] std::uint64_t state_hash() const noexcept;
  /// The world as bytes, from which `load` makes it again, with the same handles: it then steps to the same bits.
  /// @throws std::invalid_argument when the world has a `Field`, for a function cannot be saved: take it away with
  /// `remove_force` and add it again after loading; or when a body is not finite
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Becomes the world that was saved.
  /// @throws std::invalid_argument telling what is wrong with the bytes; nothing has changed then
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
