#include <algorithm>

#include "eases/ease_row.h"
#include "rotation/moving_rotation.h"
#include "slopes/slope_rule.h"
#include "turns/turn_rule.h"

namespace tweenfall::turns {
namespace {

// slerp(slerp(from, to, s), slerp(b, c, s), 2 s (1 - s)): at the start its angular velocity is the straight way plus
// twice the way to the control b, so that b follows from the velocity wanted. With that of Catmull-Rom this is
// Shoemake's rule on even times. Source: Shoemake, "Quaternion calculus and fast animation", 1987.
void squad(const TurnProblem& p) {
  for (std::size_t i = p.first; i < p.last; ++i) {
    const Stretch& stretch = p.stretches[i];
    const Vec3 leaving = p.leaving(i) - stretch.way, arriving = p.arriving(i) - stretch.way;
    // Controls more than a whole turn away would be mistaken for nearer ones.
    constexpr double most = 2 * 6.2;
    if (p.is_plain(i) || std::max(leaving.norm(), arriving.norm()) > most) {
      p.spans.push_back(cubic_turn(stretch, p.leaving(i), p.arriving(i)));
      continue;
    }
    RotationSpan span = blank_span(stretch);
    span.form = RotationSpan::Form::nested;
    span.degree = max_degree;
    const Quat to = stretch.near_to();
    const Quat b = stretch.from * exp_map(leaving / 2);
    const Quat c = to * exp_map(-arriving / 2);
    span.coefficients[0] = stretch.from.coeffs();
    span.coefficients[3] = padded(stretch.way);
    span.coefficients[1] = span.coefficients[2] = b.coeffs();
    span.coefficients[4] = span.coefficients[5] = padded(rotations::signed_log(b.conjugate() * c));
    span.coefficients[7] = {2, -2, 0, 0};
    p.spans.push_back(span);
  }
}

}  // namespace
}  // namespace tweenfall::turns

namespace tweenfall {

Ease Ease::squad() {
  static const Ease ease(Form{.name = "squad", .slopes = &slopes::catmull_rom, .turns = &turns::squad});
  return ease;
}

namespace eases {
extern const Row squad_row{"squad", &Ease::squad};
}  // namespace eases

}  // namespace tweenfall
