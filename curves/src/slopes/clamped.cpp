#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall {

// The ends are stated, so that neither a loop nor the curve's options change them.
static void slopes_clamped(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  slopes::solve_c2(p, {slopes::C2End::Kind::slope, std::vector<double>(p.dimensions, start)},
                   {slopes::C2End::Kind::slope, std::vector<double>(p.dimensions, end)});
}

Ease Ease::clamped() {
  static const Ease ease(Form{.name = "clamped", .slopes = &slopes_clamped, .continuous_acceleration = true});
  return ease;
}

Ease Ease::clamped(double start, double end) {
  slopes::check_ends("slopes", start, end);
  return Ease(Form{.name = eases::call_text("clamped", std::array{start, end}),
                   .slopes = &slopes_clamped,
                   .parameters = {start, end, 0, 0},
                   .continuous_acceleration = true,
                   .with_ends = &Ease::clamped});
}

namespace eases {
extern const Row clamped_row{"clamped", &Ease::clamped, "(start,end)", [](const Call& call) {
                               call.expect(2, 2, "clamped(start,end), slopes at the ends");
                               return Ease::clamped(call.number(0), call.number(1));
                             }};
}  // namespace eases

}  // namespace tweenfall
