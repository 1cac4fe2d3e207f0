#include "pose/clip_look.h"

namespace tweenfall::pose {

namespace {

template <class T>
Sample<T> per_stage_second(Sample<T> sample, double clock_rate) noexcept {
  sample.rate *= clock_rate;
  sample.acceleration *= clock_rate * clock_rate;
  return sample;
}

// The numbers of a value that is mixed component by component.
double& numbers(double& value) noexcept {
  return value;
}
Vec4& numbers(Color& value) noexcept {
  return value.rgba;
}

template <class T>
void fade(Sample<T>& under, Sample<T> over, const Sample<double>& weight) noexcept {
  if (weight.value == 1 && weight.rate == 0) {
    under = over;
    return;
  }
  using Numbers = Rate<T>;
  const Numbers difference = numbers(over.value) - numbers(under.value), rate_difference = over.rate - under.rate;
  under.acceleration += weight.value * (over.acceleration - under.acceleration) + 2 * weight.rate * rate_difference +
                        weight.acceleration * difference;
  under.rate += weight.value * rate_difference + weight.rate * difference;
  if (weight.value == 1)
    under.value = over.value;
  else
    numbers(under.value) += weight.value * difference;
}

/// A node's color by a clip; tracks of single components lie over the color below, or over white.
Sample<Color> color_over(const BoundClip::Entry& entry, const ClipClock& clock, const Node& node,
                         const std::optional<Sample<Color>>& look) {
  if (entry.color) return per_stage_second(entry.color->sample(clock.time, clock.side), clock.rate);
  Sample<Color> over =
      look.value_or(Sample<Color>{node.color.value_or(Color{Vec4(1, 1, 1, 1)}), Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)});
  for (int i = 0; i < 4; ++i) {
    const Curve<double>* curve = entry.tints[static_cast<std::size_t>(i)];
    if (!curve) continue;
    const Sample<double> number = per_stage_second(curve->sample(clock.time, clock.side), clock.rate);
    over.value.rgba[i] = number.value;
    over.rate[i] = number.rate;
    over.acceleration[i] = number.acceleration;
  }
  return over;
}

void fade_color(const BoundClip::Entry& entry, const ClipClock& clock, const Sample<double>& weight, const Node& node,
                std::optional<Sample<Color>>& look) {
  const Sample<Color> over = color_over(entry, clock, node, look);
  if (!look && !node.color) {
    look = over;  // there is nothing to fade from
    return;
  }
  if (!look) look = Sample<Color>{*node.color, Vec4::Zero(), Vec4::Zero()};
  fade(*look, over, weight);
}

void fade_weights(const WeightCurves& curves, const ClipClock& clock, const Sample<double>& weight, const Node& node,
                  std::vector<Sample<double>>& look) {
  for (std::size_t i = look.size(); i < curves.size(); ++i)
    look.push_back({i < node.weights.size() ? node.weights[i] : 0, 0, 0});
  for (std::size_t i = 0; i < curves.size(); ++i)
    fade(look[i], per_stage_second(curves[i].sample(clock.time, clock.side), clock.rate), weight);
}

}  // namespace

void lay_look_over(const BoundClip::Entry& entry, const ClipClock& clock, bool yields, const Sample<double>& weight,
                   const Node& node, NodeLook& look) {
  if (entry.has_color() && (!yields || !look.color)) fade_color(entry, clock, weight, node, look.color);
  if (entry.weights && (!yields || look.weights.empty()))
    fade_weights(*entry.weights, clock, weight, node, look.weights);
}

}  // namespace tweenfall::pose
