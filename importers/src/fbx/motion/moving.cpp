#include "fbx/motion/moving.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tweenfall::fbx {

namespace {

bool is_constant(const Curve<double>& curve) {
  return curve.start() == curve.end();
}

/// Whether two curves are polynomials between the same knots and continue alike beyond them.
bool alike(const Curve<double>& a, const Curve<double>& b) {
  const auto same = [](const OutsideRule<double>& one, const OutsideRule<double>& other) {
    return one.rule == other.rule && one.plays == other.plays && !one.slope && !other.slope;
  };
  return std::ranges::equal(a.knots(), b.knots()) && same(a.rule_before(), b.rule_before()) &&
         same(a.rule_after(), b.rule_after());
}

/// The spans of a curve if all are plain polynomials; else empty.
std::optional<std::vector<Span<double>>> plain_spans(const Curve<double>& curve) {
  std::vector<Span<double>> spans = curve.spans();
  if (spans.size() + 1 != curve.knots().size()) return std::nullopt;
  for (const Span<double>& span : spans)
    if (span.warp.function && span.degree > 0) return std::nullopt;
  return spans;
}

void put(const Span<double>& part, int row, Span<Vec3>& span) {
  span.degree = std::max(span.degree, part.degree);
  for (int i = 0; i <= part.degree; ++i)
    span.coefficients[static_cast<std::size_t>(i)][row] = part.coefficients[static_cast<std::size_t>(i)];
  span.end[row] = part.end;
}

/// Spans of vectors from spans of numbers with the same knots; empty where the knots differ.
std::optional<Curve<Vec3>> joined_spans(const std::array<Curve<double>, 3>& parts) {
  const Curve<double>* moving = nullptr;
  for (const Curve<double>& part : parts) {
    if (is_constant(part)) {
      if (!part.knots().empty()) return std::nullopt;
      continue;
    }
    if (moving && !alike(*moving, part)) return std::nullopt;
    moving = &part;
  }
  if (!moving) return std::nullopt;
  std::vector<Span<Vec3>> spans(moving->knots().size() - 1);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].start = moving->knots()[i];
    spans[i].duration = moving->knots()[i + 1] - moving->knots()[i];
    spans[i].coefficients.fill(Vec3(0, 0, 0));
    spans[i].end = Vec3(0, 0, 0);
  }
  for (int row = 0; row < 3; ++row) {
    const Curve<double>& part = parts[static_cast<std::size_t>(row)];
    if (is_constant(part)) {
      for (Span<Vec3>& span : spans) span.coefficients[0][row] = span.end[row] = part.value(0);
      continue;
    }
    const auto own = plain_spans(part);
    if (!own || own->size() != spans.size()) return std::nullopt;
    for (std::size_t i = 0; i < spans.size(); ++i) put((*own)[i], row, spans[i]);
  }
  const auto rule = [](const OutsideRule<double>& of) { return OutsideRule<Vec3>{of.rule, {}, of.plays}; };
  return Curve<Vec3>(std::span<const Span<Vec3>>(spans))
      .with_outside(rule(moving->rule_before()), rule(moving->rule_after()));
}

}  // namespace

std::vector<double> Knots::sorted() const {
  std::vector<double> all = times_;
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Curve<Vec3> vector_curve(const Curve<double>& x, const Curve<double>& y, const Curve<double>& z) {
  const std::array<Curve<double>, 3> parts{x, y, z};
  if (auto joined = joined_spans(parts)) return *std::move(joined);
  return composed<Vec3>(
      [parts](double time, Side side) {
        Sample<Vec3> result{};
        for (int row = 0; row < 3; ++row) {
          const Sample<double> s = parts[static_cast<std::size_t>(row)].sample(time, side);
          result.value[row] = s.value;
          result.rate[row] = s.rate;
          result.acceleration[row] = s.acceleration;
        }
        return result;
      },
      Knots().of(x).of(y).of(z));
}

Sample<Vec3> sum(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept {
  return {a.value + b.value, a.rate + b.rate, a.acceleration + b.acceleration};
}

Sample<Vec3> difference(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept {
  return {a.value - b.value, a.rate - b.rate, a.acceleration - b.acceleration};
}

Sample<double> product(const Sample<double>& a, const Sample<double>& b) noexcept {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}

Sample<Vec3> product(const Sample<Vec3>& a, const Sample<Vec3>& b) noexcept {
  return {
      a.value.cwiseProduct(b.value), a.rate.cwiseProduct(b.value) + a.value.cwiseProduct(b.rate),
      a.acceleration.cwiseProduct(b.value) + 2 * a.rate.cwiseProduct(b.rate) + a.value.cwiseProduct(b.acceleration)};
}

Sample<Vec3> scaled(const Sample<Vec3>& a, const Sample<double>& factor) noexcept {
  const double f = factor.value, df = factor.rate;
  return {f * a.value, df * a.value + f * a.rate, factor.acceleration * a.value + 2 * df * a.rate + f * a.acceleration};
}

Sample<Vec3> turned(const Sample<Quat>& rotation, const Sample<Vec3>& v) noexcept {
  const Vec3 value = rotation.value * v.value, rate = rotation.value * v.rate;
  const Vec3& w = rotation.rate;
  return {value, w.cross(value) + rate,
          rotation.acceleration.cross(value) + w.cross(w.cross(value)) + 2 * w.cross(rate) +
              rotation.value * v.acceleration};
}

Sample<double> power(const Sample<double>& base, const Sample<double>& exponent) noexcept {
  if (exponent.value <= 0) return {1, 0, 0};
  if (exponent.value >= 1) return base;
  const double size = std::abs(base.value);
  if (!(size > 0)) return {0, 0, 0};
  // The logarithm of the result and its rates; the result's rates are these times the result.
  const double log = elementary::log(size), slope = base.rate / base.value;
  const double first = exponent.rate * log + exponent.value * slope;
  const double second = exponent.acceleration * log + 2 * exponent.rate * slope +
                        exponent.value * (base.acceleration / base.value - slope * slope);
  const double value = std::copysign(elementary::pow(size, exponent.value), base.value);
  return {value, value * first, value * (second + first * first)};
}

Channel<Vec3> product(const Channel<Vec3>& a, const Channel<Vec3>& b) {
  if (!a.driven && a.curve.value(0) == Vec3(1, 1, 1)) return b;
  return {composed<Vec3>(
              [first = a.curve, second = b.curve](double time, Side side) {
                return product(first.sample(time, side), second.sample(time, side));
              },
              Knots().of(a.curve).of(b.curve)),
          a.driven || b.driven};
}

}  // namespace tweenfall::fbx
