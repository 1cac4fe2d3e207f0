#include <cmath>
#include <numbers>

#include "actors/particles/block.h"
#include "forces/kinds/kinds.h"

namespace tweenfall::particles {

namespace {

using One = std::array<double, most_together>;

/// A medium with its drag on all of them.
struct Medium {
  Vec3 velocity;
  double linear, quadratic;  ///< divided by the mass, 1/s and 1/m
};

void add_medium(const Medium& medium, std::size_t count, const Lists& speeds, Pulls& pulls) {
  pulls.drags = true;
  const double ux = medium.velocity.x(), uy = medium.velocity.y(), uz = medium.velocity.z();
  One drag;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = speeds[0][i] - ux, y = speeds[1][i] - uy, z = speeds[2][i] - uz;
    drag[i] = medium.linear + medium.quadratic * std::sqrt(x * x + y * y + z * z);
    pulls.drag[i] += drag[i];
  }
  if (medium.velocity == Vec3::Zero()) return;
  pulls.carries = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double speed = medium.velocity[static_cast<Eigen::Index>(axis)];
    One &acceleration = pulls.acceleration[axis], &carried = pulls.carried[axis];
    for (std::size_t i = 0; i < count; ++i) {
      acceleration[i] += drag[i] * speed;
      carried[i] += drag[i] * speed;
    }
  }
}

struct Adding {
  const Pulling& pulling;
  double strength, time;
  Side side;
  std::size_t count;
  const Lists &places, &speeds;
  Pulls& pulls;

  void operator()(const Drag& kind) const {
    const double share = forces::not_negative(strength) / pulling.mass;
    add_medium({Vec3(0, 0, 0), share * kind.linear, share * kind.quadratic}, count, speeds, pulls);
  }
  void operator()(const Wind& kind) const {
    const double share = forces::not_negative(strength) / pulling.mass;
    const double area = std::numbers::pi * pulling.radius * pulling.radius;
    const double quadratic = kind.quadratic + 0.5 * kind.density * kind.coefficient * area;
    add_medium({kind.velocity, share * kind.linear, share * quadratic}, count, speeds, pulls);
  }
  void operator()(const Attractor& kind) const {
    const double amount = strength * kind.acceleration / (kind.by_mass ? 1 : pulling.mass);
    const double soft = kind.softening * kind.softening;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = kind.at.x() - places[0][i], y = kind.at.y() - places[1][i], z = kind.at.z() - places[2][i];
      const double pull = amount * forces::fall_off(x * x + y * y + z * z + soft, kind.power);
      pulls.acceleration[0][i] += pull * x;
      pulls.acceleration[1][i] += pull * y;
      pulls.acceleration[2][i] += pull * z;
    }
  }
  void operator()(const Vortex& kind) const {
    const Vec3 axis = kind.axis / kind.axis.norm();
    const double soft = kind.softening * kind.softening;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 from = Vec3(places[0][i], places[1][i], places[2][i]) - kind.at;
      const Vec3 out = from - axis.dot(from) * axis;
      const double fall = strength * kind.acceleration * forces::fall_off(out.squaredNorm() + soft, kind.power);
      add(i, fall * (axis.cross(out) - kind.inward * out));
    }
  }
  void operator()(const ForceFormula& kind) const {
    const auto given = [&](const Lists& lists) -> ForceFormula::Lists {
      return {std::span(lists[0]).first(count), std::span(lists[1]).first(count), std::span(lists[2]).first(count)};
    };
    Lists force;
    kind.forces(pulling.mass, given(places), given(speeds), time, side,
                {std::span(force[0]).first(count), std::span(force[1]).first(count), std::span(force[2]).first(count)});
    const double share = strength / pulling.mass;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < count; ++i) pulls.acceleration[axis][i] += share * force[axis][i];
  }
  void operator()(const Field& kind) const {
    for (std::size_t i = 0; i < count; ++i)
      add(i, strength / pulling.mass *
                 kind(pulling.mass, Vec3(places[0][i], places[1][i], places[2][i]),
                      Vec3(speeds[0][i], speeds[1][i], speeds[2][i]), time));
  }
  // Only for bodies
  template <class Kind>
  void operator()(const Kind&) const {}

 private:
  void add(std::size_t i, const Vec3& acceleration) const {
    pulls.acceleration[0][i] += acceleration.x();
    pulls.acceleration[1][i] += acceleration.y();
    pulls.acceleration[2][i] += acceleration.z();
  }
};

}  // namespace

void find_pulls(const Pulling& pulling, std::size_t count, const Lists& places, const Lists& speeds, double time,
                Instant instant, Pulls& pulls) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gravity = pulling.gravity[static_cast<Eigen::Index>(axis)];
    for (std::size_t i = 0; i < count; ++i) pulls.acceleration[axis][i] = gravity;
    for (std::size_t i = 0; i < count; ++i) pulls.carried[axis][i] = 0;
  }
  for (std::size_t i = 0; i < count; ++i) pulls.drag[i] = 0;
  pulls.drags = pulls.carries = false;
  for (const PullingForce& entry : pulling.forces) {
    const double strength = instant == Instant::start    ? entry.start
                            : instant == Instant::middle ? entry.middle
                                                         : entry.end;
    std::visit(
        Adding{pulling, strength, time, instant == Instant::end ? Side::in : Side::out, count, places, speeds, pulls},
        *entry.force);
  }
}

bool acts_on_particles(const Force& force) {
  if (const auto* attractor = std::get_if<Attractor>(&force)) return attractor->of == BodyId{};
  return std::holds_alternative<Drag>(force) || std::holds_alternative<Wind>(force) ||
         std::holds_alternative<Vortex>(force) || std::holds_alternative<ForceFormula>(force) ||
         std::holds_alternative<Field>(force);
}

bool is_steady(const Force& force) {
  return std::holds_alternative<Drag>(force) || std::holds_alternative<Wind>(force);
}

}  // namespace tweenfall::particles
