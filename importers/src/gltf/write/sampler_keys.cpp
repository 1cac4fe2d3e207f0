#include "gltf/write/sampler_keys.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace tweenfall::gltf {

namespace {

enum class Form { constant, step, linear, cubic, other };

/// Value and rate of some curves side by side, as flat numbers.
struct Flat {
  std::vector<double> value, rate;
};

/// A curve, or several with the same knots, as flat numbers.
struct FlatCurve {
  Form form = Form::other;
  std::vector<double> knots;
  std::size_t parts = 3;
  std::function<Flat(double, Side)> at;
  bool rotation = false;
};

Flat flat(const Sample<double>& s) {
  return {{s.value}, {s.rate}};
}
Flat flat(const Sample<Vec3>& s) {
  return {{s.value[0], s.value[1], s.value[2]}, {s.rate[0], s.rate[1], s.rate[2]}};
}
Flat flat(const Quat& q) {
  return {{q.x(), q.y(), q.z(), q.w()}, {0, 0, 0, 0}};
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > 1e-9 * std::max(1.0, std::abs(b[i]))) return false;
  return true;
}

bool continuous(const FlatCurve& curve) {
  for (std::size_t i = 1; i + 1 < curve.knots.size(); ++i)
    if (!same(curve.at(curve.knots[i], Side::in).value, curve.at(curve.knots[i], Side::out).value)) return false;
  return true;
}

template <class T>
Form form_of_spans(const Curve<T>& curve) {
  if (curve.before() != Outside::hold || curve.after() != Outside::hold) return Form::other;
  const auto spans = curve.spans();
  if (spans.empty()) return curve.start() == 0 && curve.end() == 0 ? Form::constant : Form::other;
  int least = max_degree, most = 0;
  for (const auto& span : spans) {
    if (span.warp.function && span.degree > 0) return Form::other;
    least = std::min(least, span.degree);
    most = std::max(most, span.degree);
  }
  if (most == 0) return Form::step;
  if (most == 1) return Form::linear;
  return most <= 3 ? Form::cubic : Form::other;
}

/// glTF's LINEAR is only a constant turn of at most half a circle, and its CUBICSPLINE only a cubic of the four
/// parts.
Form form_of_spans(const Curve<Quat>& curve) {
  for (const RotationSpan& span : curve.spans())
    if (span.form == RotationSpan::Form::nested) return Form::other;
  const Form form = form_of_spans<Quat>(curve);
  if (form == Form::constant || form == Form::step || form == Form::other) return form;
  bool turns = true, cubics = true;
  for (const RotationSpan& span : curve.spans()) {
    const bool exponential = span.form == RotationSpan::Form::exponential;
    turns = turns && exponential && span.degree <= 1 && span.spin.isZero(0) &&
            span.coefficients[0].head<3>().isZero(0) &&
            (span.degree == 0 || span.coefficients[1].head<3>().norm() <= 3.1415926);
    cubics = cubics && span.form == RotationSpan::Form::normalized && span.degree <= 3 && span.spin.isZero(0);
  }
  return turns ? Form::linear : cubics ? Form::cubic : Form::other;
}

template <class T>
FlatCurve flat_curve(const Curve<T>& curve) {
  FlatCurve result;
  result.form = form_of_spans(curve);
  result.knots.assign(curve.knots().begin(), curve.knots().end());
  result.at = [curve](double time, Side side) { return flat(curve.sample(time, side)); };
  return result;
}

/// The polynomial's own four parts and their derivatives: a CUBICSPLINE stores them without scaling to unit length.
Flat raw_parts(const RotationSpan& span, double s) {
  Vec4 value(0, 0, 0, 0), slope(0, 0, 0, 0);
  for (int i = span.degree; i >= 0; --i) {
    slope = slope * s + value;
    value = value * s + span.coefficients[static_cast<std::size_t>(i)];
  }
  slope /= span.duration;
  return {{value[0], value[1], value[2], value[3]}, {slope[0], slope[1], slope[2], slope[3]}};
}

