#include "islands/blocks/jointed_spins.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::blocks {

namespace {

/// Per sub-step, rad: larger turns are not followed, and smaller ones have nothing worth following.
constexpr double followable_turn = 1, noticeable_turn = 0.02;
/// Largest turn of a piece of half a sub-step: with this, a spin loses less than a millionth in a thousand.
constexpr double turn_of_a_piece = 0.15;

}  // namespace

/// By Euler's equations and the classic Runge-Kutta method; most limbs are tops, of which more is known.
Vec3 JointedSpins::after_half(const Spin& spin, const state::Body& body, const Vec3& start) {
  if (spin.top) return forces::spin_of_top(body.mass().inertia, *spin.top, start, spin.half);
  const auto rate = [&](const Vec3& at) { return forces::rate_of_spin(body, spin.torque, at); };
  const double turn = start.norm() * spin.half;
  const int pieces = std::max(1, static_cast<int>(std::ceil(turn / turn_of_a_piece)));
  const double h = spin.half / pieces;
  Vec3 at = start;
  for (int piece = 0; piece < pieces; ++piece) {
    const Vec3 k1 = rate(at), k2 = rate(at + 0.5 * h * k1), k3 = rate(at + 0.5 * h * k2), k4 = rate(at + h * k3);
    at += h / 6 * (k1 + 2 * (k2 + k3) + k4);
  }
  return at;
}

Vec3 JointedSpins::begin_sub_step(std::size_t place, const state::Body& body, const forces::Load& load,
                                  const Quat& rotation, const Vec3& angular, double h) {
  Spin& spin = spins_[place];
  spin.half = 0;
  const double turn = angular.squaredNorm() * h * h;
  if (!(turn <= followable_turn * followable_turn) || turn < noticeable_turn * noticeable_turn) return angular;
  spin.half = 0.5 * h;
  spin.rotation = rotation;
  spin.torque = rotation.conjugate() * load.torque;
  spin.top = load.torque == Vec3::Zero() ? forces::axis_of_top(body.mass().inertia) : std::nullopt;
  spin.bent = Vec3::Zero();
  // The body axes at the middle and at the instant between show the same spin, as it turns the body about itself.
  spin.at_impulse = after_half(spin, body, rotation.conjugate() * angular);
  // What a torque makes so fast at once would take no end of pieces.
  if (!(spin.at_impulse.squaredNorm() * h * h <= followable_turn * followable_turn)) {
    spin.half = 0;
    return angular;
  }
  spin.flown = after_half(spin, body, spin.at_impulse);
  return rotation * spin.flown;
}

Vec3 JointedSpins::followed(std::size_t place, const state::Body& body, const Vec3& angular) {
  Spin& spin = spins_[place];
  const Vec3 given = spin.rotation.conjugate() * angular - spin.flown - spin.bent;
  const Vec3 start = spin.at_impulse + given;
  if (!(start.squaredNorm() * 4 * spin.half * spin.half <= followable_turn * followable_turn)) return angular;
  const Vec3 bent = after_half(spin, body, start) - spin.flown - given;
  const Vec3 change = bent - spin.bent;
  spin.bent = bent;
  return angular + spin.rotation * change;
}

Vec3 JointedSpins::turned_back(std::size_t place, const state::Body& body, const Quat& rotation, const Vec3& before,
                               const Vec3& after) const {
  const Spin& spin = spins_[place];
  const Vec3 start = rotation.conjugate() * before, given = rotation.conjugate() * after - start;
  const double turn = 2 * spin.half * std::max(start.norm(), (start + given).norm());
  if (!(turn <= followable_turn)) return after;
  return after - rotation * (after_half(spin, body, start + given) - after_half(spin, body, start) - given);
}

}  // namespace tweenfall::blocks
