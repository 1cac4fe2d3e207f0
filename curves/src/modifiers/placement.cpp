#include <cmath>
#include <stdexcept>

#include "curve/components.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Placement;

class PlacementForm : public ModifierForm {
 public:
  explicit PlacementForm(const Placement& placement) : p_(placement) {}

  void retime(Moment& m, double&) const noexcept override {
    const math::Jet from_offset = m.time + -p_.time_offset;
    m.time = {from_offset.v / p_.time_scale, from_offset.d / p_.time_scale, from_offset.dd / p_.time_scale};
    if (p_.time_scale < 0) m.side = opposite(m.side);
  }

  void change(math::Jet& value, const Moment&, double) const noexcept override {
    value = p_.value_scale * value + p_.value_offset;
  }

 private:
  Placement p_;
};

}  // namespace

FormPointer form_of(const Placement& placement, const Curve<double>&) {
  check_finite(placement.time_offset, "the time offset");
  check_finite(placement.time_scale, "the time scale");
  check_finite(placement.value_offset, "the value offset");
  check_finite(placement.value_scale, "the value scale");
  if (placement.time_scale == 0) throw std::invalid_argument("the time scale must not be 0");
  return std::make_unique<const PlacementForm>(placement);
}

}  // namespace tweenfall::forms
