#include <tweenfall/anim/track.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace tweenfall {

template <class T>
StepCurve<T>::StepCurve(std::vector<std::pair<double, T>> steps) : steps_(std::move(steps)) {
  if (steps_.empty()) throw std::invalid_argument("a step curve needs at least one step");
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (!std::isfinite(steps_[i].first))
      throw std::invalid_argument("the time of step " + std::to_string(i) + " is not finite");
    if (i > 0 && !(steps_[i].first > steps_[i - 1].first))
      throw std::invalid_argument("step times must increase; step " + std::to_string(i) + " at " +
                                  number_text(steps_[i].first) + " s is not after the one before it, " +
                                  number_text(steps_[i - 1].first) + " s");
  }
}

template <class T>
const T& StepCurve<T>::value(double time, Side side) const noexcept {
  // A curve that was moved from has no steps.
  static const T none{};
  if (steps_.empty()) return none;
  const auto later = [&](double t, const auto& step) { return side == Side::out ? t < step.first : t <= step.first; };
  const auto next = std::upper_bound(steps_.begin(), steps_.end(), time, later);
  return next == steps_.begin() ? steps_.front().second : std::prev(next)->second;
}

template class StepCurve<bool>;
template class StepCurve<std::string>;

Property property_named(std::string_view word) noexcept {
  if (word == "position") return Property::position;
  if (word == "rotation") return Property::rotation;
  if (word == "scale") return Property::scale;
  if (word == "color") return Property::color;
  if (word == "weights") return Property::weights;
  return Property::user;
}

namespace clips {
namespace {

using Extent = std::pair<double, double>;

template <class T>
Extent extent_of(const Curve<T>& curve) {
  return {curve.start(), curve.end()};
}
template <class T>
Extent extent_of(const StepCurve<T>& curve) {
  return {curve.steps().front().first, curve.steps().back().first};
}
Extent extent_of(const WeightCurves& curves) {
  if (curves.empty()) return {0, 0};
  Extent all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Curve<double>& curve : curves) {
    all.first = std::min(all.first, curve.start());
    all.second = std::max(all.second, curve.end());
  }
  return all;
}

}  // namespace
}  // namespace clips

std::pair<double, double> extent(const TrackCurve& curve) noexcept {
  return std::visit([](const auto& c) { return clips::extent_of(c); }, curve);
}

}  // namespace tweenfall
