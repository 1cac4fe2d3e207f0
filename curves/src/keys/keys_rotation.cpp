#include <tweenfall/curves/rotation.h>

#include "curve/bezier_span.h"
#include "curve/curve_data.h"
#include "curve/hermite_coefficients.h"
#include "keys/key_check.h"
#include "keys/keys_converted.h"
#include "keys/span_slopes.h"
#include "turns/turn_rule.h"

namespace tweenfall::keying {
namespace {

constexpr double whole_turn = 0x1.921fb54442d18p+2;

Quat unit(std::span<const Key<Quat>> keys, std::size_t i, const Quat& value) {
  try {
    return normalized(value);
  } catch (const std::invalid_argument& error) {
    refuse_key(keys, i, std::string("is not a rotation: ") + error.what());
  }
}

void check_turn(std::span<const Key<Quat>> keys, std::size_t i) {
  const Turn& turn = keys[i].turn;
  if (!spans::all_finite(turn.axis))
    refuse_key(keys, i, "turns about the non-finite axis " + spans::text_of(turn.axis));
  if (turn.way == Turn::Way::along && turn.axis.isZero(0))
    refuse_key(keys, i, "turns along an axis, so the axis must not be zero");
}

// The short way and the additional whole turns, in the axes of `from`.
struct Way {
  Vec3 shorter, spin;
};

Way way_of(std::span<const Key<Quat>> keys, std::size_t i, const Quat& from, const Quat& to, bool long_way) {
  const Turn& turn = keys[i].turn;
  const Vec3 shorter = log_map(from.conjugate() * to);
  Vec3 direction = shorter;
  double turns = turn.whole_turns;
  if (shorter.isZero(0)) {
    // Between equal rotations the direction is undefined, and without one there is no long way around.
    if (turn.whole_turns == 0) return {shorter, Vec3(0, 0, 0)};
    if (turn.axis.isZero(0))
      refuse_key(keys, i, "makes whole turns to an equal rotation, so it needs an axis to turn about");
    direction = from.conjugate() * turn.axis;
  } else {
    const bool other_way = turn.way == Turn::Way::along ? shorter.dot(from.conjugate() * turn.axis) < 0
                                                        : turn.way == Turn::Way::longer || (long_way && turn == Turn{});
    if (other_way) turns = -turns - 1;
  }
  if (turns == 0) return {shorter, Vec3(0, 0, 0)};
  direction /= direction.cwiseAbs().maxCoeff();
  return {shorter, turns * whole_turn / std::sqrt(direction.squaredNorm()) * direction};
}

std::vector<turns::Stretch> stretches_of(std::span<const Key<Quat>> keys, bool long_way) {
  std::vector<turns::Stretch> result;
  Quat from = unit(keys, 0, keys[0].value);
  check_turn(keys, keys.size() - 1);
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    check_turn(keys, i);
    const Key<Quat>& next = keys[i + 1];
    const Quat value = unit(keys, i + 1, next.value);
    const Quat to = next.value_in ? unit(keys, i + 1, *next.value_in) : value;
    const Way way = way_of(keys, i, from, to, long_way);
    // With the sign that turning arrives at, so that components stay continuous.
    const Quat arrived = hemisphere_aligned(to, from * exp_map(way.shorter + way.spin));
    result.push_back({keys[i].time, next.time - keys[i].time, from, arrived, way.shorter, way.spin});
    from = next.value_in ? hemisphere_aligned(value, arrived) : arrived;
  }
  return result;
}

Slopes slopes_of(std::span<const Key<Quat>> keys, const std::vector<turns::Stretch>& stretches, Ends ends) {
  SlopeRequest request{3, {}, {}, ends, {}, {}};
  for (const Key<Quat>& key : keys) request.eases.push_back(&key.ease);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const turns::Stretch& s = stretches[i];
    request.durations.push_back(s.duration);
    for (int c = 0; c < 3; ++c) request.secants.push_back((s.way[c] + s.spin[c]) / s.duration);
    request.span_eases.push_back(plan_span(keys[i].ease, keys[i].out || keys[i + 1].in).slopes);
  }
  return choose_slopes(request);
}

// A turn at constant speed, or through the pieces of a shape: the whole way is one polynomial times a vector.
void append_shape(std::vector<RotationSpan>& spans, const Key<Quat>& from, const turns::Stretch& stretch) {
  const double end = stretch.start + stretch.duration;
  const Vec3 way = stretch.way + stretch.spin;
  const std::vector<Ease::Piece> pieces = from.ease.pieces_for(stretch.duration);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Ease::Piece& piece = pieces[i];
    const double start = i == 0 ? stretch.start : stretch.start + piece.start * stretch.duration;
    const double stop = i + 1 < pieces.size() ? stretch.start + pieces[i + 1].start * stretch.duration : end;
    if (!(stop > start)) continue;
    RotationSpan span = turns::blank_span(stretch);
    span.start = start;
    span.duration = stop - start;
    span.spin = {0, 0, 0};
    span.degree = piece.degree;
    for (std::size_t k = 0; k <= static_cast<std::size_t>(piece.degree); ++k)
      span.coefficients[k] = turns::padded(piece.coefficients[k] * way);
    if (piece.end != 1) span.end = stretch.from * exp_map(piece.end * way);
    span.warp = piece.warp;
    span.starts_at_key = start == stretch.start;
    spans.push_back(span);
  }
}

