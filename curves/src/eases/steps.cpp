#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall::eases {

// Source: W3C, "CSS Easing Functions Level 1", steps().
static Pieces steps(int count, std::string_view jump) {
  const bool at_start = jump == "jump-start" || jump == "jump-both";
  const bool at_end = jump == "jump-end" || jump == "jump-both";
  const int jumps = count - 1 + (at_start ? 1 : 0) + (at_end ? 1 : 0);
  Pieces result;
  for (int i = 0; i < count; ++i) {
    Span<double> p{};
    p.start = static_cast<double>(i) / count;
    p.duration = static_cast<double>(i + 1) / count - p.start;
    p.coefficients[0] = static_cast<double>(i + (at_start ? 1 : 0)) / jumps;
    p.end = p.coefficients[0];
    result.push_back(p);
  }
  return result;
}

namespace {

constexpr std::string_view jumps[] = {"jump-start", "jump-end", "jump-none", "jump-both"};

Ease stepped(const Call& call) {
  call.expect(1, 2, "steps(count,jump)");
  const double count = call.number(0);
  std::string_view jump = call.arguments.size() == 2 ? call.arguments[1] : "jump-end";
  if (jump == "start") jump = "jump-start";
  if (jump == "end") jump = "jump-end";
  bool known = false;
  for (const std::string_view word : jumps) known = known || word == jump;
  if (!known) refuse(words::quoted(jump) + " in steps(...) must be jump-start, jump-end, jump-none or jump-both");
  const double least = jump == "jump-none" ? 2 : 1;
  if (count != std::floor(count) || count < least || count > 100000)
    refuse("the count in steps(...) must be a whole number from " + number_text(least) + " to 100000; it is " +
           number_text(count));
  return Ease::shape("steps(" + number_text(count) + "," + std::string(jump) + ")",
                     steps(static_cast<int>(count), jump));
}

}  // namespace

extern const Row steps_row{"steps", nullptr, "(count,jump)", &stepped};
extern const Row step_next_row{"step-next", &Ease::step_next};
extern const Row step_start_row{"step-start", [] { return Ease::shape("step-start", steps(1, "jump-start")); }};
extern const Row step_end_row{"step-end", [] { return Ease::shape("step-end", steps(1, "jump-end")); }};

}  // namespace tweenfall::eases

namespace tweenfall {

Ease Ease::step_next() {
  static const Ease ease = shape("step-next", eases::steps(1, "jump-start"));
  return ease;
}

}  // namespace tweenfall
