#include <tweenfall/curves/elementary.h>

#include "keys/key_check.h"
#include "keys/key_pins.h"
#include "keys/keys_converted.h"

namespace tweenfall::keying {
namespace {

template <class T>
Sample<T> exponential(const Sample<T>& s) noexcept {
  Sample<T> result = s;
  for (int c = 0; c < spans::dimensions<T>; ++c) {
    const double value = elementary::exp(spans::component(s.value, c));
    const double rate = spans::component(s.rate, c);
    spans::component_of(result.value, c) = value;
    spans::component_of(result.rate, c) = value * rate;
    spans::component_of(result.acceleration, c) = value * (spans::component(s.acceleration, c) + rate * rate);
  }
  return result;
}

template <class T>
T logarithm(std::span<const Key<T>> keys, std::size_t i, const T& value) {
  T result = value;
  for (int c = 0; c < spans::dimensions<T>; ++c) {
    if (!(spans::component(value, c) > 0))
      refuse_key(keys, i,
                 "is mixed by ratio, so every value must be > 0; one is " + spans::text_of(spans::component(value, c)));
    spans::component_of(result, c) = elementary::log(spans::component(value, c));
  }
  return result;
}

// A slope of the value, divided by the value, is the slope of its logarithm.
template <class T>
void make_relative(std::optional<Tangent<T>>& tangent, const T& value) {
  if (!tangent) return;
  for (int c = 0; c < spans::dimensions<T>; ++c) spans::component_of(tangent->rate, c) /= spans::component(value, c);
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

template <class T>
Curve<T> keying::logarithmic_curve(std::span<const Key<T>> keys, const KeyOptions& options) {
  std::vector<Key<T>> logs(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    logs[i].value = keying::logarithm(keys, i, keys[i].value);
    if (keys[i].value_in) logs[i].value_in = keying::logarithm(keys, i, *keys[i].value_in);
    keying::make_relative(logs[i].out, keys[i].value);
    keying::make_relative(logs[i].in, keys[i].value_in ? *keys[i].value_in : keys[i].value);
  }
  KeyOptions inner = options;
  inner.logarithmic = false;
  return keying::seen_through_keys<T>(keyed_curve<T>(std::span<const Key<T>>(logs), inner),
                                      std::make_shared<const keying::KeyPins<T>>(keys), &keying::exponential<T>);
}

template Curve<double> keying::logarithmic_curve<double>(std::span<const Key<double>>, const KeyOptions&);
template Curve<Vec2> keying::logarithmic_curve<Vec2>(std::span<const Key<Vec2>>, const KeyOptions&);
template Curve<Vec3> keying::logarithmic_curve<Vec3>(std::span<const Key<Vec3>>, const KeyOptions&);
template Curve<Vec4> keying::logarithmic_curve<Vec4>(std::span<const Key<Vec4>>, const KeyOptions&);

}  // namespace tweenfall
