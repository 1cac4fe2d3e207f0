#include "eases/ease_row.h"
#include "slopes/c2_slopes.h"
#include "turns/turn_rule.h"

namespace tweenfall::slopes {
namespace {

// Source: de Boor, "A Practical Guide to Splines", chapter IV.
void natural(const SlopeProblem& p) {
  solve_c2_automatic(p, C2End::Kind::second);
}

void natural_given(const SlopeProblem& p) {
  const double start = p.eases[p.first]->parameters()[0], end = p.eases[p.last - 1]->parameters()[1];
  solve_c2(p, {C2End::Kind::second, std::vector<double>(p.dimensions, start)},
           {C2End::Kind::second, std::vector<double>(p.dimensions, end)});
}

}  // namespace
}  // namespace tweenfall::slopes

namespace tweenfall {

Ease Ease::natural() {
  static const Ease ease(Form{.name = "natural",
                              .slopes = &slopes::natural,
                              .turns = &turns::natural,
                              .continuous_acceleration = true,
                              .c2_ends = slopes::C2End::Kind::second});
  return ease;
}

Ease Ease::natural(double start, double end) {
  slopes::check_ends("second derivatives", start, end);
  return Ease(Form{.name = eases::call_text("natural", std::array{start, end}),
                   .slopes = &slopes::natural_given,
                   .parameters = {start, end, 0, 0},
                   .continuous_acceleration = true,
                   .c2_ends = slopes::C2End::Kind::second,
                   .with_ends = &Ease::natural});
}

namespace eases {
extern const Row natural_row{"natural", &Ease::natural, "(start,end)", [](const Call& call) {
                               call.expect(2, 2, "natural(start,end), second derivatives at the ends");
                               return Ease::natural(call.number(0), call.number(1));
                             }};
}  // namespace eases

}  // namespace tweenfall
