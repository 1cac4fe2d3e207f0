#include <tweenfall/curves/editing.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "curve/span_part.h"
#include "curve/spans_between.h"
#include "curve/time_bezier.h"
#include "keys/key_check.h"
#include "keys/span_slopes.h"
#include "questions/curve_pieces.h"
#include "questions/piece_difference.h"

namespace tweenfall::editing {
namespace {

template <class T>
Tangent<T> given(const Rate<T>& rate, double weight = 1.0 / 3) {
  return {Tangent<T>::Kind::given, rate, weight};
}

// The shares of a span that its handles take, from the cubic of its time.
struct HandleWeights {
  double out = 1.0 / 3, in = 1.0 / 3;
  [[nodiscard]] bool possible() const noexcept { return out > 0 && out <= 1 && in > 0 && in <= 1; }
};

HandleWeights weights_of(const std::array<double, 4>& x) noexcept {
  const double x1 = x[1] / 3, x2 = (x[2] + 6 * x1) / 3;
  return {x1, 1 - x2};
}

template <class AnySpan>
[[noreturn]] void refuse_span(const AnySpan& span, const std::string& why) {
  throw std::invalid_argument("the span from " + spans::text_of(span.start) + " s " + why +
                              ", which no key describes; fit keys to it instead");
}

template <class T>
void describe(Key<T>& from, Key<T>& to, const Span<T>& span, const Curve<T>& curve) {
  HandleWeights weights;
  if (span.degree == 0) {
    from.ease = Ease::hold();
    return;
  }
  if (span.degree > 3) refuse_span(span, "has the degree " + std::to_string(span.degree));
  if (span.warp.function) {
    if (!spans::is_time_bezier(span.warp)) refuse_span(span, "is an ease");
    weights = weights_of(questions::curve_pieces(curve, from.time, to.time).front().x);
    if (!weights.possible()) refuse_span(span, "has a handle outside itself");
  } else if (span.degree == 1) {
    from.ease = Ease::linear();
    return;
  }
  from.out = given<T>(curve.rate(from.time, Side::out), weights.out);
  to.in = given<T>(curve.rate(to.time, Side::in), weights.in);
}

void describe(Key<Quat>& from, Key<Quat>&, const RotationSpan& span, const Curve<Quat>&) {
  if (!span.spin.isZero(0)) refuse_span(span, "makes whole turns on the way");
  if (span.form == RotationSpan::Form::exponential && span.degree == 0) {
    from.ease = Ease::hold();
    return;
  }
  constexpr double half_turn = 0x1.921fb54442d18p+1;
  const bool even = !span.warp.function || span.warp.function == &spans::straight_warp;
  if (span.form != RotationSpan::Form::exponential || span.degree != 1 || !even ||
      !(std::abs(span.warp.width) * span.coefficients[1].norm() < half_turn))
    refuse_span(span, "is not a rotation at constant speed by less than half a turn");
  from.ease = Ease::linear();
}

template <class T>
bool same_value(const T& a, const T& b) noexcept {
  for (int i = 0; i < spans::dimensions<T>; ++i)
    if (spans::component(a, i) != spans::component(b, i)) return false;
  return true;
}

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
std::vector<Key<T>> keys_of(const Curve<T>& curve) {
  if (curve.start() == curve.end()) return {Key<T>{curve.start(), curve.value(curve.start())}};
  const std::vector<typename SpanOf<T>::type> spans = curve.spans();
  if (spans.empty()) throw std::invalid_argument("no keys describe a formula; fit keys to it instead");
  const std::span<const double> knots = curve.knots();
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const bool last = i + 1 == knots.size();
    keys.push_back({knots[i], last ? CurveAccess::end_value(curve, false) : curve.value(knots[i], Side::out)});
    if (i == 0) continue;
    editing::describe(keys[i - 1], keys[i], spans[i - 1], curve);
    const T arriving = curve.value(knots[i], Side::in);
    if (keys[i - 1].ease.rule() != Ease::Rule::hold && !editing::same_value(arriving, keys[i].value))
      keys[i].value_in = arriving;
  }
  const auto& data = CurveAccess::data(curve);
  if (data.before.slope) keys.front().in = editing::given<T>(*data.before.slope);
  if (data.after.slope) keys.back().out = editing::given<T>(*data.after.slope);
  return keys;
}

template <class T>
std::vector<Key<T>> with_given_slopes(std::span<const Key<T>> keys, const KeyOptions& options) {
  const Curve<T> curve = keyed_curve<T>(keys, options);
  std::vector<Key<T>> result(keys.begin(), keys.end());
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    if (keying::plan_span(keys[i].ease, keys[i].out || keys[i + 1].in).kind != keying::SpanKind::cubic) continue;
    const double out = keys[i].out ? keys[i].out->weight : 1.0 / 3,
                 in = keys[i + 1].in ? keys[i + 1].in->weight : 1.0 / 3;
    result[i].ease = Ease::smooth_clamped();
    result[i].out = editing::given<T>(curve.rate(keys[i].time, Side::out), out);
    result[i + 1].in = editing::given<T>(curve.rate(keys[i + 1].time, Side::in), in);
  }
  return result;
}

