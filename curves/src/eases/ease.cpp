#include <tweenfall/curves/ease.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eases/ease_text.h"
#include "eases/shapes.h"
#include "math/polynomial.h"
#include "slopes/slope_rule.h"
#include "turns/turn_rule.h"

namespace tweenfall {
namespace {

void check_ends(const char* what, double start, double end) {
  for (const double v : {start, end})
    if (!std::isfinite(v))
      throw std::invalid_argument(std::string("the ") + what + " at the ends must be finite; one is " + text_of(v));
}

}  // namespace

Ease::Ease(Rule of, std::string as, SlopeRule slopes, const std::array<double, 4>& numbers, TurnRule turns)
    : rule_(of), name_(std::move(as)), slope_rule_(slopes), turn_rule_(turns), parameters_(numbers) {}

Ease Ease::hold() {
  return {Rule::hold, "hold"};
}

Ease Ease::step_next() {
  return shape("step-next", shapes::steps(1, "jump-start"));
}

Ease Ease::linear() {
  return {Rule::linear, "linear"};
}

Ease Ease::smooth() {
  return {Rule::smooth, "smooth", &slopes_smooth};
}

Ease Ease::smooth_clamped() {
  return {Rule::smooth_clamped, "smooth-clamped", &slopes_smooth_clamped};
}

Ease Ease::monotone() {
  return {Rule::slopes, "monotone", &slopes_monotone};
}

Ease Ease::akima() {
  return {Rule::slopes, "akima", &slopes_akima};
}

Ease Ease::makima() {
  return {Rule::slopes, "makima", &slopes_makima};
}

Ease Ease::natural() {
  return {Rule::slopes, "natural", &slopes_natural, {}, &turns_natural};
}

Ease Ease::natural(double start, double end) {
  check_ends("second derivatives", start, end);
  return {Rule::slopes, call_text("natural", {start, end}), &slopes_natural_given, {start, end, 0, 0}};
}

Ease Ease::clamped() {
  return {Rule::slopes, "clamped", &slopes_clamped};
}

Ease Ease::clamped(double start, double end) {
  check_ends("slopes", start, end);
  return {Rule::slopes, call_text("clamped", {start, end}), &slopes_clamped, {start, end, 0, 0}};
}

Ease Ease::periodic() {
  return {Rule::slopes, "periodic", &slopes_periodic};
}

Ease Ease::not_a_knot() {
  return {Rule::slopes, "not-a-knot", &slopes_not_a_knot};
}

Ease Ease::catmull_rom() {
  return {Rule::slopes, "catmull-rom", &slopes_catmull_rom, {}, &turns_de_casteljau};
}

Ease Ease::catmull_rom_monotone() {
  return {Rule::slopes, "catmull-rom-monotone", &slopes_catmull_rom_monotone};
}

Ease Ease::uniform() {
  return {Rule::slopes, "uniform", &slopes_uniform};
}

Ease Ease::centripetal() {
  return {Rule::slopes, "centripetal", &slopes_centripetal};
}

Ease Ease::chordal() {
  return {Rule::slopes, "chordal", &slopes_chordal};
}

Ease Ease::tcb(double tension, double continuity, double bias) {
  for (const double v : {tension, continuity, bias})
    if (!std::isfinite(v))
      throw std::invalid_argument("tension, continuity and bias must be finite; one is " + text_of(v));
  return {Rule::slopes,
          call_text("tcb", {tension, continuity, bias}),
          &slopes_tcb,
          {tension, continuity, bias, 0},
          &turns_de_casteljau};
}

Ease Ease::nlerp() {
  return {Rule::linear, "nlerp", nullptr, {}, &turns_normalized};
}

Ease Ease::squad() {
  return {Rule::slopes, "squad", &slopes_catmull_rom, {}, &turns_squad};
}

Ease Ease::barry_goldman() {
  return {Rule::slopes, "barry-goldman", &slopes_catmull_rom, {}, &turns_barry_goldman};
}

Ease Ease::spring(double period, double damping_ratio) {
  if (!(period > 0) || !std::isfinite(period))
    throw std::invalid_argument("a spring's period must be > 0 s; it is " + text_of(period));
  if (!(damping_ratio >= 0) || !std::isfinite(damping_ratio))
    throw std::invalid_argument("a spring's damping ratio must be >= 0; it is " + text_of(damping_ratio));
  Ease ease{Rule::shape,
            "spring(" + number_text(period) + "s," + number_text(damping_ratio) + ")",
            nullptr,
            {period, damping_ratio, 0, 0}};
  ease.shape_rule_ = &shapes::spring;
  ease.pieces_ = ease.pieces_for(1);
  return ease;
}

Ease Ease::bezier(double x1, double y1, double x2, double y2) {
  for (const double x : {x1, x2})
    if (!(x >= 0 && x <= 1))
      throw std::invalid_argument(
          "the handles' times x1 and x2 must lie in 0 to 1, or time would run backwards; one is " + text_of(x));
  for (const double y : {y1, y2})
    if (!std::isfinite(y)) throw std::invalid_argument("the handles' values must be finite; one is " + text_of(y));
  return shape(call_text("bezier", {x1, y1, x2, y2}), shapes::bezier(x1, y1, x2, y2));
}

Ease Ease::shape(std::string name, std::vector<Piece> pieces) {
  if (pieces.empty()) throw std::invalid_argument("the shape " + name + " has no pieces");
  Ease ease{Rule::shape, std::move(name)};
  ease.pieces_ = std::move(pieces);
  return ease;
}

Ease Ease::scaled(double factor) const {
  const double start = parameters_[0] * factor, end = parameters_[1] * factor;
  if (slope_rule_ == &slopes_natural_given) return natural(start, end);
  return slope_rule_ == &slopes_clamped && (start != 0 || end != 0) ? clamped(start, end) : *this;
}

std::vector<Ease::Piece> Ease::pieces_for(double duration) const {
  return shape_rule_ ? shape_rule_(duration, parameters_) : pieces_;
}

Sample<double> Ease::progress(double u, Side side) const noexcept {
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && (u > pieces_[i + 1].start || (u == pieces_[i + 1].start && side == Side::out))) ++i;
  const Piece& p = pieces_[i];
  const double local = std::min(1.0, std::max(0.0, (u - p.start) / p.duration));
  Warp::Result w{local, 1, 0};
  if (p.warp.function) w = p.warp.at(local);
  const Polynomial<double> v = evaluate_polynomial(p.coefficients.data(), p.degree, w.s);
  Sample<double> result{v.value, v.first * w.ds / p.duration,
                        (v.second * w.ds * w.ds + v.first * w.dds) / (p.duration * p.duration)};
  if (local == 1) result.value = p.end;
  if (u >= 1 && side == Side::out) result.value = 1;
  return result;
}

}  // namespace tweenfall
