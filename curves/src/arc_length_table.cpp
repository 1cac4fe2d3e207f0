#include "arc_length_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tweenfall {
namespace {

// Gauss and Legendre's rule with eight points. Source: Abramowitz and Stegun, table 25.4.
constexpr double nodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double weights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};

// Halving this often leaves parts of a millionth of a span, as next to a cusp.
constexpr int most_halvings = 20;

}  // namespace

ArcLengthTable::ArcLengthTable(const Curve<Vec3>& curve) : curve_(curve) {
  const std::array<double, 2> ends = {curve.start(), curve.end()};
  const std::span<const double> knots = curve.knots().empty() ? std::span<const double>(ends) : curve.knots();
  std::vector<double> lengths;
  double about = 0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    lengths.push_back(length_between(knots[i], knots[i + 1]));
    about += lengths.back();
  }
  constexpr double without_end = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lengths.size(); ++i)
    add(knots[i], knots[i + 1], lengths[i], 1e-15 * about, without_end, 0);
  double before = 0;
  for (Part& part : parts_) {
    part.length_before = before;
    before += part.length;
  }
}

void ArcLengthTable::add(double from, double to, double whole, double allowed, double fault_before, int depth) {
  const double middle = 0.5 * (from + to);
  const double first = length_between(from, middle), second = length_between(middle, to);
  const double fault = std::abs(first + second - whole);
  // Noise of the rates shrinks no faster than the parts do; what is left of the rule's own fault is then below it.
  const bool noise = fault <= 1e-10 * whole && fault > 0.4 * fault_before;
  if (!(fault > allowed) || noise || depth == most_halvings) {
    parts_.push_back({from, middle, 0, first});
    parts_.push_back({middle, to, 0, second});
    return;
  }
  add(from, middle, first, allowed, fault, depth + 1);
  add(middle, to, second, allowed, fault, depth + 1);
}

double ArcLengthTable::length_between(double from, double to) const noexcept {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += weights[i] * (curve_.rate(middle - half * nodes[i]).norm() + curve_.rate(middle + half * nodes[i]).norm());
  return half * sum;
}

double ArcLengthTable::parameter(double length) const noexcept {
  if (!(length > 0)) return parts_.front().from;
  if (length >= this->length()) return parts_.back().to;
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), length,
                                      [](double l, const Part& part) { return l < part.length_before; });
  const Part& part = *(after - 1);
  // Newton's method on an increasing function, kept between bounds that close in on the root.
  const double wanted = length - part.length_before;
  double low = part.from, high = part.to;
  double x = low + (high - low) * std::min(wanted / part.length, 1.0);
  for (int i = 0; i < 60; ++i) {
    const double miss = length_between(part.from, x) - wanted;
    (miss > 0 ? high : low) = x;
    const double speed = curve_.rate(x).norm();
    double next = x - miss / speed;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 2e-16 * std::max(std::abs(x), std::abs(part.to - part.from))) return next;
    x = next;
  }
  return x;
}

}  // namespace tweenfall
