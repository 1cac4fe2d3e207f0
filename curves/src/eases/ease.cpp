#include <tweenfall/curves/ease.h>

#include <algorithm>
#include <stdexcept>

#include "curve/time_bezier.h"
#include "eases/ease_form.h"
#include "math/polynomial.h"

namespace tweenfall {

Ease::Ease(Form form) : form_(std::make_shared<const Form>(std::move(form))) {}

Ease::Rule Ease::rule() const noexcept {
  return form_->rule;
}

const std::string& Ease::name() const noexcept {
  return form_->name;
}

const std::vector<Ease::Piece>& Ease::pieces() const noexcept {
  return form_->pieces;
}

Ease::SlopeRule Ease::slope_rule() const noexcept {
  return form_->slopes;
}

Ease::TurnRule Ease::turn_rule() const noexcept {
  return form_->turns;
}

const std::array<double, 4>& Ease::parameters() const noexcept {
  return form_->parameters;
}

Ease Ease::shape(std::string name, std::vector<Piece> pieces) {
  if (pieces.empty()) throw std::invalid_argument("the shape " + name + " has no pieces");
  return Ease(Form{.rule = Rule::shape, .name = std::move(name), .pieces = std::move(pieces)});
}

Ease Ease::scaled(double factor) const {
  const double start = form_->parameters[0], end = form_->parameters[1];
  return form_->with_ends && (start != 0 || end != 0) ? form_->with_ends(start * factor, end * factor) : *this;
}

std::vector<Ease::Piece> Ease::pieces_for(double duration) const {
  return form_->shape ? form_->shape(duration, form_->parameters) : form_->pieces;
}

Sample<double> Ease::progress(double u, Side side) const noexcept {
  const std::vector<Piece>& pieces = form_->pieces;
  std::size_t i = 0;
  while (i + 1 < pieces.size() && (u > pieces[i + 1].start || (u == pieces[i + 1].start && side == Side::out))) ++i;
  const Piece& p = pieces[i];
  const double local = std::min(1.0, std::max(0.0, (u - p.start) / p.duration));
  Warp::Result w{local, 1, 0};
  if (p.warp.function) w = p.warp.at(local);
  math::Polynomial<double> v = math::evaluate_polynomial(p.coefficients.data(), p.degree, w.s);
  if (!p.warp.function || !spans::limit_where_time_rests(p.warp, w.s, p.coefficients.data(), p.degree, v)) {
    v.second = v.second * w.ds * w.ds + v.first * w.dds;
    v.first = v.first * w.ds;
  }
  Sample<double> result{v.value, v.first / p.duration, v.second / (p.duration * p.duration)};
  if (local == 1) result.value = p.end;
  if (u >= 1 && side == Side::out) result.value = 1;
  return result;
}

}  // namespace tweenfall
