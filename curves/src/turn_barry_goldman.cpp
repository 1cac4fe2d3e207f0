#include "turn_rule.h"

namespace tweenfall {

// Beyond an end that has no neighbor, one is taken as far off in time as the other key, and such that the slope
// there is what the slope rule says.
// Source: Barry and Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom splines", 1988.
void turns_barry_goldman(const TurnProblem& p) {
  const std::vector<Stretch>& all = p.stretches;
  const bool wrap = p.ends == Ends::wrap;
  for (std::size_t i = p.first; i < p.last; ++i) {
    const Stretch& stretch = all[i];
    RotationSpan span = blank_span(stretch);
    span.form = RotationSpan::Form::nested;
    span.degree = max_degree;
    const double h = stretch.duration;
    double before = h, after = h;  // durations of the neighbors
    Vec3 arriving_way = 2 * p.leaving(i) - stretch.way, leaving_way = 2 * p.arriving(i) - stretch.way;
    if (i > 0 || wrap) {
      const Stretch& neighbor = all[i > 0 ? i - 1 : all.size() - 1];
      before = neighbor.duration;
      arriving_way = neighbor.way;
    }
    if (i + 1 < all.size() || wrap) {
      const Stretch& neighbor = all[i + 1 < all.size() ? i + 1 : 0];
      after = neighbor.duration;
      leaving_way = neighbor.way;
    }
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

}  // namespace tweenfall
