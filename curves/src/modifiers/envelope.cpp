#include <algorithm>
#include <stdexcept>

#include "curve/components.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Envelope;

class EnvelopeForm : public ModifierForm {
 public:
  explicit EnvelopeForm(const Envelope& envelope) : e_(envelope) {}

  void change(math::Jet& value, const Moment& m, double) const noexcept override {
    const math::Jet place = (1 / (e_.high - e_.low)) * (value + -(e_.reference + e_.low));
    const math::Jet low = bound(m, &Envelope::Point::low), high = bound(m, &Envelope::Point::high);
    value = low + place * (high - low);
  }

 private:
  [[nodiscard]] math::Jet bound(const Moment& m, double Envelope::Point::*side) const noexcept {
    const double t = m.time.v;
    const bool arrives = m.side == Side::in;
    const auto after = std::find_if(e_.points.begin(), e_.points.end(),
                                    [&](const Envelope::Point& p) { return p.time > t || (p.time == t && arrives); });
    if (after == e_.points.begin()) return math::constant(e_.points.front().*side);
    if (after == e_.points.end()) return math::constant(e_.points.back().*side);
    const Envelope::Point &a = *(after - 1), &b = *after;
    const double rate = (b.*side - a.*side) / (b.time - a.time);
    return rate * (m.time + -a.time) + a.*side;
  }

  Envelope e_;
};

}  // namespace

FormPointer form_of(const Envelope& envelope, const Curve<double>&) {
  if (envelope.points.empty()) throw std::invalid_argument("an envelope needs at least one point");
  for (const double v : {envelope.reference, envelope.low, envelope.high}) check_finite(v, "an envelope's band");
  if (envelope.low == envelope.high)
    throw std::invalid_argument("an envelope's band must have a width; both its bounds are " +
                                spans::text_of(envelope.low));
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    const Envelope::Point& p = envelope.points[i];
    for (const double v : {p.time, p.low, p.high}) check_finite(v, "an envelope's point");
    if (i > 0 && !(p.time > envelope.points[i - 1].time))
      throw std::invalid_argument("an envelope's points must follow in time; point " + std::to_string(i) + " lies at " +
                                  spans::text_of(p.time) + " s, the one before at " +
                                  spans::text_of(envelope.points[i - 1].time) + " s");
  }
  return std::make_unique<const EnvelopeForm>(envelope);
}

}  // namespace tweenfall::forms
