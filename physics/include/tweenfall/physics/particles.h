#pragma once

/// Particles: points with a mass, many of them, that forces move and bodies turn back. They do not turn, do not meet
/// each other and do not push bodies.
///
/// Emitters let them go along the way of a node: each at the exact instant at which the integral of the rate says so,
/// between steps as well, from where the emitter's own curve is then and with that curve's velocity. What is random
/// about a particle follows from a seed and its number alone: however time is divided, the same particles leave.

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
  /// Which way through a step: any but the implicit ones. With `exact_quadratic` drag is implicit, and so stable.
  Integrator integrator = Integrator::exact_quadratic;
  double mass = 1e-3;          ///< of each, kg; > 0
  double radius = 0;           ///< how far from its middle it touches bodies, and how large a wind finds it, m
  double restitution = 0.5;    ///< of bounces; of this and the body's the larger holds
  double friction = 0.5;       ///< with a body: sqrt of both
  double life = 10;            ///< s from when it was let go; may be infinite
  double life_spread = 0;      ///< by up to this share of it lives are longer or shorter, 0 to 1
  std::size_t most = 1000000;  ///< at a time; those that would be more are not let go
  std::uint64_t seed = 1;
};

/// Lets particles go. Times are those of the particles.
struct Emitter {
  Curve<Vec3> position = Curve<Vec3>(Vec3(0, 0, 0));     ///< m
  Curve<Quat> rotation = Curve<Quat>(Quat(1, 0, 0, 0));  ///< of its axes
  /// Particles per second; never negative. A formula is taken in stretches of ten minutes: where it is negative or
  /// beyond 1e9 in a later one, none leave in that, and none after a million seconds.
  Curve<double> rate = Curve<double>(0.0);
  Curve<Vec3> velocity = Curve<Vec3>(Vec3(0, 0, 0));  ///< of particles, in its axes, m/s
  double inherit = 1;                                 ///< share of its own velocity that they take along
  double spread = 0;                                  ///< half angle of the cone in which they leave, rad, 0 to pi
  double speed_spread = 0;                            ///< by up to this share they are faster or slower
  double size = 0;                                    ///< radius of the ball in which they begin, evenly, m
  double start = 0, end = 1e30;                       ///< between which it emits, s
};

/// Many particles, as one list for each of their numbers. A copy goes on to the same bits.
class Particles {
 public:
  /// @throws std::invalid_argument naming what is wrong
  explicit Particles(const ParticleSettings& settings = {});

  /// From now on it lets particles go: particle k when the integral of its rate since its start reaches k. What would
  /// have left before is not made up for.
  /// @throws std::invalid_argument naming what is wrong
  void add(const Emitter& emitter);
  /// Where an emitter is from now on. @param emitter  in the order in which they were added
  /// @throws std::invalid_argument for one that is not there
  void place(std::size_t emitter, const Curve<Vec3>& position, const Curve<Quat>& rotation);
  void halt(std::size_t emitter);  ///< lets no more go. @throws std::invalid_argument for one that is not there
  /// Lets one go, now. @throws std::invalid_argument for numbers that are not finite
  void emit(const Vec3& position, const Vec3& velocity);
  /// Drag, a wind, an attractor of the world, a vortex, a formula or a field. What they say of masses and places holds
  /// of particles; of a wind's coefficient a ball of their radius.
  /// @throws std::invalid_argument for other kinds, and numbers that cannot be
  void add_force(const Force& force, const Strength& strength = {});

  /// Through `dt` seconds. @throws std::invalid_argument unless dt is positive and finite
  void step(double dt);
  /// The same among bodies, which are where they are at the end of the step: what comes to one bounces off, at the
  /// instant at which it does, and goes on through the rest of the step. Sensors are passed through.
  void step(double dt, const World& world);

  [[nodiscard]] const ParticleSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] double time() const noexcept { return time_; }
  [[nodiscard]] std::size_t size() const noexcept { return x_.size(); }
  [[nodiscard]] std::uint64_t emitted() const noexcept { return emitted_; }    ///< all of them, dead ones too
  [[nodiscard]] std::uint64_t left_out() const noexcept { return left_out_; }  ///< because there were too many

  // One number for each particle, the oldest first
  [[nodiscard]] std::span<const double> x() const noexcept { return x_; }
  [[nodiscard]] std::span<const double> y() const noexcept { return y_; }
  [[nodiscard]] std::span<const double> z() const noexcept { return z_; }
  [[nodiscard]] std::span<const double> vx() const noexcept { return vx_; }
  [[nodiscard]] std::span<const double> vy() const noexcept { return vy_; }
  [[nodiscard]] std::span<const double> vz() const noexcept { return vz_; }
  [[nodiscard]] std::span<const double> born() const noexcept { return born_; }  ///< s
  [[nodiscard]] std::span<const double> dies() const noexcept { return dies_; }  ///< s
  /// By which each is known for its whole life: 2^40 times that of its emitter, and how many left there before; 2^63
  /// and more for those let go by `emit`.
  [[nodiscard]] std::span<const std::uint64_t> numbers() const noexcept { return number_; }
  [[nodiscard]] Vec3 position(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  [[nodiscard]] Vec3 velocity(std::size_t i) const { return {vx_[i], vy_[i], vz_[i]}; }

  [[nodiscard]] double kinetic_energy() const noexcept;  ///< J
  [[nodiscard]] Vec3 momentum() const noexcept;          ///< kg m/s

 private:
  friend struct saving::ParticleFields;
  struct Source {
    Emitter emitter;           ///< its rate that of the present stretch
    Curve<double> rate;        ///< as it was given
    Curve<double> let_go;      ///< how many until a time, within the stretch
    double before = 0;         ///< how many until it began
    double from = 0, to = 0;   ///< between which times it lies; infinity where it is the last
    std::uint64_t number = 0;  ///< of those that have left
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
