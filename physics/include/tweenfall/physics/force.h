#pragma once

/// Forces that act on bodies between contacts. They add up, can be evaluated at any state an integrator asks for, may
/// be limited to some bodies and may have a scripted strength (`strength.h`).

#include <tweenfall/curves/pose.h>
#include <tweenfall/physics/strength.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

struct BodyId {
  std::uint32_t index = 0xffffffffu;
  std::uint32_t generation = 0;  ///< so that the handle of a removed body is not mistaken for its successor
  bool operator==(const BodyId&) const = default;
};

/// Resistance of a medium: -linear v - quadratic |v| v, and -angular w for the spin.
struct Drag {
  double linear = 0;     ///< kg/s
  double quadratic = 0;  ///< kg/m
  double angular = 0;    ///< kg m^2/s
};

/// A damped spring between a point of a body and a point of another, or of the world. It may be of any stiffness: one
/// that would swing by about a radian or more within a step is taken implicitly, which is stable and damps it.
struct Spring {
  BodyId a;                ///< pulled
  BodyId b = {};           ///< pulled the other way; the default handle means the world
  Vec3 anchor_a{0, 0, 0};  ///< on a's node, m
  Vec3 anchor_b{0, 0, 0};  ///< on b's node, or in the world, m
  double rest_length = 0;  ///< m
  double stiffness = 0;    ///< N/m
  double damping = 0;      ///< N s/m, along the spring
};

/// A dashpot between two such points: -damping times the rate of their distance, along the line between them. It is
/// stable with any amount of damping.
struct Damper {
  BodyId a;
  BodyId b = {};  ///< the default handle means the world
  Vec3 anchor_a{0, 0, 0}, anchor_b{0, 0, 0};
  double damping = 0;  ///< N s/m
};

/// A medium that moves: resistance to the velocity relative to it. With a coefficient, also 1/2 rho C A |v| v, where A
/// is the area the body shows along that velocity (each part of a compound counts fully, as nothing shields it).
struct Wind {
  Vec3 velocity{0, 0, 0};   ///< of the medium, m/s
  double linear = 0;        ///< kg/s
  double quadratic = 0;     ///< kg/m
  double angular = 0;       ///< kg m^2/s
  double coefficient = 0;   ///< of drag, C: about .5 for a ball, 1 for a box
  double density = 1.2041;  ///< rho of the medium, kg/m^3: of air at 20 degrees
};

/// A liquid below a plane surface: it lifts a body by the weight of the displaced liquid, at the center of the
/// submerged part, and resists its motion in proportion to the submerged share.
/// Source: Archimedes; volumes are exact for spheres, boxes and hulls, and to about 1e-10 for other round solids.
struct Buoyancy {
  Vec3 normal{0, 1, 0};   ///< of the surface, out of the liquid; any length but 0
  double level = 0;       ///< of the surface along the normal, m
  double density = 1000;  ///< of the liquid, kg/m^3
  Drag drag = {};         ///< of a fully submerged body
  Vec3 flow{0, 0, 0};     ///< velocity of the liquid, m/s
};

/// Draws bodies toward a point, by an acceleration of `acceleration` / r^power, with r = sqrt(distance^2 +
/// softening^2). With power 2 that is Newton's gravity of a mass of `acceleration` / G. The attractor itself is not
/// drawn: two bodies that draw each other are two attractors.
struct Attractor {
  BodyId of = {};           ///< whose point it is; the default handle means the world
  Vec3 at{0, 0, 0};         ///< on that body's node, or in the world, m
  double acceleration = 1;  ///< m/s^2 at a distance of 1 m; negative drives away
  double power = 2;         ///< -4 to 8
  double softening = 0;     ///< m
  bool by_mass = true;      ///< false: a force in N in place of the acceleration
};

/// Drives bodies around an axis, counterclockwise as seen against it, by an acceleration of `acceleration` / r^power,
/// with r as above but measured from the axis; and draws them toward it by `inward` times that.
struct Vortex {
  Vec3 at{0, 0, 0};    ///< a point of the axis, m
  Vec3 axis{0, 1, 0};  ///< any length but 0
  double acceleration = 1;
  double inward = 0;
  double power = 1;  ///< -4 to 8
  double softening = 0;
};

