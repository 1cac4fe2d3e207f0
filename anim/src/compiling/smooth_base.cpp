#include "compiling/smooth_base.h"

#include <algorithm>
#include <cmath>

#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

namespace {

constexpr std::size_t band = 4;

}  // namespace

SmoothBase::SmoothBase(std::size_t count, std::size_t stride)
    : count_(count), stride_(stride), coefficients_((count - 2) / stride + 4) {
  taps_.resize(4 * (stride + 1));
  for (std::size_t i = 0; i <= stride; ++i)
    spline_weights(static_cast<double>(i) / static_cast<double>(stride), &taps_[4 * i]);
  factor_.assign(band * coefficients_, 0.0);
  for (std::size_t number = 0; number < count_; ++number) {
    const Tap at = tap(number);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        factor_[band * (at.first + i) + band - 1 - (i - k)] += at.weights[i] * at.weights[k];
  }
  // Where few numbers lie in the last stride they do not determine all coefficients; a little stiffness does.
  const double stiffness = 1e-6;
  const double second[3] = {1, -2, 1};
  for (std::size_t first = 0; first + 3 <= coefficients_; ++first)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        factor_[band * (first + i) + band - 1 - (i - k)] += stiffness * second[i] * second[k];
  for (std::size_t row = 0; row < coefficients_; ++row) factor_[band * row + band - 1] += 1e-12;

  for (std::size_t row = 0; row < coefficients_; ++row) {
    const std::size_t begin = row >= band - 1 ? row - (band - 1) : 0;
    for (std::size_t column = begin; column <= row; ++column) {
      double& entry = factor_[band * row + band - 1 - (row - column)];
      for (std::size_t k = std::max(begin, column >= band - 1 ? column - (band - 1) : 0); k < column; ++k)
        entry -= factor_[band * row + band - 1 - (row - k)] * factor_[band * column + band - 1 - (column - k)];
      if (column < row)
        entry /= factor_[band * column + band - 1];
      else
        entry = std::sqrt(std::max(entry, 1e-14));
    }
  }
}

SmoothBase::Tap SmoothBase::tap(std::size_t number) const {
  const std::size_t first = std::min(number, count_ - 2) / stride_;
  const double* weights = &taps_[4 * (number - first * stride_)];
  return {first, {weights[0], weights[1], weights[2], weights[3]}};
}

void SmoothBase::fit(const double* numbers, std::size_t apart, double* out) const {
  std::fill_n(out, coefficients_, 0.0);
  for (std::size_t number = 0; number < count_; ++number) {
    const Tap at = tap(number);
    for (std::size_t i = 0; i < 4; ++i) out[at.first + i] += at.weights[i] * numbers[number * apart];
  }
  for (std::size_t row = 0; row < coefficients_; ++row) {
    for (std::size_t k = row >= band - 1 ? row - (band - 1) : 0; k < row; ++k)
      out[row] -= factor_[band * row + band - 1 - (row - k)] * out[k];
    out[row] /= factor_[band * row + band - 1];
  }
  for (std::size_t row = coefficients_; row-- > 0;) {
    for (std::size_t k = row + 1; k < std::min(row + band, coefficients_); ++k)
      out[row] -= factor_[band * k + band - 1 - (k - row)] * out[k];
    out[row] /= factor_[band * row + band - 1];
  }
}

double SmoothBase::at(std::size_t number, const double* from) const {
  const Tap place = tap(number);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += place.weights[i] * from[place.first + i];
  return sum;
}

}  // namespace tweenfall::crowd