RotationSpan even_turn(const turns::Stretch& stretch) {
  RotationSpan span = turns::blank_span(stretch);
  span.spin = {0, 0, 0};
  span.degree = 1;
  span.coefficients[1] = turns::padded(stretch.way + stretch.spin);
  return span;
}

RotationSpan at_rest_span(const turns::Stretch& stretch) {
  RotationSpan span = turns::blank_span(stretch);
  span.spin = {0, 0, 0};
  span.end = stretch.from;
  return span;
}

// The angular velocity that a side states or its rule chose, in world axes. `chosen` and `straight`, the rule's and
// that of the straight way, are in the axes of the key's own rotation.
Vec3 angular_slope(const std::optional<Tangent<Quat>>& tangent, const Quat& rotation, const Vec3& chosen,
                   const Vec3& straight) {
  const TangentKind kind = tangent ? tangent->kind : TangentKind::automatic;
  if (kind == TangentKind::given) return tangent->rate;
  if (kind == TangentKind::flat) return Vec3::Zero();
  return rotation * (kind == TangentKind::vector ? straight : chosen);
}

// The cubic of rotation vectors with given slopes: angular velocities in the axes of the key's own rotation.
RotationSpan hermite_span(const Key<Quat>& a, const Key<Quat>& b, const turns::Stretch& s, const Vec3& chosen_leaving,
                          const Vec3& chosen_arriving, Overlong overlong) {
  RotationSpan span = turns::blank_span(s);
  const Vec3 straight = (s.way + s.spin) / s.duration;
  const Vec3 leaving = s.from.conjugate() * angular_slope(a.out, s.from, chosen_leaving, straight);
  const Vec3 arriving = s.to.conjugate() * angular_slope(b.in, s.to, chosen_arriving, straight);
  constexpr double third = 1.0 / 3;
  const double w0 = a.out ? a.out->weight : third, w1 = b.in ? b.in->weight : third;
  const bool plain = w0 == third && w1 == third;
  // Whole turns are even in the cubic's own variable, which at an end runs 1/(3 weight) times as fast as time.
  const double share0 = plain ? 1 : third / w0, share1 = plain ? 1 : third / w1;
  const Vec4 d0 = turns::padded(s.duration * leaving - share0 * s.spin);
  const Vec4 d1 = turns::padded(right_jacobian_inverse(s.way) * Vec3(s.duration * arriving - share1 * s.spin));
  const Vec4 from(0, 0, 0, 0), change = turns::padded(s.way);
  span.degree = 3;
  if (plain)
    spans::cubic_coefficients(from, change, d0, d1, span.coefficients.data());
  else
    spans::fill_bezier(span, from, change, Vec4(w0 * d0), Vec4(w1 * d1), {w0, w1}, overlong);
  return span;
}

// The angular velocity that the outer side of an end key states.
std::optional<Vec3> outer_slope(const std::optional<Tangent<Quat>>& tangent) {
  if (tangent && tangent->kind == TangentKind::given) return tangent->rate;
  if (tangent && tangent->kind == TangentKind::flat) return Vec3(0, 0, 0);
  return std::nullopt;
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

Curve<Quat> keying::rotation_curve(std::span<const Key<Quat>> keys, const KeyOptions& options) {
  if (keys.size() == 1) {
    keying::check_turn(keys, 0);
    return CurveAccess::one_key(keying::unit(keys, 0, keys[0].value), keys[0].time);
  }
  const std::vector<turns::Stretch> stretches = keying::stretches_of(keys, options.long_way);
  const keying::Slopes slopes = keying::slopes_of(keys, stretches, options.ends);
  const auto has_tangents = [&](std::size_t i) { return keys[i].out.has_value() || keys[i + 1].in.has_value(); };
  const auto rule_of = [&](std::size_t i) { return has_tangents(i) ? nullptr : keys[i].ease.turn_rule(); };

  std::vector<RotationSpan> spans;
  for (std::size_t i = 0; i < stretches.size();) {
    if (const Ease::TurnRule rule = rule_of(i)) {
      std::size_t last = i + 1;
      while (last < stretches.size() && rule_of(last) == rule) ++last;
      rule(TurnProblem{stretches, i, last, options.ends, slopes, spans});
      i = last;
      continue;
    }
    switch (keying::plan_span(keys[i].ease, has_tangents(i)).kind) {
      case keying::SpanKind::hold:
        spans.push_back(keying::at_rest_span(stretches[i]));
        break;
      case keying::SpanKind::linear:
        spans.push_back(keying::even_turn(stretches[i]));
        break;
      case keying::SpanKind::shape:
        keying::append_shape(spans, keys[i], stretches[i]);
        break;
      case keying::SpanKind::cubic:
        spans.push_back(keying::hermite_span(keys[i], keys[i + 1], stretches[i], Vec3(&slopes.leaving[3 * i]),
                                             Vec3(&slopes.arriving[3 * i]), options.overlong));
        break;
    }
    ++i;
  }
  const Quat final = hemisphere_aligned(keying::unit(keys, keys.size() - 1, keys.back().value), stretches.back().to);
  return CurveAccess::from_spans<Quat>(spans, keys.back().time,
                                       {{}, stretches.front().from, keying::outer_slope(keys.front().in)},
                                       {{}, final, keying::outer_slope(keys.back().out)});
}

}  // namespace tweenfall
