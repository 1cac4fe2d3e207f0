#pragma once

// How far a phase comes while the shares of its clips change linearly with the time.
//
// Between two markers the clips' times are cubics of the phase, so the pace, in seconds per phase, is
//   dt/dp = (1 - t) F(p) + t G(p)
// with t the part of the time that has passed and F, G the quadratic paces under the first and the last shares. This is
// linear in t: t is an entire function of p, and its Taylor series converges everywhere and is known term by term.

#include <array>
#include <cmath>
#include <cstddef>

#include "blending/rising_root.h"

namespace tweenfall::blending {

/// A pace along the phase from where a piece begins: a + b u + c u^2.
struct PiecePace {
  double a = 0, b = 0, c = 0;

  void add(double factor, const PiecePace& other) noexcept {
    a += factor * other.a;
    b += factor * other.b;
    c += factor * other.c;
  }
};

/// The part of the time that has passed, from the part of a piece that has: a power series.
class CourseSeries {
 public:
  static constexpr std::size_t most_terms = 40;

  /// @param part  of the time that has passed at its start
  /// @param first, last  paces along the piece, as parts of the time for the whole of it
  CourseSeries(double part, const PiecePace& first, const PiecePace& last) noexcept {
    const double more_a = last.a - first.a, more_b = last.b - first.b, more_c = last.c - first.c;
    const std::array<double, 3> own{first.a, first.b, first.c};
    terms_[0] = part;
    int negligible = 0;
    // Each term follows from the three before it: once three in a row are nothing, so are all others.
    while (size_ < most_terms && negligible < 3) {
      const std::size_t n = size_ - 1;
      double next = more_a * terms_[n];
      if (n >= 1) next += more_b * terms_[n - 1];
      if (n >= 2) next += more_c * terms_[n - 2];
      if (n < own.size()) next += own[n];
      terms_[size_] = next / static_cast<double>(size_);
      negligible = std::abs(terms_[size_]) <= 1e-18 * largest_ ? negligible + 1 : 0;
      largest_ = std::fmax(largest_, std::abs(terms_[size_]));
      ++size_;
    }
  }

  /// The part of the time that has passed, and its derivative.
  [[nodiscard]] Rise at(double x) const noexcept {
    Rise result{terms_[size_ - 1], 0};
    for (std::size_t n = size_ - 1; n-- > 0;) {
      result.slope = result.slope * x + result.value;
      result.value = result.value * x + terms_[n];
    }
    return result;
  }

 private:
  std::array<double, most_terms> terms_{};
  std::size_t size_ = 1;
  double largest_ = 0;
};

struct LinearPlace {
  double phase = 0;
  double part = 0;  ///< of the time that has passed, 0 to 1
};

/// The place at the end of the time, or at a whole phase that comes before.
/// @param last_phase  how far it goes at most
/// @param way  1, or -1 where the phase goes back
/// @param paces  gives the first and the last PiecePace from a phase towards that way, as parts of the time per phase;
/// both are above 0 in that way
template <class Paces>
[[nodiscard]] LinearPlace along_course(LinearPlace at, double last_phase, double way, const Paces& paces) noexcept {
  while (way * at.phase < way * last_phase && at.part < 1) {
    const double marker = way * std::fmin(way * last_phase, std::floor(way * at.phase) + 1);
    const auto [first, last] = paces(at.phase);
    const auto piece = [](const PiecePace& pace, double length) noexcept {
      return PiecePace{pace.a * length, pace.b * length * length, pace.c * length * length * length};
    };
    // Short enough for the series to end early.
    double length = marker - at.phase, to = marker;
    PiecePace begun, ended;
    for (;;) {
      begun = piece(first, length);
      ended = piece(last, length);
      if (std::abs(ended.a - begun.a) + std::abs(ended.b - begun.b) + std::abs(ended.c - begun.c) <= 1) break;
      length /= 2;
      to = at.phase + length;
      if (to == at.phase) return {at.phase, 1};  // too short a time for the phase to move
    }
    const CourseSeries series(at.part, begun, ended);
    const double part = series.at(1).value;
    if (part < 1) {
      at = {to, part};
      continue;
    }
    const auto over = [&](double x) noexcept {
      const Rise here = series.at(x);
      return Rise{here.value - 1, here.slope};
    };
    return {at.phase + rising_root(over, 0, 1, std::fmin((1 - at.part) / begun.a, 1)) * length, 1};
  }
  return at;
}

}  // namespace tweenfall::blending
