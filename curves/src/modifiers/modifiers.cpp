#include <tweenfall/curves/modifiers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "curve/curve_data.h"
#include "modifiers/modifier_form.h"

namespace tweenfall {

void forms::ModifierForm::retime(forms::Moment&, double&) const noexcept {}
void forms::ModifierForm::change(math::Jet&, const forms::Moment&, double) const noexcept {}

void forms::check_finite(double value, const char* name) {
  if (!std::isfinite(value))
    throw std::invalid_argument(std::string(name) + " must be finite; it is " + spans::text_of(value));
}

namespace forms {
namespace {

class Stack {
 public:
  Stack(const Curve<double>& curve, std::span<const Modifier> modifiers) : curve_(curve) {
    for (std::size_t i = 0; i < modifiers.size(); ++i) {
      try {
        add(modifiers[i]);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("modifier " + std::to_string(i) + ": " + error.what());
      }
    }
  }

  [[nodiscard]] Sample<double> sample(double time, Side side) const noexcept {
    const math::Jet value = evaluate(layers_.size(), {{time, 1, 0}, side}).value;
    return {value.v, value.d, value.dd};
  }

 private:
  struct Layer {
    forms::FormPointer form;
    std::optional<ModifierRange> range;
    double influence;

    // The influence at a moment inside the range; 0 outside.
    [[nodiscard]] math::Jet weight(const forms::Moment& m) const noexcept {
      if (!range) return math::constant(influence);
      const double t = m.time.v;
      // At the ends of the range the side decides, in the direction of time.
      const bool arrives = m.side == Side::in;
      if (t < range->start || t > range->end) return math::constant(0);
      if (t == range->start && arrives && range->start < range->end) return math::constant(0);
      if (t == range->end && !arrives && range->start < range->end) return math::constant(0);
      const double from_start = t - range->start, to_end = range->end - t;
      if (from_start < range->blend_in) return (influence / range->blend_in) * (m.time + -range->start);
      if (to_end < range->blend_out) return (influence / range->blend_out) * (math::constant(range->end) - m.time);
      return math::constant(influence);
    }
  };

  struct Result {
    math::Jet value;
    forms::Moment moment;
  };

  void add(const Modifier& m) {
    if (!(m.influence >= 0 && m.influence <= 1))
      throw std::invalid_argument("the influence must lie in 0 to 1; it is " + spans::text_of(m.influence));
    if (m.range) {
      const ModifierRange& r = *m.range;
      forms::check_finite(r.start, "the range's start");
      forms::check_finite(r.end, "the range's end");
      if (!(r.start <= r.end))
        throw std::invalid_argument("the range must not end before it starts; it goes from " + spans::text_of(r.start) +
                                    " s to " + spans::text_of(r.end) + " s");
      for (const double blend : {r.blend_in, r.blend_out})
        if (!(blend >= 0) || !std::isfinite(blend))
          throw std::invalid_argument("the range's blends must be >= 0 s; one is " + spans::text_of(blend));
    }
    forms::FormPointer form = std::visit([this](const auto& kind) { return forms::form_of(kind, curve_); }, m.kind);
    layers_.push_back({std::move(form), m.range, m.influence});
  }

  // The curve seen through the first `count` layers.
  [[nodiscard]] Result evaluate(std::size_t count, forms::Moment moment) const noexcept {
    if (count == 0) {
      const Sample<double> s = curve_.sample(moment.time.v, moment.side);
      return {math::chained(moment.time, s.value, s.rate, s.acceleration), moment};
    }
    const Layer& layer = layers_[count - 1];
    double memory = 0;
    if (const math::Jet weight = layer.weight(moment); weight.v != 0 || weight.d != 0) {
      forms::Moment inner = moment;
      layer.form->retime(inner, memory);
      if (weight.v == 1 && weight.d == 0)
        moment = inner;
      else
        moment.time = moment.time + weight * (inner.time - moment.time);
    }
    Result result = evaluate(count - 1, moment);
    if (const math::Jet weight = layer.weight(result.moment); weight.v != 0 || weight.d != 0) {
      math::Jet changed = result.value;
      layer.form->change(changed, result.moment, memory);
      result.value = weight.v == 1 && weight.d == 0 ? changed : result.value + weight * (changed - result.value);
    }
    return result;
  }

  Curve<double> curve_;
  std::vector<Layer> layers_;
};

}  // namespace
}  // namespace forms

Curve<double> modified(const Curve<double>& curve, std::span<const Modifier> modifiers) {
  const auto stack = std::make_shared<const forms::Stack>(curve, modifiers);
  // A slope stated for outside applies to the curve below, on which the modifiers are laid.
  const std::vector<Modifier> kept(modifiers.begin(), modifiers.end());
  return CurveAccess::seen_through<double>(
      [stack](double time, Side side) { return stack->sample(time, side); }, curve.start(), curve.end(),
      CurveAccess::breaks(curve), {curve.before(), {}, curve.rule_before().plays},
      {curve.after(), {}, curve.rule_after().plays},
      [curve, kept](const OutsideRule<double>& before, const OutsideRule<double>& after) {
        return modified(curve.with_outside(before, after), kept);
      },
      std::vector<NumberOverTime>{[stack](double time, Side side) { return stack->sample(time, side); }});
}

}  // namespace tweenfall
