#pragma once

// The least-squares spline of a sequence of numbers.

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

  /// @param numbers `count` of them, `apart` places from each other @param out  written, `coefficients()` of them
  void fit(const double* numbers, std::size_t apart, double* out) const;

  /// The value of the spline at a number. @param from  its coefficients
  [[nodiscard]] double at(std::size_t number, const double* from) const;

 private:
  struct Tap {
    std::size_t first;
    double weights[4];
  };
  [[nodiscard]] Tap tap(std::size_t number) const;

  std::size_t count_, stride_, coefficients_;
  std::vector<double> taps_;    // the weights at each place within a stride, including its end
  std::vector<double> factor_;  // of the normal matrix, by Cholesky: four numbers for each row, the diagonal last
};

}  // namespace tweenfall::crowd
