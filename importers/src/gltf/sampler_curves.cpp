#include "sampler_curves.h"

#include <tweenfall/curves/keys.h>

#include <stdexcept>
#include <string>

namespace tweenfall::gltf {

namespace {

Quat quaternion(const double* parts) {
  return Quat(parts[3], parts[0], parts[1], parts[2]);
}

template <class T, class ReadPart>
Curve<T> curve_of(const Sampler& sampler, ReadPart read) {
  const Ease ease = sampler.interpolation == Interpolation::step ? Ease::hold() : Ease::linear();
  std::vector<Key<T>> keys;
  keys.reserve(sampler.times.size());
  for (std::size_t i = 0; i < sampler.times.size(); ++i) {
    Key<T> key{.time = sampler.times[i], .value = read(sampler.value(i))};
    if (sampler.interpolation == Interpolation::cubic) {
      if (i > 0) key.in = Tangent<T>{.kind = Tangent<T>::Kind::given, .rate = read(sampler.in(i))};
      if (i + 1 < sampler.times.size())
        key.out = Tangent<T>{.kind = Tangent<T>::Kind::given, .rate = read(sampler.out(i))};
    } else {
      key.ease = ease;
    }
    keys.push_back(std::move(key));
  }
  return keyed_curve<T>(std::span<const Key<T>>(keys));
}

/// CUBICSPLINE rotations mix the four parts as plain numbers and scale the result to unit length.
/// Source: glTF 2.0 specification, appendix C.5.
Curve<Quat> cubic_rotation(const Sampler& sampler) {
  const auto vector = [](const double* parts) { return Vec4(parts[0], parts[1], parts[2], parts[3]); };
  for (std::size_t i = 0; i < sampler.times.size(); ++i)
    if (vector(sampler.value(i)).norm() < 1e-6)
      throw std::invalid_argument("key " + std::to_string(i) + " is a zero quaternion");
  if (sampler.times.size() == 1) return Curve<Quat>(normalized(quaternion(sampler.value(0))));
  std::vector<RotationSpan> spans;
  for (std::size_t i = 0; i + 1 < sampler.times.size(); ++i) {
    RotationSpan span;
    span.start = sampler.times[i];
    span.duration = sampler.times[i + 1] - sampler.times[i];
    span.form = RotationSpan::Form::normalized;
    span.degree = 3;
    const Vec4 from = vector(sampler.value(i)), to = vector(sampler.value(i + 1));
    const Vec4 leave = span.duration * vector(sampler.out(i)), arrive = span.duration * vector(sampler.in(i + 1));
    span.coefficients.fill(Vec4(0, 0, 0, 0));
    span.coefficients[0] = from;
    span.coefficients[1] = leave;
    span.coefficients[2] = 3 * (to - from) - 2 * leave - arrive;
    span.coefficients[3] = 2 * (from - to) + leave + arrive;
    span.from = normalized(quaternion(sampler.value(i)));
    span.end = normalized(quaternion(sampler.value(i + 1)));
    spans.push_back(span);
  }
  return Curve<Quat>(std::span<const RotationSpan>(spans));
}

}  // namespace

Curve<Vec3> vector_curve(const Sampler& sampler) {
  return curve_of<Vec3>(sampler, [](const double* parts) { return Vec3(parts[0], parts[1], parts[2]); });
}

Curve<Quat> rotation_curve(const Sampler& sampler) {
  if (sampler.interpolation == Interpolation::cubic) return cubic_rotation(sampler);
  std::vector<Key<Quat>> keys;
  const Ease ease = sampler.interpolation == Interpolation::step ? Ease::hold() : Ease::linear();
  for (std::size_t i = 0; i < sampler.times.size(); ++i)
    keys.push_back({.time = sampler.times[i], .value = quaternion(sampler.value(i)), .ease = ease});
  return keyed_curve<Quat>(std::span<const Key<Quat>>(keys));
}

WeightCurves weight_curves(const Sampler& sampler) {
  WeightCurves curves;
  for (std::size_t target = 0; target < sampler.width; ++target)
    curves.push_back(curve_of<double>(sampler, [target](const double* parts) { return parts[target]; }));
  return curves;
}

}  // namespace tweenfall::gltf
