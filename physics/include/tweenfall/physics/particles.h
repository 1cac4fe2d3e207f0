#pragma once

/// Particles: many points with a mass, moved by forces and turned back by bodies. They have no rotation, do not meet
/// each other and do not push bodies.
///
/// Emitters release them along the path of a node: each at the exact instant that the integral of the rate gives,
/// between steps as well, from where the emitter's own curve is then and with that curve's velocity. Whatever is random
/// about a particle follows from a seed and its number alone: however time is divided, the same particles come out.

#include <tweenfall/curves/curve.h>
#include <tweenfall/physics/world.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall {

namespace particles {
class Colliders;
}
namespace saving {
struct ParticleFields;
}

struct ParticleSettings {
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
  /// Each particle by itself. With `exact_quadratic`, drag is implicit, and so stable; with the implicit ones, all is.
  Integrator integrator = Integrator::exact_quadratic;
  double mass = 1e-3;          ///< of each, kg; > 0
  double radius = 0;           ///< distance at which it touches bodies, and its size for a wind, m
  double restitution = 0.5;    ///< of bounces; the larger of this and the body's counts
  double friction = 0.5;       ///< with a body: the square root of the product of both
  double life = 10;            ///< s from its release; may be infinite
  double life_spread = 0;      ///< lives are longer or shorter by up to this share, 0 to 1
  std::size_t most = 1000000;  ///< at the same time; beyond that, none are released
  std::uint64_t seed = 1;
};

/// Releases particles. Its times are those of the particles.
struct Emitter {
  Curve<Vec3> position = Curve<Vec3>(Vec3(0, 0, 0));     ///< m
  Curve<Quat> rotation = Curve<Quat>(Quat(1, 0, 0, 0));  ///< of its axes
  /// Particles per second; never negative. A formula is taken in stretches of ten minutes: none are released in a later
  /// stretch in which it is negative or above 1e9, and none after a million seconds.
  Curve<double> rate = Curve<double>(0.0);
  Curve<Vec3> velocity = Curve<Vec3>(Vec3(0, 0, 0));  ///< of the released particles, in the emitter's axes, m/s
  double inherit = 1;                                 ///< share of the emitter's own velocity that particles inherit
  double spread = 0;                                  ///< half angle of the cone in which particles leave, rad, 0 to pi
  double speed_spread = 0;                            ///< speeds are higher or lower by up to this share
  double size = 0;                                    ///< radius of the ball in which particles start, evenly spread, m
  double start = 0, end = 1e30;                       ///< when it emits, s
};

/// Many particles, stored as one list per component. A copy continues to the same bits.
class Particles {
 public:
  /// @throws std::invalid_argument naming what is wrong
  explicit Particles(const ParticleSettings& settings = {});

  /// Adds an emitter, which releases particle k when the integral of its rate since its start reaches k. Those that
  /// would have left before now are not made up for.
  /// @throws std::invalid_argument naming what is wrong
  void add(const Emitter& emitter);
  /// Moves an emitter from now on. @param emitter  its index in the order in which emitters were added
  /// @throws std::invalid_argument for an emitter that does not exist
  void place(std::size_t emitter, const Curve<Vec3>& position, const Curve<Quat>& rotation);
  void halt(std::size_t emitter);  ///< ends its emission. @throws std::invalid_argument for one that does not exist
  /// Releases one particle now. @throws std::invalid_argument for numbers that are not finite
  void emit(const Vec3& position, const Vec3& velocity);
  /// Drag, a wind, an attractor of the world, a vortex, a formula or a field. Particles take the place of the bodies:
  /// with their mass and position, and for the coefficient of a wind as balls of their radius.
  /// @throws std::invalid_argument for other kinds, and for impossible numbers
  void add_force(const Force& force, const Strength& strength = {});

  /// Advances by `dt` seconds. @throws std::invalid_argument unless dt is positive and finite
  void step(double dt);
  /// The same among bodies, which are where they are at the end of the step: a particle that reaches one bounces off at
  /// the instant when it does, and continues through the rest of the step. Particles pass through sensors.
  void step(double dt, const World& world);

  [[nodiscard]] const ParticleSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] std::size_t size() const noexcept { return x_.size(); }
  [[nodiscard]] std::uint64_t emitted() const noexcept { return emitted_; }    ///< all of them, including dead ones
  [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }  ///< never released: too many

  // One number per particle, the oldest first
  [[nodiscard]] std::span<const double> x() const noexcept { return x_; }
  [[nodiscard]] std::span<const double> y() const noexcept { return y_; }
  [[nodiscard]] std::span<const double> z() const noexcept { return z_; }
  [[nodiscard]] std::span<const double> vx() const noexcept { return vx_; }
  [[nodiscard]] std::span<const double> vy() const noexcept { return vy_; }
  [[nodiscard]] std::span<const double> vz() const noexcept { return vz_; }
  [[nodiscard]] std::span<const double> born() const noexcept { return born_; }  ///< s
  [[nodiscard]] std::span<const double> dies() const noexcept { return dies_; }  ///< s
  /// Identifies each particle for its whole life: 2^40 times the number of its emitter, plus how many left there
  /// before; 2^63 and more for those released by `emit`.
  [[nodiscard]] std::span<const std::uint64_t> numbers() const noexcept { return number_; }
  [[nodiscard]] Vec3 position(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  [[nodiscard]] Vec3 velocity(std::size_t i) const { return {vx_[i], vy_[i], vz_[i]}; }

  [[nodiscard]] double kinetic_energy() const noexcept;  ///< J
  [[nodiscard]] Vec3 momentum() const noexcept;          ///< kg m/s

 private:
  friend struct saving::ParticleFields;
  struct Source {
    Emitter emitter;           ///< its rate is that of the present stretch
    Curve<double> rate;        ///< as it was given
    Curve<double> let_go;      ///< how many are released by a time, within the stretch
    double before = 0;         ///< how many were released before the stretch
    double from = 0, to = 0;   ///< times between which the stretch lies; infinite for the last one
    std::uint64_t number = 0;  ///< how many have left
    std::uint64_t seed = 0;
  };
  struct Acting {
    Force force;
    Strength strength;
  };

  void advance(double dt, const World* world);
  void move(std::size_t first, std::size_t behind, double from, double dt, const particles::Colliders* colliders);
  void let_go(double until, const particles::Colliders* colliders);
  void add_one(const Vec3& position, const Vec3& velocity, double at, double share, std::uint64_t number);
  void bury();

  ParticleSettings settings_;
  std::vector<Source> sources_;
  std::vector<Acting> forces_;
  double time_ = 0;
  std::uint64_t emitted_ = 0, left_out_ = 0, by_hand_ = 0;
  std::vector<double> x_, y_, z_, vx_, vy_, vz_, born_, dies_;
  std::vector<std::uint64_t> number_;
};

}  // namespace tweenfall
