#pragma once

// The exact values at the keys, for curves computed through a conversion that would round them.

#include <tweenfall/curves/keys.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "curve/curve_data.h"
#include "curve/extrapolation.h"

namespace tweenfall::keying {

template <class T>
class KeyPins {
 public:
  explicit KeyPins(std::span<const Key<T>> keys) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Key<T>& key = keys[i];
      times_.push_back(key.time);
      leaving_.push_back(key.value);
      const bool held = i > 0 && keys[i - 1].ease.rule() == Ease::Rule::hold && !keys[i - 1].out && !key.in;
      // A shape may arrive short of the next value; then there is nothing to pin.
      const bool short_of =
          i > 0 && keys[i - 1].ease.rule() == Ease::Rule::shape && keys[i - 1].ease.pieces().back().end != 1;
      // A stepped shape may also leave its key at once.
      const bool jumps = key.ease.rule() == Ease::Rule::shape && key.ease.progress(0).value != 0 && i + 1 < keys.size();
      arrives_.push_back(!short_of);
      leaves_.push_back(!jumps);
      arriving_.push_back(held ? keys[i - 1].value : key.value_in ? *key.value_in : key.value);
    }
  }

  /// The exact value where `time` is that of a key, else null. Beyond an end at which the curve holds, the end's value.
  [[nodiscard]] const T* at(double time, Side side, Outside before, Outside after) const noexcept {
    if (time < times_.front()) return before == Outside::hold ? &leaving_.front() : nullptr;
    if (time > times_.back()) return after == Outside::hold ? &leaving_.back() : nullptr;
    const auto found = std::lower_bound(times_.begin(), times_.end(), time);
    if (*found != time) return nullptr;
    const std::size_t i = static_cast<std::size_t>(found - times_.begin());
    if (i == 0 && side == Side::in && times_.size() > 1) return spans::loops(before) ? nullptr : &leaving_[0];
    if (i + 1 == times_.size() && i > 0) {
      if (side == Side::out && spans::loops(after)) return nullptr;
      if (side == Side::out) return &leaving_[i];
    }
    if (side == Side::in && i > 0) return arrives_[i] ? &arriving_[i] : nullptr;
    return leaves_[i] ? &leaving_[i] : nullptr;
  }

 private:
  std::vector<double> times_;
  std::vector<T> leaving_, arriving_;
  std::vector<bool> arrives_, leaves_;
};

/// The curve of `convert(sample of inner)`, exact at the keys.
template <class T, class Inner, class Convert>
[[nodiscard]] Curve<T> seen_through_keys(const Curve<Inner>& inner, std::shared_ptr<const KeyPins<T>> pins,
                                         const Convert& convert) {
  return CurveAccess::converted<T>(inner, [pins, convert](const Curve<Inner>& curve, double time, Side side) {
    Sample<T> s = convert(curve.sample(time, side));
    if (const T* exact = pins->at(time, side, curve.before(), curve.after())) s.value = *exact;
    return s;
  });
}

}  // namespace tweenfall::keying
