#include <tweenfall/curves/quaternion_cubic.h>

#include <stdexcept>

#include "curve/curve_data.h"
#include "curve/hermite_coefficients.h"

namespace tweenfall {

Curve<Quat> gltf_cubic_rotation(std::span<const double> times, std::span<const Vec4> in_tangents,
                                std::span<const Vec4> values, std::span<const Vec4> out_tangents) {
  const std::size_t n = times.size();
  if (n == 0) throw std::invalid_argument("a curve needs at least one key; none were given");
  if (in_tangents.size() != n || values.size() != n || out_tangents.size() != n)
    throw std::invalid_argument("a cubic needs a time, a value and two tangents per key; there are " +
                                std::to_string(n) + " times, " + std::to_string(values.size()) + " values, " +
                                std::to_string(in_tangents.size()) + " arriving and " +
                                std::to_string(out_tangents.size()) + " leaving tangents");
  std::vector<Quat> units;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string key = "key " + std::to_string(i) + " (time " + spans::text_of(times[i]) + " s, value " +
                            spans::text_of(values[i]) + ") ";
    if (!std::isfinite(times[i])) throw std::invalid_argument(key + "must have a finite time");
    if (i > 0 && !(times[i] > times[i - 1]))
      throw std::invalid_argument(key + "must come after the key before it, at " + spans::text_of(times[i - 1]) + " s");
    if (!spans::all_finite(in_tangents[i]) || !spans::all_finite(out_tangents[i]))
      throw std::invalid_argument(key + "has a non-finite tangent");
    const Vec4& v = values[i];
    if (!spans::all_finite(v) || v.cwiseAbs().maxCoeff() == 0)
      throw std::invalid_argument(key + "must be finite and not zero to be a rotation");
    units.push_back(normalized(Quat(v[3], v[0], v[1], v[2])));
  }
  if (n == 1) return CurveAccess::one_key(units[0], times[0]);
  std::vector<RotationSpan> spans;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    RotationSpan span{};
    span.start = times[i];
    span.duration = times[i + 1] - times[i];
    span.form = RotationSpan::Form::normalized;
    span.degree = 3;
    const Vec4 change = values[i + 1] - values[i];
    const Vec4 d0 = span.duration * out_tangents[i], d1 = span.duration * in_tangents[i + 1];
    spans::cubic_coefficients(values[i], change, d0, d1, span.coefficients.data());
    span.end = units[i + 1];
    spans.push_back(span);
  }
  return CurveAccess::from_spans<Quat>(spans, times.back());
}

}  // namespace tweenfall
