#include <tweenfall/curves/rotation.h>

#include "bezier_span.h"
#include "curve_data.h"
#include "key_check.h"
#include "keys_converted.h"
#include "span_slopes.h"

namespace tweenfall {
namespace {

Quat unit(std::span<const Key<Quat>> keys, std::size_t i, const Quat& value) {
  try {
    return normalized(value);
  } catch (const std::invalid_argument& error) {
    refuse_key(keys, i, std::string("is no rotation: ") + error.what());
  }
}

// One stretch between two keys: `way` is the rotation vector that leads from one to the other, in the axes
// of the first, which are those of the second too where the way turns about itself.
struct Stretch {
  Quat from, to;
  Vec3 way;
};

Vec3 way_between(const Quat& from, const Quat& to, bool long_way) {
  const Vec3 way = log_map(from.conjugate() * to);
  const double angle = std::sqrt(way.squaredNorm());
  if (!long_way || angle == 0) return way;
  constexpr double turn = 0x1.921fb54442d18p+2;
  return (1 - turn / angle) * way;
}

std::vector<Stretch> stretches_of(std::span<const Key<Quat>> keys, bool long_way) {
  std::vector<Stretch> result;
  Quat from = unit(keys, 0, keys[0].value);
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    const Key<Quat>& next = keys[i + 1];
    const Quat value = unit(keys, i + 1, next.value);
    const Quat to = next.value_in ? unit(keys, i + 1, *next.value_in) : value;
    const Vec3 way = way_between(from, to, long_way);
    // The sign that is reached by turning, so that components stay continuous.
    const Quat arrived = hemisphere_aligned(to, from * exp_map(way));
    result.push_back({from, arrived, way});
    from = next.value_in ? hemisphere_aligned(value, arrived) : arrived;
  }
  return result;
}

Vec4 padded(const Vec3& v) {
  return Vec4(v.x(), v.y(), v.z(), 0);
}

RotationSpan blank(const Stretch& stretch, double start, double end) {
  RotationSpan span{};
  span.start = start;
  span.duration = end - start;
  span.from = stretch.from;
  span.end = stretch.to;
  for (Vec4& c : span.coefficients) c.setZero();
  return span;
}

// The angular velocity that a side states or its rule chose, in world axes; the rule's and the straight way's are in
// the axes of the key's own rotation.
Vec3 angular_slope(const std::optional<Tangent<Quat>>& tangent, const Quat& rotation, const Vec3& chosen,
                   const Vec3& straight) {
  const TangentKind kind = tangent ? tangent->kind : TangentKind::automatic;
  if (kind == TangentKind::given) return tangent->rate;
  if (kind == TangentKind::flat) return Vec3::Zero();
  return rotation * (kind == TangentKind::vector ? straight : chosen);
}

void append_shape(std::vector<RotationSpan>& spans, const Key<Quat>& from, double end, const Stretch& stretch) {
  const double duration = end - from.time;
  const std::vector<Ease::Piece> pieces = from.ease.pieces_for(duration);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ease::Piece& piece = pieces[i];
    const double start = i == 0 ? from.time : from.time + piece.start * duration;
    const double stop = i + 1 < pieces.size() ? from.time + pieces[i + 1].start * duration : end;
    if (!(stop > start)) continue;
    RotationSpan span = blank(stretch, start, stop);
    span.degree = piece.degree;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(piece.degree); ++k)
      span.coefficients[k] = padded(piece.coefficients[k] * stretch.way);
    if (piece.end != 1) span.end = stretch.from * exp_map(piece.end * stretch.way);
    span.warp = piece.warp;
    spans.push_back(span);
  }
}

}  // namespace

Curve<Quat> rotation_curve(std::span<const Key<Quat>> keys, const KeyOptions& options) {
  if (keys.size() == 1) return CurveAccess::one_key(unit(keys, 0, keys[0].value), keys[0].time);
  const std::vector<Stretch> stretches = stretches_of(keys, options.long_way);
  SlopeRequest request{3, {}, {}, options.ends, {}, {}};
  for (const Key<Quat>& key : keys) request.eases.push_back(&key.ease);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const double duration = keys[i + 1].time - keys[i].time;
    request.durations.push_back(duration);
    for (int c = 0; c < 3; ++c) request.secants.push_back(stretches[i].way[c] / duration);
    request.span_eases.push_back(plan_span(keys[i].ease, keys[i].out || keys[i + 1].in).slopes);
  }
  const Slopes slopes = choose_slopes(request);

  std::vector<RotationSpan> spans;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Key<Quat>&a = keys[i], &b = keys[i + 1];
    const Stretch& s = stretches[i];
    const SpanKind kind = plan_span(a.ease, a.out || b.in).kind;
    if (kind == SpanKind::shape) {
      append_shape(spans, a, b.time, s);
      continue;
    }
    RotationSpan span = blank(s, a.time, b.time);
    if (kind == SpanKind::hold) {
      span.end = s.from;
    } else if (kind == SpanKind::linear) {
      span.degree = 1;
      span.coefficients[1] = padded(s.way);
    } else {
      // Slopes are angular velocities in the axes of the key's own rotation.
      const Vec3 straight = (1 / span.duration) * s.way;
      const Vec3 leaving = s.from.conjugate() * angular_slope(a.out, s.from, Vec3(&slopes.leaving[3 * i]), straight);
      const Vec3 arriving = s.to.conjugate() * angular_slope(b.in, s.to, Vec3(&slopes.arriving[3 * i]), straight);
      const Vec4 d0 = padded(span.duration * leaving);
      const Vec4 d1 = padded(right_jacobian_inverse(s.way) * Vec3(span.duration * arriving));
      const Vec4 from = Vec4::Zero(), change = padded(s.way);
      constexpr double third = 1.0 / 3;
      const double w0 = a.out ? a.out->weight : third, w1 = b.in ? b.in->weight : third;
      span.degree = 3;
      if (w0 == third && w1 == third)
        cubic_coefficients(from, change, d0, d1, span.coefficients.data());
      else
        fill_bezier(span, from, change, Vec4(w0 * d0), Vec4(w1 * d1), {w0, w1}, options.overlong);
    }
    spans.push_back(span);
  }
  const Quat final = hemisphere_aligned(unit(keys, keys.size() - 1, keys.back().value), stretches.back().to);
  return CurveAccess::from_spans<Quat>(spans, keys.back().time, &final);
}

}  // namespace tweenfall