FlatCurve flat_curve(const Curve<Quat>& curve) {
  FlatCurve result;
  result.form = form_of_spans(curve);
  result.parts = 4;
  result.rotation = true;
  result.knots.assign(curve.knots().begin(), curve.knots().end());
  if (result.form != Form::cubic) {
    result.at = [curve](double time, Side side) { return flat(curve.value(time, side)); };
    return result;
  }
  result.at = [curve, spans = curve.spans()](double time, Side side) {
    std::size_t index = 0;
    while (index + 1 < spans.size() &&
           (side == Side::out ? spans[index + 1].start <= time : spans[index + 1].start < time))
      ++index;
    return raw_parts(spans[index], std::clamp((time - spans[index].start) / spans[index].duration, 0.0, 1.0));
  };
  return result;
}

FlatCurve flat_curve(const WeightCurves& curves) {
  FlatCurve result;
  result.parts = curves.size();
  bool first = true;
  for (const Curve<double>& curve : curves) {
    const FlatCurve one = flat_curve(curve);
    if (first) {
      result.form = one.form;
      result.knots = one.knots;
    } else if (one.form != result.form || one.knots != result.knots) {
      result.form = Form::other;
      result.knots.insert(result.knots.end(), one.knots.begin(), one.knots.end());
    }
    first = false;
  }
  std::sort(result.knots.begin(), result.knots.end());
  result.knots.erase(std::unique(result.knots.begin(), result.knots.end()), result.knots.end());
  result.at = [curves](double time, Side side) {
    Flat all;
    for (const Curve<double>& curve : curves) {
      const Sample<double> sample = curve.sample(time, side);
      all.value.push_back(sample.value);
      all.rate.push_back(sample.rate);
    }
    return all;
  };
  return result;
}

/// The same curve composed with the node's rest value, for `Track::relative`; never in a form that glTF has.
FlatCurve over_rest(FlatCurve curve, Property property, const Pose& rest) {
  curve.form = Form::other;
  curve.at = [inner = std::move(curve.at), property, rest](double time, Side side) {
    Flat result = inner(time, side);
    if (property == Property::rotation) {
      const auto& v = result.value;
      return flat(Quat(rest.rotation * Quat(v[3], v[0], v[1], v[2])));
    }
    Vec3 value(result.value[0], result.value[1], result.value[2]);
    value = rest.scale.cwiseProduct(value);
    if (property == Property::position) value = rest.position + rest.rotation * value;
    result.value = {value[0], value[1], value[2]};
    return result;
  };
  return curve;
}

/// Appends keys and keeps their times distinct as 32-bit floats, in which glTF stores them.
class KeyList {
 public:
  explicit KeyList(const FlatCurve& curve) : curve_(curve) { keys_.parts = curve.parts; }

  void add(double time, const Flat& in, Flat value, const Flat& out) {
    const float stored = static_cast<float>(std::max(time, 0.0));
    if (!keys_.times.empty() && stored <= static_cast<float>(keys_.times.back())) return;
    if (curve_.rotation && !cubic) align(value.value);
    keys_.times.push_back(static_cast<double>(stored));
    if (cubic) append(in.rate);
    append(value.value);
    if (cubic) append(out.rate);
  }
  void add(double time, const Flat& value) { add(time, value, value, value); }

  bool cubic = false;
  SamplerKeys finish(const char* interpolation) {
    keys_.interpolation = interpolation;
    return std::move(keys_);
  }

 private:
  void append(const std::vector<double>& numbers) {
    keys_.outputs.insert(keys_.outputs.end(), numbers.begin(), numbers.end());
  }
  /// A quaternion and its opposite are the same rotation, but other programs interpolate the numbers as given.
  void align(std::vector<double>& parts) {
    double square = 0, toward_last = last_.empty() ? 1 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
      square += parts[i] * parts[i];
      if (!last_.empty()) toward_last += last_[i] * parts[i];
    }
    const double factor = (toward_last < 0 ? -1 : 1) / std::sqrt(square);
    for (double& part : parts) part *= factor;
    last_ = parts;
  }

  const FlatCurve& curve_;
  SamplerKeys keys_;
  std::vector<double> last_;
};

