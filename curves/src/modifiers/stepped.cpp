#include <cmath>
#include <stdexcept>

#include "curve/components.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Stepped;

class SteppedForm : public ModifierForm {
 public:
  explicit SteppedForm(const Stepped& stepped) : stepped_(stepped) {}

  void retime(Moment& m, double&) const noexcept override {
    const double t = m.time.v;
    const bool arrives = m.side == Side::in;
    if (stepped_.start && (t < *stepped_.start || (t == *stepped_.start && arrives))) return;
    if (stepped_.end && (t > *stepped_.end || (t == *stepped_.end && !arrives))) return;
    double n = std::floor((t - stepped_.offset) / stepped_.step);
    if (arrives && n * stepped_.step + stepped_.offset == t) n -= 1;
    if (stepped_.toward_offset && n < 0) n += 1;
    m = {math::constant(n * stepped_.step + stepped_.offset), Side::out};
  }

 private:
  Stepped stepped_;
};

}  // namespace

FormPointer form_of(const Stepped& stepped, const Curve<double>&) {
  if (!(stepped.step > 0) || !std::isfinite(stepped.step))
    throw std::invalid_argument("a step must be > 0 s; it is " + spans::text_of(stepped.step));
  check_finite(stepped.offset, "the offset of steps");
  if (stepped.start) check_finite(*stepped.start, "the start of steps");
  if (stepped.end) check_finite(*stepped.end, "the end of steps");
  return std::make_unique<const SteppedForm>(stepped);
}

}  // namespace tweenfall::forms
