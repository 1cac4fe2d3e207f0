#pragma once

// Numbers carried as an unevaluated sum of two doubles, about 106 bits, without fused operations.
// Source: Dekker, "A floating-point technique for extending the available precision", 1971; Knuth, TAOCP 2, 4.2.2.

namespace tweenfall::two_part {

struct Sum {
  double high, low;
};

// Exact a + b for |a| >= |b|.
constexpr Sum quick_sum(double a, double b) noexcept {
  const double s = a + b;
  return {s, b - (s - a)};
}

// Exact a + b.
constexpr Sum sum(double a, double b) noexcept {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

// Exact a * b while nothing overflows or underflows (|a|, |b| < 1e290).
constexpr Sum product(double a, double b) noexcept {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double ca = splitter * a, cb = splitter * b;
  const double ah = ca - (ca - a), bh = cb - (cb - b);
  const double al = a - ah, bl = b - bh;
  const double p = a * b;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

constexpr Sum add(const Sum& a, const Sum& b) noexcept {
  const Sum s = sum(a.high, b.high);
  return quick_sum(s.high, s.low + (a.low + b.low));
}

constexpr Sum multiply(const Sum& a, const Sum& b) noexcept {
  const Sum p = product(a.high, b.high);
  return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

constexpr Sum divide(const Sum& a, const Sum& b) noexcept {
  const double q = a.high / b.high;
  const Sum p = product(q, b.high);
  const double rest = ((a.high - p.high) - p.low + a.low) - q * b.low;
  return quick_sum(q, rest / b.high);
}

}  // namespace tweenfall::two_part
