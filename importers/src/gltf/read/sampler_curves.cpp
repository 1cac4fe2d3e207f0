#include "gltf/read/sampler_curves.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/quaternion_cubic.h>

#include <type_traits>

namespace tweenfall::gltf {

namespace {

Quat quaternion(const double* parts) {
  return Quat(parts[3], parts[0], parts[1], parts[2]);
}

/// Values that hold until the next key. The last one applies at its own time, where the curve ends.
template <class T>
Curve<T> step_curve(const std::vector<double>& times, const std::vector<T>& values) {
  if (times.size() == 1) return Curve<T>(values[0]);
  std::vector<typename SpanOf<T>::type> spans(times.size() - 1);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    auto& span = spans[i];
    span.start = times[i];
    span.duration = times[i + 1] - times[i];
    span.degree = 0;
    if constexpr (std::is_same_v<T, Quat>) {
      span.coefficients.fill(Vec4(0, 0, 0, 0));
      span.from = values[i];
    } else {
      span.coefficients.fill(values[i]);
    }
    span.end = i + 1 < spans.size() ? values[i] : values[i + 1];
  }
  return Curve<T>(std::span<const typename SpanOf<T>::type>(spans));
}

template <class T, class ReadPart>
Curve<T> curve_of(const Sampler& sampler, ReadPart read) {
  if (sampler.interpolation == Interpolation::step) {
    std::vector<T> values;
    for (std::size_t i = 0; i < sampler.times.size(); ++i) values.push_back(read(sampler.value(i)));
    return step_curve<T>(sampler.times, values);
  }
  const Ease straight = Ease::linear();
  std::vector<Key<T>> keys;
  keys.reserve(sampler.times.size());
  for (std::size_t i = 0; i < sampler.times.size(); ++i) {
    Key<T> key{.time = sampler.times[i], .value = read(sampler.value(i))};
    if (sampler.interpolation == Interpolation::cubic) {
      if (i > 0) key.in = Tangent<T>{.kind = Tangent<T>::Kind::given, .rate = read(sampler.in(i))};
      if (i + 1 < sampler.times.size())
        key.out = Tangent<T>{.kind = Tangent<T>::Kind::given, .rate = read(sampler.out(i))};
    } else {
      key.ease = straight;
    }
    keys.push_back(std::move(key));
  }
  return keyed_curve<T>(std::span<const Key<T>>(keys));
}

Curve<Quat> curve_of_turns(const Sampler& sampler) {
  const Ease straight = Ease::linear();
  std::vector<Key<Quat>> keys;
  for (std::size_t i = 0; i < sampler.times.size(); ++i)
    keys.push_back({.time = sampler.times[i], .value = quaternion(sampler.value(i)), .ease = straight});
  return keyed_curve<Quat>(std::span<const Key<Quat>>(keys));
}

Curve<Quat> cubic_rotation(const Sampler& sampler) {
  const auto vector = [](const double* parts) { return Vec4(parts[0], parts[1], parts[2], parts[3]); };
  std::vector<Vec4> in, values, out;
  for (std::size_t i = 0; i < sampler.times.size(); ++i) {
    in.push_back(vector(sampler.in(i)));
    values.push_back(vector(sampler.value(i)));
    out.push_back(vector(sampler.out(i)));
  }
  return gltf_cubic_rotation(sampler.times, in, values, out);
}

}  // namespace

Curve<Vec3> vector_curve(const Sampler& sampler) {
  return curve_of<Vec3>(sampler, [](const double* parts) { return Vec3(parts[0], parts[1], parts[2]); });
}

Curve<Quat> rotation_curve(const Sampler& sampler) {
  if (sampler.interpolation == Interpolation::cubic) return cubic_rotation(sampler);
  if (sampler.interpolation == Interpolation::step) {
    std::vector<Quat> values;
    for (std::size_t i = 0; i < sampler.times.size(); ++i) values.push_back(normalized(quaternion(sampler.value(i))));
    return step_curve<Quat>(sampler.times, values);
  }
  return curve_of_turns(sampler);
}

WeightCurves weight_curves(const Sampler& sampler) {
  WeightCurves curves;
  for (std::size_t target = 0; target < sampler.width; ++target)
    curves.push_back(curve_of<double>(sampler, [target](const double* parts) { return parts[target]; }));
  return curves;
}

}  // namespace tweenfall::gltf
