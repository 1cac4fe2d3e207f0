#include <tweenfall/physics/strength.h>

#include <tweenfall/curves/fitting.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forces/formula_leaps.h"
#include "state/checks.h"

namespace tweenfall {

namespace forces {
namespace {

bool has_eases(const std::vector<Span<double>>& spans) {
  return std::any_of(spans.begin(), spans.end(),
                     [](const Span<double>& span) { return span.warp.function != nullptr; });
}

double greatest(const Curve<double>& curve) {
  double most = 0;
  for (const Span<double>& span : curve.spans()) {
    most = std::max(most, std::abs(span.end));
    constexpr int looks = 8;
    for (int i = 0; i <= looks; ++i)
      most = std::max(most, std::abs(curve.value(span.start + span.duration * i / looks)));
  }
  return most;
}

Span<double> rest(double start, double value) {
  Span<double> span;
  span.start = start;
  span.coefficients.fill(0);
  span.coefficients[0] = span.end = value;
  return span;
}

/// The curve made of its spans alone, as after saving: where it jumps at its first or last key, it rests for
/// a second beyond it.
Curve<double> of_spans(const Curve<double>& curve) {
  std::vector<Span<double>> spans = curve.spans();
  const double before = curve.value(curve.start(), Side::in), after = curve.value(curve.end());
  if (curve.after() == Outside::hold && after != spans.back().end) spans.push_back(rest(curve.end(), after));
  if (curve.before() == Outside::hold && before != spans.front().coefficients[0])
    spans.insert(spans.begin(), rest(curve.start() - 1, before));
  return Curve<double>(spans).with_outside(curve.rule_before(), curve.rule_after());
}

}  // namespace
}  // namespace forces

Strength::Strength(double factor) : factor_(factor) {
  state::require(state::countable(factor), "a strength must be finite and at most 1e30");
}

Strength::Strength(const Curve<double>& keys) : curve_(keys) {
  if (keys.duration() == 0) {
    *this = Strength(keys.value(keys.start()));
    return;
  }
  state::require(!keys.spans().empty(), "a strength takes keys, not the formula of a curve; give the formula as text");
  const double most = forces::greatest(keys);
  state::require(state::countable(most), "a strength must be finite and at most 1e30");
  if (forces::has_eases(keys.spans())) {
    const std::vector<Key<double>> fitted = fit(keys, 1e-9 * (most > 0 ? most : 1));
    curve_ = keyed_curve<double>(fitted).with_outside(keys.rule_before(), keys.rule_after());
  }
  curve_ = forces::of_spans(*curve_);
}

Strength Strength::formula(const std::string& text) {
  Strength strength;
  strength.formula_ = Expression(text);
  strength.text_ = text;
  strength.leaping_ = forces::leaping_parts({&*strength.formula_, 1}, 0, 1);
  return strength;
}

double Strength::at(double time, Side side) const noexcept {
  double value = factor_;
  if (formula_) {
    value = formula_->sample(forces::beside_leaps(leaping_, 0, time, side), side).value;
  } else if (curve_) {
    const std::span<const double> knots = curve_->knots();
    const auto next = std::lower_bound(knots.begin(), knots.end(), time - forces::at_a_leap);
    value = curve_->value(next != knots.end() && *next <= time + forces::at_a_leap ? *next : time, side);
  }
  return std::isfinite(value) ? value : 0;
}

bool Strength::changes(double from, double to) const noexcept {
  if (formula_) return true;
  if (!curve_) return false;
  const double value = at(from, Side::in);
  const std::span<const double> knots = curve_->knots();
  // A polynomial of fifth degree with the same value at more than five places is constant.
  constexpr int looks = 6;
  for (int i = 0; i <= looks; ++i) {
    const double time = from + (to - from) * i / looks;
    if (at(time) != value || at(time, Side::in) != value) return true;
  }
  const auto next = std::upper_bound(knots.begin(), knots.end(), from);
  for (auto knot = next; knot != knots.end() && *knot < to; ++knot)
    if (at(*knot) != value || at(*knot, Side::in) != value) return true;
  return false;
}

bool Strength::operator==(const Strength& other) const noexcept {
  if (factor_ != other.factor_ || text_ != other.text_ || curve_.has_value() != other.curve_.has_value()) return false;
  if (!curve_) return true;
  const std::vector<Span<double>> own = curve_->spans(), others = other.curve_->spans();
  const auto same = [](const Span<double>& a, const Span<double>& b) {
    return a.start == b.start && a.duration == b.duration && a.degree == b.degree && a.end == b.end &&
           std::equal(a.coefficients.begin(), a.coefficients.begin() + a.degree + 1, b.coefficients.begin());
  };
  return std::equal(own.begin(), own.end(), others.begin(), others.end(), same);
}

}  // namespace tweenfall
