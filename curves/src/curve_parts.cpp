#include "curve_parts.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {
namespace {

// Stretches without polynomials are cut this finely, so that each holds at most one extreme of what is common.
constexpr int sampled_parts = 64;

// The polynomial in x with s = a + b x.
std::vector<double> substituted(const std::vector<double>& c, double a, double b) {
  std::vector<double> result = c;
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t k = n - 1; k-- > i;) result[k] += a * result[k + 1];
  double power = 1;
  for (double& v : result) {
    v *= power;
    power *= b;
  }
  return result;
}

void add_sampled(std::vector<CurvePart>& result, double from, double to) {
  for (int i = 0; i < sampled_parts; ++i) {
    const double a = i == 0 ? from : from + (to - from) * i / sampled_parts;
    const double b = i + 1 == sampled_parts ? to : from + (to - from) * (i + 1) / sampled_parts;
    if (b > a) result.push_back({a, b, {}});
  }
}

// One play of the knots, shown from start + shift on, forwards or backwards, with `offset` added.
struct Play {
  double shift;  // s, added to the curve's own time
  bool backward;
  double offset;
};

void add_play(std::vector<CurvePart>& result, const Curve<double>& curve, const std::vector<Span<double>>& spans,
              double from, double to, const Play& play) {
  const double mirror = curve.start() + curve.end();
  const std::size_t n = spans.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = play.backward ? n - 1 - k : k;
    const Span<double>& span = spans[i];
    const double span_start = curve.knots()[i], span_end = curve.knots()[i + 1];
    // Exactly the knots themselves in the first play.
    double a = play.backward ? mirror - span_end : span_start, b = play.backward ? mirror - span_start : span_end;
    a += play.shift;
    b += play.shift;
    const double low = std::max(a, from), high = std::min(b, to);
    if (!(high > low)) continue;
    if (span.warp.function) {
      add_sampled(result, low, high);
      continue;
    }
    const std::vector<double> c(span.coefficients.begin(), span.coefficients.begin() + span.degree + 1);
    const double u = (low - a) / (b - a), width = (high - low) / (b - a);
    CurvePart part{low, high, play.backward ? substituted(c, 1 - u, -width) : substituted(c, u, width)};
    part.coefficients[0] += play.offset;
    result.push_back(std::move(part));
  }
}

void add_outside(std::vector<CurvePart>& result, const Curve<double>& curve, const std::vector<Span<double>>& spans,
                 double from, double to, bool early) {
  const Outside rule = early ? curve.before() : curve.after();
  CurvePart rest{0, 0, {}};
  const Sample<double> end = early ? curve.sample(curve.start(), Side::in) : curve.sample(curve.end(), Side::out);
  if (rule == Outside::hold) {
    result.push_back({from, to, {end.value}});
  } else if (rule == Outside::linear) {
    const double anchor = early ? curve.start() : curve.end();
    result.push_back({from, to, {end.value + (from - anchor) * end.rate, (to - from) * end.rate}});
  } else {
    const double duration = curve.duration();
    if (const double plays = early ? curve.rule_before().plays : curve.rule_after().plays; plays > 0) {
      // Beyond the last play the curve rests.
      const double last = early ? curve.start() - plays * duration : curve.end() + plays * duration;
      const double resting = curve.value(last, early ? Side::in : Side::out);
      if (early && from < last) {
        result.push_back({from, std::min(to, last), {resting}});
        from = std::min(to, last);
      }
      if (!early && to > last) {
        rest = {std::max(from, last), to, {resting}};
        to = std::max(from, last);
      }
    }
    const Curve<double> held = curve.with_outside(Outside::hold, Outside::hold);
    const double gain = held.value(curve.end(), Side::out) - held.value(curve.start(), Side::in);
    const double last = std::ceil((to - curve.start()) / duration);
    for (double k = std::floor((from - curve.start()) / duration); k < last; k += 1)
      add_play(result, curve, spans, from, to,
               {k * duration, rule == Outside::pingpong && std::fmod(k, 2) != 0,
                rule == Outside::repeat_offset ? k * gain : 0});
    if (rest.to > rest.from) result.push_back(std::move(rest));
  }
}

}  // namespace

std::vector<CurvePart> curve_parts(const Curve<double>& curve, double from, double to) {
  std::vector<CurvePart> result;
  if (!(to > from)) return result;
  const std::vector<Span<double>> spans = curve.spans();
  if (spans.empty()) {
    std::vector<double> marks = {from};
    for (const double knot : curve.knots())
      if (knot > from && knot < to) marks.push_back(knot);
    marks.push_back(to);
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) add_sampled(result, marks[i], marks[i + 1]);
    return result;
  }
  if (from < curve.start()) add_outside(result, curve, spans, from, std::min(to, curve.start()), true);
  add_play(result, curve, spans, from, to, {0, false, 0});
  if (to > curve.end()) add_outside(result, curve, spans, std::max(from, curve.end()), to, false);
  return result;
}

}  // namespace tweenfall