/// A force by formulas of x, y, z (of the center of mass, m), vx, vy, vz (m/s), t (time of the world, s) and mass (kg).
/// Where one has no finite value 0 stands in.
///
/// What leaps in it by t alone (floor(t), x * step(0.5, t), ...) does so at one instant everywhere: times within a
/// billionth of a second are the leap's, and a stage ends a step there. What leaps by place, or by place and time as a
/// front does, is met at the ends of steps: where something is thinner than the way of a body in a step, the body may
/// pass it unfelt, and `inspect` tells.
class ForceFormula {
 public:
  using Parameter = Expression::Parameter;
  ForceFormula() : ForceFormula({"0", "0", "0"}) {}
  // Moving copies: what was moved from stays what it was.
  ForceFormula(const ForceFormula&) = default;
  ForceFormula& operator=(const ForceFormula&) = default;
  /// @param force  its three components, N
  /// @throws ExpressionError
  explicit ForceFormula(std::array<std::string, 3> force, std::vector<Parameter> parameters = {});
  /// The force of a potential energy in J: its exact negative gradient. The energy may not use vx, vy or vz.
  /// @throws ExpressionError
  [[nodiscard]] static ForceFormula potential(std::string energy, std::vector<Parameter> parameters = {});

  /// @param side  of a leap by the time
  [[nodiscard]] Vec3 force(double mass, const Vec3& position, const Vec3& velocity, double time,
                           Side side = Side::out) const noexcept;
  using Lists = std::array<std::span<const double>, 3>;  ///< one for each axis, all of one length
  /// The same for many, in a fraction of the time.
  void forces(double mass, const Lists& positions, const Lists& velocities, double time, Side side,
              const std::array<std::span<double>, 3>& out) const noexcept;
  /// J; none unless it was made from a potential.
  [[nodiscard]] std::optional<double> energy(double mass, const Vec3& position, double time) const noexcept;
  [[nodiscard]] bool reads_time() const noexcept { return reads_time_; }
  /// The first leap by the time alone in (from, to], s; infinity for none. Those that undo each other within an eighth
  /// of that may go unseen where one function makes both, as step(0.999, sin(200*t)) does.
  [[nodiscard]] double next_leap(double from, double to) const noexcept;
  /// Where a body on its way through a straight piece of a step meets what leaps by place.
  /// @param dt  duration of the way from one place to the other, s
  /// @return seconds since its beginning, in order; up to eight
  [[nodiscard]] std::vector<double> leaps_on_way(double mass, const Vec3& from, const Vec3& to, double time,
                                                 double dt) const;

  [[nodiscard]] const std::vector<std::string>& texts() const noexcept { return texts_; }  ///< three, or one potential
  [[nodiscard]] const std::vector<Parameter>& parameters() const noexcept { return parameters_; }

 private:
  struct Texts {
    std::vector<std::string> all;
  };
  ForceFormula(Texts texts, std::vector<Parameter> parameters);

  std::vector<std::string> texts_;
  std::vector<Parameter> parameters_;
  std::vector<Expression> expressions_;
  std::vector<Expression> leaping_by_time_, leaping_by_place_;  ///< parts of them
  bool reads_time_ = false;
};

/// A steady force and torque on one body.
struct Push {
  BodyId body;
  Vec3 force{0, 0, 0};       ///< N
  Vec3 torque{0, 0, 0};      ///< N m, in addition to the one that the force has about the center of mass
  std::optional<Vec3> at{};  ///< where the force acts, on the body's node, m; absent: at its center of mass
  bool turns = false;        ///< force and torque turn with the body; otherwise they keep to the world's axes
};

/// A force field: force in N on a body, from its mass and the motion of its center of mass. A world with a field keeps
/// its bodies awake, since a field may change. It may read the world that it acts in and throw, but not change it:
/// calls that would change it throw std::logic_error, and it must not be destroyed or assigned to.
using Field = std::function<Vec3(double mass, const Vec3& position, const Vec3& velocity, double time)>;

using Force = std::variant<Drag, Spring, Field, Damper, Wind, Buoyancy, Attractor, Vortex, ForceFormula, Push>;

/// Which bodies a force acts on, and how strongly.
struct ForceSettings {
  std::vector<BodyId> bodies = {};  ///< empty: all; ignored by forces that name their bodies themselves
  Strength strength = {};           ///< factor; for drag, springs, dampers, wind and buoyancy, negative counts as 0
};

}  // namespace tweenfall
