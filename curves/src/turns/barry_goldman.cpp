#include "eases/ease_row.h"
#include "slopes/slope_rule.h"
#include "turns/turn_rule.h"

namespace tweenfall::turns {
namespace {

// Beyond an end without a neighbor, one is assumed as far away in time as the other key, and such that the slope there
// is the one from the slope rule. Source: Barry and Goldman, "A recursive evaluation algorithm for a class of
// Catmull-Rom splines", 1988.
void barry_goldman(const TurnProblem& p) {
  for (std::size_t i = p.first; i < p.last; ++i) {
    const Stretch& stretch = p.stretches[i];
    if (p.is_plain(i)) {
      p.spans.push_back(cubic_turn(stretch, p.leaving(i), p.arriving(i)));
      continue;
    }
    RotationSpan span = blank_span(stretch);
    span.form = RotationSpan::Form::nested;
    span.degree = max_degree;
    const Stretch *earlier = p.before(i), *later = p.after(i);
    const double h = stretch.duration, before = earlier ? earlier->duration : h, after = later ? later->duration : h;
    const Vec3 arriving_way = earlier ? earlier->way : Vec3(2 * p.leaving(i) - stretch.way);
    const Vec3 leaving_way = later ? later->way : Vec3(2 * p.arriving(i) - stretch.way);
    span.coefficients[0] = span.coefficients[1] = stretch.from.coeffs();
    span.coefficients[3] = padded(h / before * arriving_way);
    span.coefficients[4] = padded(stretch.way);
    span.coefficients[2] = (stretch.near_to() * exp_map(-h / after * leaving_way)).coeffs();
    span.coefficients[5] = padded(h / after * leaving_way);
    span.coefficients[6] = {before / (before + h), h / (before + h), 0, h / (h + after)};
    span.coefficients[7] = {1, 0, 0, 0};
    p.spans.push_back(span);
  }
}

}  // namespace
}  // namespace tweenfall::turns

namespace tweenfall {

Ease Ease::barry_goldman() {
  static const Ease ease(Form{.name = "barry-goldman", .slopes = &slopes::catmull_rom, .turns = &turns::barry_goldman});
  return ease;
}

namespace eases {
extern const Row barry_goldman_row{"barry-goldman", &Ease::barry_goldman};
}  // namespace eases

}  // namespace tweenfall
