#include "eases/ease_row.h"
#include "slopes/slope_rule.h"
#include "turns/turn_rule.h"

namespace tweenfall::slopes {
namespace {

// Source: Kochanek and Bartels, "Interpolating splines with local tension, continuity, and bias control", 1984,
// with the secants weighted by durations as for Catmull-Rom on uneven times.
void tcb(const SlopeProblem& p) {
  const auto slope = [&p](std::size_t key, std::size_t span, bool arriving, std::size_t c) {
    const std::size_t a = p.before(key), b = p.after(key);
    if (a == SlopeProblem::none || b == SlopeProblem::none) return 0.0;
    // The three numbers are those of the key; if it has none of its own (the run ends there), those of the span. The
    // last key of a loop is its first.
    const bool seam = key == p.spans && p.eases[key]->slope_rule() != &tcb;
    const Ease& own = *p.eases[seam ? 0 : key];
    const auto& parameters = own.slope_rule() == &tcb ? own.parameters() : p.eases[span]->parameters();
    const double tension = parameters[0], bias = parameters[2];
    const double continuity = arriving ? -parameters[1] : parameters[1];
    const double h0 = p.durations[a], h1 = p.durations[b];
    return (1 - tension) * ((1 + continuity) * (1 + bias) * (h1 / (h0 + h1)) * p.secant(a, c) +
                            (1 - continuity) * (1 - bias) * (h0 / (h0 + h1)) * p.secant(b, c));
  };
  for (std::size_t i = p.first; i < p.last; ++i)
    for (std::size_t c = 0; c < p.dimensions; ++c) {
      p.leaving[i * p.dimensions + c] = slope(i, i, false, c);
      p.arriving[i * p.dimensions + c] = slope(i + 1, i, true, c);
    }
  p.finish_open_ends();
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::tcb(double tension, double continuity, double bias) {
  eases::check_range("the tension of tcb", tension, -1e6, 1e6);
  eases::check_range("the continuity of tcb", continuity, -1e6, 1e6);
  eases::check_range("the bias of tcb", bias, -1e6, 1e6);
  return Ease(Form{.name = eases::call_text("tcb", std::array{tension, continuity, bias}),
                   .slopes = &slopes::tcb,
                   .parameters = {tension, continuity, bias, 0},
                   .turns = &turns::de_casteljau});
}

namespace eases {
extern const Row tcb_row{"tcb", nullptr, "(tension,continuity,bias)", [](const Call& call) {
                           call.expect(3, 3, "tcb(tension,continuity,bias)");
                           return Ease::tcb(call.number(0), call.number(1), call.number(2));
                         }};
}  // namespace eases

}  // namespace tweenfall
