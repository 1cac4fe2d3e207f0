#pragma once

// The spline that is nearest to a sequence of numbers.

#include <cstddef>
#include <vector>

namespace tweenfall::crowd {

/// Uniform cubic B-splines over the numbers 0 to `count` - 1, with a coefficient for every `stride` of them: the
/// coefficients for which the sum of squared distances is least.
class SmoothBase {
 public:
  /// @param count  2 or more  @param stride  1 or more
  SmoothBase(std::size_t count, std::size_t stride);

  [[nodiscard]] std::size_t coefficients() const { return coefficients_; }

  /// @param numbers  `count` of them, this far from each other  @param out  written, `coefficients()` of them
  void fit(const double* numbers, std::size_t apart, double* out) const;

  /// What the spline is at a number. @param from  its coefficients
  [[nodiscard]] double at(std::size_t number, const double* from) const;

 private:
  struct Tap {
    std::size_t first;
    double weights[4];
  };
  [[nodiscard]] Tap tap(std::size_t number) const;

  std::size_t count_, stride_, coefficients_;
  std::vector<double> taps_;    // the weights of each place within a stride, its end included
  std::vector<double> factor_;  // of the normal matrix, by Cholesky: four numbers for each row, the diagonal last
};

}  // namespace tweenfall::crowd
