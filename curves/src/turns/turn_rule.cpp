#include "turns/turn_rule.h"
#include "curve/hermite_coefficients.h"

namespace tweenfall {

bool TurnProblem::is_plain(std::size_t i) const noexcept {
  const turns::Stretch& own = stretches[i];
  for (const turns::Stretch* stretch : {before(i), &own, after(i)})
    if (stretch && !stretch->spin.isZero(0)) return true;
  const Vec3 ways[] = {own.way, leaving(i), arriving(i)};
  const Vec3* longest = &ways[0];
  for (const Vec3& way : ways)
    if (way.squaredNorm() > longest->squaredNorm()) longest = &way;
  for (const Vec3& way : ways)
    if (!(way.cross(*longest).squaredNorm() <= 1e-20 * longest->squaredNorm() * longest->squaredNorm())) return false;
  return true;
}

}  // namespace tweenfall

namespace tweenfall::turns {

RotationSpan cubic_turn(const Stretch& stretch, const Vec3& leaving, const Vec3& arriving) {
  RotationSpan span = blank_span(stretch);
  span.degree = 3;
  const Vec4 from(0, 0, 0, 0), change = padded(stretch.way);
  const Vec4 d0 = padded(leaving), d1 = padded(right_jacobian_inverse(stretch.way) * arriving);
  spans::cubic_coefficients(from, change, d0, d1, span.coefficients.data());
  return span;
}

}  // namespace tweenfall::turns
