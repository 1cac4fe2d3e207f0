#include <cmath>
#include <stdexcept>

#include "curve/extrapolation.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Cycles;

class CyclesForm : public ModifierForm {
 public:
  CyclesForm(const Cycles& cycles, const Curve<double>& curve)
      : cycles_(cycles), start_(curve.start()), end_(curve.end()) {
    const Curve<double> held = curve.with_outside(Outside::hold, Outside::hold);
    gain_ = held.value(end_, Side::out) - held.value(start_, Side::in);
  }

  void retime(Moment& m, double& offset) const noexcept override {
    const double duration = end_ - start_, t = m.time.v;
    const bool arrives = m.side == Side::in;
    const bool early = t < start_ || (t == start_ && arrives), late = t > end_ || (t == end_ && !arrives);
    if (!(duration > 0) || (!early && !late)) return;
    const Cycles::Mode mode = early ? cycles_.before : cycles_.after;
    const int most = early ? cycles_.plays_before : cycles_.plays_after;
    if (mode == Cycles::Mode::none) return;
    const auto [local, plays] = spans::played_time(t, start_, duration, arrives);
    const double beyond = early ? -plays : plays;
    if (most > 0 && beyond > most) return;
    if (mode == Cycles::Mode::mirror && std::fmod(plays, 2) != 0) {
      m.time = {end_ - local, -m.time.d, -m.time.dd};
      m.side = opposite(m.side);
    } else {
      m.time.v = local == duration ? end_ : start_ + local;
    }
    if (mode == Cycles::Mode::repeat_offset) offset = plays * gain_;
  }

  void change(math::Jet& value, const Moment&, double offset) const noexcept override { value.v += offset; }

 private:
  Cycles cycles_;
  double start_, end_, gain_;
};

}  // namespace

FormPointer form_of(const Cycles& cycles, const Curve<double>& curve) {
  for (const int plays : {cycles.plays_before, cycles.plays_after})
    if (plays < 0) throw std::invalid_argument("the plays of cycles must be >= 0; they are " + std::to_string(plays));
  return std::make_unique<const CyclesForm>(cycles, curve);
}

}  // namespace tweenfall::forms
