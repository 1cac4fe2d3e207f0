#pragma once

// The difference of two curves as polynomials on common pieces of time.

#include <vector>

#include "questions/curve_pieces.h"

namespace tweenfall::questions {

/// a - b is the sum of c[i] s^i, s from 0 to 1; `piece` gives the time at s (its own values are those of a).
template <class V>
struct PieceDifference {
  CurvePiece<V> piece;
  std::vector<V> c;
  double rounding;  ///< bound on the error from arithmetic, or from a quintic in place of a formula
};

/// The part of a piece between two of its times.
template <class V>
[[nodiscard]] CurvePiece<V> piece_part(const CurvePiece<V>& piece, double from, double to);

/// Power basis of b as a function of a's position; b has no cubic in time of its own, and covers the time of a.
template <class V>
[[nodiscard]] std::vector<V> composed(const CurvePiece<V>& b, const CurvePiece<V>& a);

/// The differences in order of time, for pieces that cover the same time.
template <class V>
[[nodiscard]] std::vector<PieceDifference<V>> piece_differences(const std::vector<CurvePiece<V>>& a,
                                                                const std::vector<CurvePiece<V>>& b);

}  // namespace tweenfall::questions
