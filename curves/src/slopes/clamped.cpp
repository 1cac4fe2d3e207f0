#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"

namespace tweenfall::slopes {
namespace {

// The ends are stated, so that neither a loop nor the curve's options change them.
void clamped(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  solve_c2(p, {C2End::Kind::slope, std::vector<double>(p.dimensions, start)},
           {C2End::Kind::slope, std::vector<double>(p.dimensions, end)});
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::clamped() {
  static const Ease ease(Form{.name = "clamped",
                              .slopes = &slopes::clamped,
                              .continuous_acceleration = true,
                              .c2_ends = slopes::C2End::Kind::slope});
  return ease;
}

Ease Ease::clamped(double start, double end) {
  slopes::check_ends("slopes", start, end);
  return Ease(Form{.name = eases::call_text("clamped", std::array{start, end}),
                   .slopes = &slopes::clamped,
                   .parameters = {start, end, 0, 0},
                   .continuous_acceleration = true,
                   .c2_ends = slopes::C2End::Kind::slope,
                   .with_ends = &Ease::clamped});
}

namespace eases {
extern const Row clamped_row{"clamped", &Ease::clamped, "(start,end)", [](const Call& call) {
                               call.expect(2, 2, "clamped(start,end), slopes at the ends");
                               return Ease::clamped(call.number(0), call.number(1));
                             }};
}  // namespace eases

}  // namespace tweenfall
