#include "eases/ease_row.h"
#include "slopes/slope_rule.h"
#include "turns/turn_rule.h"

namespace tweenfall {

void SlopeProblem::finish_open_ends() const {
  if (ends == Ends::wrap) return;
  const std::size_t d = dimensions;
  const bool at_start = first == 0, at_end = last == spans;
  for (std::size_t c = 0; c < d; ++c) {
    double& start = leaving[c];
    double& end = arriving[(spans - 1) * d + c];
    if (ends == Ends::flat) {
      if (at_start) start = 0;
      if (at_end) end = 0;
    } else if (spans == 1) {
      start = end = secant(0, c);
    } else {
      if (at_start) start = 0.5 * (3 * secant(0, c) - arriving[c]);
      if (at_end) end = 0.5 * (3 * secant(spans - 1, c) - leaving[(spans - 1) * d + c]);
    }
  }
}

// Source: Barry and Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom splines", 1988.
void slopes::catmull_rom(const SlopeProblem& p) {
  p.for_each_key([&p](std::size_t key, std::size_t c) {
    const std::size_t a = p.before(key), b = p.after(key);
    if (a == SlopeProblem::none || b == SlopeProblem::none) return 0.0;
    const double h0 = p.durations[a], h1 = p.durations[b];
    return h1 / (h0 + h1) * p.secant(a, c) + h0 / (h0 + h1) * p.secant(b, c);
  });
  p.finish_open_ends();
}

Ease Ease::catmull_rom() {
  static const Ease ease(Form{.name = "catmull-rom", .slopes = &slopes::catmull_rom, .turns = &turns::de_casteljau});
  return ease;
}

namespace eases {
extern const Row catmull_rom_row{"catmull-rom", &Ease::catmull_rom};
}  // namespace eases

}  // namespace tweenfall
