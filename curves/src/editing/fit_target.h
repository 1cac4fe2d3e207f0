#pragma once

// The curve that keys are fitted to, and the check whether a span between two keys is near enough to it.

#include <tweenfall/curves/fitting.h>

#include "questions/curve_pieces.h"

namespace tweenfall::editing {

/// A candidate span between two times: the keys at its ends, of which only the sides facing the span matter.
template <class T>
struct FittedSpan {
  Key<T> from, to;
};

template <class T>
class FitTarget {
 public:
  enum class Kind { cubic, suited, linear };  ///< cubic: at the curve's slopes; suited: at those of least squares

  /// @throws std::invalid_argument as `fit` does.
  FitTarget(const Curve<T>& curve, double error, const FitOptions& options);

  /// Whether spans of least squares are tried: for numbers and vectors without conversion, if the options say so.
  [[nodiscard]] bool suits() const noexcept { return plain_ && options_.slopes == FitSlopes::least_squares; }
  [[nodiscard]] const Curve<T>& curve() const noexcept { return curve_; }
  /// Times at which one polynomial ends and the next begins, with both ends.
  [[nodiscard]] const std::vector<double>& boundaries() const noexcept { return boundaries_; }

  /// The span from `from` to `to` that is best of its kind. With least squares it leaves at the rate `leaving`, where
  /// given.
  [[nodiscard]] FittedSpan<T> span(double from, double to, Kind kind, const Rate<T>* leaving = nullptr) const;
  [[nodiscard]] bool is_near(const FittedSpan<T>& span, double error) const;
  [[nodiscard]] double error() const noexcept { return error_; }
  /// Differences up to this are only rounding.
  [[nodiscard]] double least_error() const noexcept { return least_error_; }

 private:
  void choose_slopes(Rate<T>& leaving, Rate<T>& arriving, double from, double to, bool leaving_given) const;

  Curve<T> curve_;
  double error_, least_error_ = 0;
  FitOptions options_;
  bool plain_;  // whether differences are polynomials
  std::vector<double> boundaries_;
  std::vector<questions::CurvePiece<typename spans::Stored<T>::type>> pieces_;  // where they are
};

}  // namespace tweenfall::editing
