#include <stdexcept>

#include "curve/components.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Limits;

class LimitsForm : public ModifierForm {
 public:
  explicit LimitsForm(const Limits& limits) : limits_(limits) {}

  void retime(Moment& m, double&) const noexcept override {
    if (limits_.start && m.time.v < *limits_.start) m = {math::constant(*limits_.start), Side::out};
    if (limits_.end && m.time.v > *limits_.end) m = {math::constant(*limits_.end), Side::in};
  }

  void change(math::Jet& value, const Moment&, double) const noexcept override {
    if (limits_.low && value.v < *limits_.low) value = math::constant(*limits_.low);
    if (limits_.high && value.v > *limits_.high) value = math::constant(*limits_.high);
  }

 private:
  Limits limits_;
};

}  // namespace

FormPointer form_of(const Limits& limits, const Curve<double>&) {
  for (const auto* bound : {&limits.low, &limits.high, &limits.start, &limits.end})
    if (*bound) check_finite(**bound, "a limit");
  if (limits.low && limits.high && *limits.low > *limits.high)
    throw std::invalid_argument("the low limit, " + spans::text_of(*limits.low) +
                                ", must not lie above the high one, " + spans::text_of(*limits.high));
  if (limits.start && limits.end && *limits.start > *limits.end)
    throw std::invalid_argument("the limits of time must not end before they start; they go from " +
                                spans::text_of(*limits.start) + " s to " + spans::text_of(*limits.end) + " s");
  return std::make_unique<const LimitsForm>(limits);
}

}  // namespace tweenfall::forms
