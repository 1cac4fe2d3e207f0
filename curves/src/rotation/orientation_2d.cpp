#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/orientation.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tweenfall {

double wrapped(double angle) noexcept {
  // Exact: a multiple of the double nearest to 2 pi is subtracted.
  return std::remainder(angle, 2 * std::numbers::pi);
}

UnitComplex complex_of(double angle) noexcept {
  const auto [sine, cosine] = elementary::sin_cos(angle);
  return {cosine, sine};
}

UnitComplex complex_of(const Mat2& matrix) noexcept {
  return {matrix(0, 0), matrix(1, 0)};
}

Mat2 matrix_of(const UnitComplex& complex) noexcept {
  Mat2 matrix;
  matrix << complex.real, -complex.imaginary, complex.imaginary, complex.real;
  return matrix;
}

Mat2 matrix_of(double angle) noexcept {
  return matrix_of(complex_of(angle));
}

double angle_of(const UnitComplex& complex) noexcept {
  return elementary::atan2(complex.imaginary, complex.real);
}

double angle_of(const Mat2& matrix) noexcept {
  return angle_of(complex_of(matrix));
}

double turned(double angle, double rate, double dt) noexcept {
  return wrapped(angle + rate * dt);
}

Mat2 turned(const Mat2& matrix, double rate, double dt) noexcept {
  return matrix * matrix_of(rate * dt);
}

UnitComplex turned(const UnitComplex& complex, double rate, double dt) noexcept {
  return complex * complex_of(rate * dt);
}

Mat2 turned_to_first_order(const Mat2& matrix, double rate, double dt) noexcept {
  return matrix * matrix_of(UnitComplex{1, rate * dt});
}

UnitComplex turned_to_first_order(const UnitComplex& complex, double rate, double dt) noexcept {
  return complex * UnitComplex{1, rate * dt};
}

UnitComplex renormalized(const UnitComplex& complex) {
  const double length = std::sqrt(complex.real * complex.real + complex.imaginary * complex.imaginary);
  if (!(length > 0) || !std::isfinite(length))
    throw std::invalid_argument("a complex number of length 0, or one that is not finite, turns nothing");
  return {complex.real / length, complex.imaginary / length};
}

Mat2 renormalized(const Mat2& matrix) {
  return matrix_of(renormalized(complex_of(matrix)));
}

double drift(const Mat2& matrix) noexcept {
  return (matrix.transpose() * matrix - Mat2::Identity()).cwiseAbs().maxCoeff();
}

double drift(const UnitComplex& complex) noexcept {
  return std::sqrt(complex.real * complex.real + complex.imaginary * complex.imaginary) - 1;
}

}  // namespace tweenfall
