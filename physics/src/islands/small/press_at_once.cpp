#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "step/solver.h"

/// Solves for the normal impulses of one contact all at once: one after the other, points close together would disturb
/// each other.

namespace tweenfall::small {

namespace {

/// Softness added to each point: with it, no set of points is linearly dependent, and solving again about the resulting
/// impulses removes its effect.
/// Source: Rockafellar, Monotone Operators and the Proximal Point Algorithm, SIAM J. Control 14, 1976.
constexpr double softness = 1e-9;
constexpr int most_hardenings = 8;

using Numbers = std::array<double, 4>;

/// How impulses of points change their speeds: rows of a positive definite matrix.
using Eases = std::array<Numbers, 4>;

/// Impulses of the pressing points, given as bits, that stop these points; 0 for the others.
Numbers pressed_by(unsigned pressing, int count, const Eases& eases, const Numbers& speeds) {
  Eases left = eases;
  Numbers impulses{};
  const auto presses = [pressing](int i) { return (pressing >> static_cast<unsigned>(i) & 1u) != 0; };
  const auto at = [](auto& numbers, int i) -> auto& {
    return numbers[static_cast<std::size_t>(i)];
  };
  for (int i = 0; i < count; ++i) at(impulses, i) = presses(i) ? -at(speeds, i) : 0;
  for (int i = 0; i < count; ++i)
    for (int k = i + 1; presses(i) && k < count; ++k) {
      if (!presses(k)) continue;
      const double part = at(at(left, k), i) / at(at(left, i), i);
      for (int n = i; n < count; ++n) at(at(left, k), n) -= part * at(at(left, i), n);
      at(impulses, k) -= part * at(impulses, i);
    }
  for (int i = count; i-- > 0;) {
    if (!presses(i)) continue;
    for (int k = i + 1; k < count; ++k)
      if (presses(k)) at(impulses, i) -= at(at(left, i), k) * at(impulses, k);
    at(impulses, i) /= at(at(left, i), i);
  }
  return impulses;
}

/// How far a set of pressing points is from a solution, in which none pulls and no other point closes; 0 at best.
double wrong_of(unsigned pressing, int count, const Eases& eases, const Numbers& speeds, const Numbers& impulses) {
  double wrong = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    double speed = speeds[i];
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) speed += eases[i][k] * impulses[k];
    wrong = std::max(wrong, (pressing >> i & 1u) != 0 ? -impulses[i] : -speed);
  }
  return wrong;
}

/// The impulses of the best of all sets of points that may press.
/// @param likely  tried first, since most often it is the right one; returns the best set
Numbers pressed(int count, const Eases& eases, const Numbers& speeds, unsigned& likely) {
  Numbers best{};
  double least = std::numeric_limits<double>::infinity();
  unsigned found = likely;
  const auto is_right = [&](unsigned pressing) {
    Numbers impulses = pressed_by(pressing, count, eases, speeds);
    const double wrong = wrong_of(pressing, count, eases, speeds, impulses);
    if (!(wrong < least)) return false;
    least = wrong;
    found = pressing;
    for (double& impulse : impulses) impulse = std::max(0.0, impulse);
    best = impulses;
    return least == 0;
  };
  if (!is_right(likely))
    for (unsigned pressing = 0; pressing < 1u << static_cast<unsigned>(count); ++pressing)
      if (pressing != likely && is_right(pressing)) break;
  likely = found;
  return best;
}

}  // namespace

}  // namespace tweenfall::small

namespace tweenfall::step {

void Solver::press_at_once(SolvedContact& contact, const PointRows* rows) {
  SolverBody& a = at(contact.a);
  SolverBody& b = at(contact.b);
  const auto count = static_cast<std::size_t>(contact.count);
  const Vec3& normal = contact.normal;
  small::Eases eases{};
  small::Numbers start{}, speeds{};
  // A unit of impulse is scaled to add a unit of speed by itself.
  for (std::size_t i = 0; i < count; ++i) {
    const SolvedPoint& point = contact.points[i];
    const PointRows& row = rows[i];
    const double speed =
        normal.dot(b.linear - a.linear) + row.turn_b.dot(b.angular) - row.turn_a.dot(a.angular) - point.wanted;
    start[i] = point.normal_impulse * row.scale;
    speeds[i] = speed / row.scale;
    for (std::size_t k = 0; k < count; ++k) {
      const double ease =
          a.inverse_mass + b.inverse_mass + row.turn_a.dot(rows[k].spin_a) + row.turn_b.dot(rows[k].spin_b);
      eases[i][k] = ease / (row.scale * rows[k].scale);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k) speeds[i] -= eases[i][k] * start[k];
    const double firm = contact.points[i].firm;
    // A point that is left out is softer than anything.
    eases[i][i] += firm > 0 ? (1 - firm) / firm + small::softness : 1 / small::softness;
    if (!(firm > 0)) speeds[i] = 0;
  }
  small::Numbers impulses = start;
  unsigned pressing = (1u << static_cast<unsigned>(count)) - 1;
  for (int k = 0; k < small::most_hardenings; ++k) {
    small::Numbers wanted = speeds;
    for (std::size_t i = 0; i < count; ++i) wanted[i] -= small::softness * impulses[i];
    const small::Numbers before = impulses;
    impulses = small::pressed(contact.count, eases, wanted, pressing);
    if (impulses == before) break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    SolvedPoint& point = contact.points[i];
    const double next = point.firm > 0 ? impulses[i] / rows[i].scale : point.normal_impulse;
    const Vec3 change = (next - point.normal_impulse) * normal;
    point.normal_impulse = next;
    push(a, -change, point.arm_a);
    push(b, change, point.arm_b);
  }
}

}  // namespace tweenfall::step
