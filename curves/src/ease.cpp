#include <tweenfall/curves/ease.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ease_text.h"
#include "polynomial.h"
#include "shapes.h"
#include "slope_rule.h"

namespace tweenfall {

Ease::Ease(Rule of, std::string as, SlopeRule slopes, const std::array<double, 4>& numbers)
    : rule_(of), name_(std::move(as)), slope_rule_(slopes), parameters_(numbers) {}

Ease Ease::hold() {
  return {Rule::hold, "hold"};
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

Ease Ease::natural() {
  return {Rule::slopes, "natural", &slopes_natural};
}

Ease Ease::catmull_rom() {
  return {Rule::slopes, "catmull-rom", &slopes_catmull_rom};
}

Ease Ease::centripetal() {
  return {Rule::slopes, "centripetal", &slopes_centripetal};
}

Ease Ease::tcb(double tension, double continuity, double bias) {
  for (const double v : {tension, continuity, bias})
    if (!std::isfinite(v))
      throw std::invalid_argument("tension, continuity and bias must be finite; one is " + text_of(v));
  return {Rule::slopes, call_text("tcb", {tension, continuity, bias}), &slopes_tcb, {tension, continuity, bias, 0}};
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