SamplerKeys own_keys(const FlatCurve& curve, double duration) {
  KeyList list(curve);
  list.cubic = curve.form == Form::cubic;
  const double last = curve.knots.back();
  for (const double knot : curve.knots) {
    Flat in = curve.at(knot, Side::in), out = curve.at(knot, Side::out);
    if (knot == curve.knots.front()) in.rate.assign(in.rate.size(), 0);
    // The tangent leaving the last key is only used where the curve holds until the clip's end.
    if (knot == last) out.rate.assign(out.rate.size(), 0);
    const Flat value = knot == last && list.cubic ? in : out;
    list.add(knot, in, value, out);
  }
  if (duration > last) {
    Flat held = curve.at(last, list.cubic ? Side::in : Side::out);
    held.rate.assign(held.rate.size(), 0);
    list.add(duration, held);
  }
  const char* words[] = {"STEP", "STEP", "LINEAR", "CUBICSPLINE", "LINEAR"};
  return list.finish(words[static_cast<int>(curve.form)]);
}

SamplerKeys baked_keys(const FlatCurve& curve, double duration, double fps) {
  constexpr double most_keys = 1e7;
  if (!(duration * fps <= most_keys))
    throw std::runtime_error("a clip without end, or of more than ten million frames, cannot be written; it lasts " +
                             number_text(duration) + " s");
  std::vector<double> times;
  for (std::size_t frame = 0; static_cast<double>(frame) / fps < duration; ++frame)
    times.push_back(static_cast<double>(frame) / fps);
  times.push_back(duration);
  for (const double knot : curve.knots)
    if (knot > 0 && knot < duration) times.push_back(knot);
  std::sort(times.begin(), times.end());
  KeyList list(curve);
  for (const double time : times) {
    const Flat in = curve.at(time, Side::in), out = curve.at(time, Side::out);
    // Linear keys can only jump between two times: the last float before the jump has the arriving value.
    if (time > 0 && !same(in.value, out.value))
      list.add(static_cast<double>(std::nextafter(static_cast<float>(time), 0.0f)), in);
    list.add(time, time < duration ? out : in);
  }
  return list.finish("LINEAR");
}

SamplerKeys constant_keys(const FlatCurve& curve, double duration) {
  KeyList list(curve);
  list.add(0, curve.at(0, Side::out));
  if (duration > 0) list.add(duration, curve.at(0, Side::out));
  return list.finish("STEP");
}

SamplerKeys keys_of(const FlatCurve& curve, double duration, double fps) {
  if (curve.form == Form::constant) return constant_keys(curve, std::isfinite(duration) ? duration : 0);
  const bool own = curve.form != Form::other && curve.knots.front() >= 0 && curve.knots.back() <= duration &&
                   std::isfinite(duration) && (curve.form == Form::step || continuous(curve));
  return own ? own_keys(curve, duration) : baked_keys(curve, duration, fps);
}

}  // namespace

SamplerKeys sampler_keys(const Clip& clip, const Track& track, const Pose& rest, double fps) {
  const Property property = property_named(track.property);
  FlatCurve curve;
  if (property == Property::weights && std::holds_alternative<WeightCurves>(track.curve))
    curve = flat_curve(std::get<WeightCurves>(track.curve));
  else if (property == Property::rotation && std::holds_alternative<Curve<Quat>>(track.curve))
    curve = flat_curve(std::get<Curve<Quat>>(track.curve));
  else if ((property == Property::position || property == Property::scale) &&
           std::holds_alternative<Curve<Vec3>>(track.curve))
    curve = flat_curve(std::get<Curve<Vec3>>(track.curve));
  else
    return {};
  if (curve.parts == 0) return {};
  if (track.relative && property != Property::weights) curve = over_rest(std::move(curve), property, rest);
  return keys_of(curve, clip.duration, fps);
}

}  // namespace tweenfall::gltf