template <class T>
std::vector<Key<T>> with_key(std::span<const Key<T>> keys, double time, const KeyOptions& options) {
  std::vector<Key<T>> result = with_given_slopes(keys, options);
  const auto after =
      std::lower_bound(keys.begin(), keys.end(), time, [](const Key<T>& key, double t) { return key.time < t; });
  if (after == keys.end() || (after == keys.begin() && after->time != time) || std::isnan(time))
    throw std::invalid_argument("a key at " + spans::text_of(time) + " s would lie outside the keys, from " +
                                spans::text_of(keys.front().time) + " s to " + spans::text_of(keys.back().time) + " s");
  if (after->time == time) return result;
  const std::size_t i = static_cast<std::size_t>(after - keys.begin()) - 1;
  Key<T>&from = result[i], &to = result[i + 1];
  const Curve<T> curve = keyed_curve<T>(keys, options);
  const Sample<T> here = curve.sample(time);
  Key<T> key{time, here.value};
  const keying::SpanKind kind = keying::plan_span(keys[i].ease, keys[i].out || keys[i + 1].in).kind;
  if (kind == keying::SpanKind::hold || kind == keying::SpanKind::linear) {
    key.ease = keys[i].ease;
    if (kind == keying::SpanKind::linear && options.long_way)
      keying::refuse_key(keys, i, "takes the long way around, which two keys would not");
  } else {
    if (std::is_same_v<T, Quat>)
      keying::refuse_key(keys, i, "begins a turn at changing speed, which two keys would not repeat");
    questions::CurvePiece<double> handles;
    handles.from = from.time;
    handles.to = to.time;
    handles.timed = true;
    double x1 = from.out ? from.out->weight : 1.0 / 3, x2 = 1 - (to.in ? to.in->weight : 1.0 / 3);
    if (kind == keying::SpanKind::shape) {
      const std::vector<Ease::Piece>& pieces = keys[i].ease.pieces();
      const Ease::Piece& piece = pieces.front();
      const bool bezier = spans::is_time_bezier(piece.warp);
      if (pieces.size() != 1 || piece.degree > 3 || (piece.warp.function && !bezier))
        keying::refuse_key(keys, i, "has the ease \"" + keys[i].ease.name() + "\", half of which no key describes");
      x1 = bezier ? piece.warp.parameters[0] : 1.0 / 3;
      x2 = bezier ? piece.warp.parameters[1] : 2.0 / 3;
      from.ease = Ease::smooth_clamped();
    }
    handles.x = spans::time_cubic(x1, x2);
    const bool plain = x1 == 1.0 / 3 && std::abs(x2 - 2.0 / 3) <= 2e-16;
    const editing::HandleWeights first =
        plain ? editing::HandleWeights{} : editing::weights_of(questions::piece_part(handles, from.time, time).x);
    const editing::HandleWeights second =
        plain ? editing::HandleWeights{} : editing::weights_of(questions::piece_part(handles, time, to.time).x);
    if (!first.possible() || !second.possible())
      keying::refuse_key(keys, i, "has handles that, cut here, would lie outside their spans");
    from.out = editing::given<T>(curve.rate(from.time, Side::out), first.out);
    key.in = editing::given<T>(here.rate, first.in);
    key.out = editing::given<T>(here.rate, second.out);
    to.in = editing::given<T>(curve.rate(to.time, Side::in), second.in);
  }
  result.insert(result.begin() + static_cast<std::ptrdiff_t>(i) + 1, key);
  return result;
}

#define TWEENFALL_EDITING_KEYS(T)                                                                \
  template std::vector<Key<T>> keys_of<T>(const Curve<T>&);                                      \
  template std::vector<Key<T>> with_given_slopes<T>(std::span<const Key<T>>, const KeyOptions&); \
  template std::vector<Key<T>> with_key<T>(std::span<const Key<T>>, double, const KeyOptions&);
TWEENFALL_EDITING_KEYS(double)
TWEENFALL_EDITING_KEYS(Vec2)
TWEENFALL_EDITING_KEYS(Vec3)
TWEENFALL_EDITING_KEYS(Vec4)
TWEENFALL_EDITING_KEYS(Color)
TWEENFALL_EDITING_KEYS(Quat)
#undef TWEENFALL_EDITING_KEYS

}  // namespace tweenfall
