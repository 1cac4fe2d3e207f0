#include "shapes/turn_onto.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::shapes {

Quat turn_onto(const Vec3& from, const Vec3& to) noexcept {
  const Vec3 a = from / from.norm(), b = to / to.norm();
  // Half the turn, by the direction in the middle.
  const Vec3 middle = a + b;
  const double length = middle.norm();
  Quat turn(0, 0, 0, 0);
  if (length > 1e-8) {
    const Vec3 half = middle / length;
    const Vec3 axis = a.cross(half);
    turn = Quat(a.dot(half), axis.x(), axis.y(), axis.z());
  } else {
    int least = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(a[i]) < std::abs(a[least])) least = i;
    const Vec3 across = Vec3::Unit(least) - a[least] * a;
    turn = Quat(0, across.x(), across.y(), across.z());
  }
  turn.coeffs() /= turn.coeffs().norm();
  return turn;
}

}  // namespace tweenfall::shapes
