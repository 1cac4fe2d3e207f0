#pragma once

// The difference of two curves as polynomials on common pieces of time.

#include <vector>

#include "questions/curve_pieces.h"

namespace tweenfall::questions {

/// c[i] s^i is what `a` has more than `b`, s from 0 to 1; `piece` tells the time at s (its own values are those of a).
template <class V>
struct PieceDifference {
  CurvePiece<V> piece;
  std::vector<V> c;
  double rounding;  ///< what the arithmetic, or a quintic in a formula's place, may have added
};

/// The part of a piece between two of its times.
template <class V>
[[nodiscard]] CurvePiece<V> piece_part(const CurvePiece<V>& piece, double from, double to);

/// Power basis of b as a function of a's position; b is not timed, and holds over a's time or more.
template <class V>
[[nodiscard]] std::vector<V> composed(const CurvePiece<V>& b, const CurvePiece<V>& a);

/// In order of time, for pieces that cover the same time.
template <class V>
[[nodiscard]] std::vector<PieceDifference<V>> piece_differences(const std::vector<CurvePiece<V>>& a,
                                                                const std::vector<CurvePiece<V>>& b);

}  // namespace tweenfall::questions
