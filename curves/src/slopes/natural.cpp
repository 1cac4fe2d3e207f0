#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"
#include "turns/turn_rule.h"

namespace tweenfall {

// Source: de Boor, "A Practical Guide to Splines", chapter IV.
static void slopes_natural(const SlopeProblem& p) {
  slopes::solve_c2_automatic(p, slopes::C2End::Kind::second);
}

static void slopes_natural_given(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  slopes::solve_c2(p, {slopes::C2End::Kind::second, std::vector<double>(p.dimensions, start)},
                   {slopes::C2End::Kind::second, std::vector<double>(p.dimensions, end)});
}

Ease Ease::natural() {
  static const Ease ease(
      Form{.name = "natural", .slopes = &slopes_natural, .turns = &turns_natural, .continuous_acceleration = true});
  return ease;
}

Ease Ease::natural(double start, double end) {
  slopes::check_ends("second derivatives", start, end);
  return Ease(Form{.name = eases::call_text("natural", std::array{start, end}),
                   .slopes = &slopes_natural_given,
                   .parameters = {start, end, 0, 0},
                   .continuous_acceleration = true,
                   .with_ends = &Ease::natural});
}

namespace eases {
extern const Row natural_row{"natural", &Ease::natural, "(start,end)", [](const Call& call) {
                               call.expect(2, 2, "natural(start,end), second derivatives at the ends");
                               return Ease::natural(call.number(0), call.number(1));
                             }};
}  // namespace eases

}  // namespace tweenfall
