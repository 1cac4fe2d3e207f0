#include <algorithm>

#include "rotation/moving_rotation.h"
#include "turns/turn_rule.h"

namespace tweenfall::turns {

void set_de_casteljau(RotationSpan& span, const Quat& a, const Quat& b, const Quat& c, const Quat& d) {
  span.form = RotationSpan::Form::nested;
  span.degree = max_degree;
  const Quat* controls[] = {&a, &b, &c, &d};
  for (std::size_t i = 0; i < 3; ++i) {
    span.coefficients[i] = controls[i]->coeffs();
    span.coefficients[3 + i] = padded(rotations::signed_log(controls[i]->conjugate() * *controls[i + 1]));
  }
  span.coefficients[6] = {0, 1, 0, 1};
  span.coefficients[7] = {1, 0, 0, 0};
}

// The inner controls lie a third of the duration along the angular velocities at the keys; at an open end half way to
// the other inner control, where a straight cubic would have no second derivative.
// Source: Shoemake, "Animating rotation with quaternion curves", 1985.
void de_casteljau(const TurnProblem& p) {
  for (std::size_t i = p.first; i < p.last; ++i) {
    const Stretch& stretch = p.stretches[i];
    const Vec3 leaving = p.leaving(i), arriving = p.arriving(i);
    // Controls more than a whole turn away would be mistaken for nearer ones.
    constexpr double most = 3 * 6.2;
    if (p.is_plain(i) || std::max(leaving.norm(), arriving.norm()) > most) {
      p.spans.push_back(cubic_turn(stretch, leaving, arriving));
      continue;
    }
    RotationSpan span = blank_span(stretch);
    const Quat a = stretch.from, d = stretch.near_to();
    const bool open = p.starts_open(i), shut = !p.ends_open(i);
    Quat b = a * exp_map(leaving / 3), c = d * exp_map(-arriving / 3);
    if (open && shut) b = a * exp_map(rotations::signed_log(a.conjugate() * c) / 2);
    if (!open && !shut) c = d * exp_map(rotations::signed_log(d.conjugate() * b) / 2);
    set_de_casteljau(span, a, b, c, d);
    p.spans.push_back(span);
  }
}

}  // namespace tweenfall::turns
