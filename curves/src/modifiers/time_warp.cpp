#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

class TimeWarpForm : public ModifierForm {
 public:
  explicit TimeWarpForm(const Curve<double>& clock) : clock_(clock) {}

  void retime(Moment& m, double&) const noexcept override {
    const Sample<double> s = clock_.sample(m.time.v, m.side);
    m.time = math::chained(m.time, s.value, s.rate, s.acceleration);
    // Where the clock reverses, both sides approach from the same one.
    if (s.rate < 0)
      m.side = opposite(m.side);
    else if (s.rate == 0 && s.acceleration != 0)
      m.side = s.acceleration > 0 ? Side::out : Side::in;
  }

 private:
  Curve<double> clock_;
};

}  // namespace

FormPointer form_of(const modifiers::TimeWarp& warp, const Curve<double>&) {
  return std::make_unique<const TimeWarpForm>(warp.clock);
}

}  // namespace tweenfall::forms
