#include <tweenfall/curves/symmetric_eigen.h>

#include <array>
#include <cmath>

namespace tweenfall {

namespace math {
namespace {

template <int rows>
using Square = Eigen::Matrix<double, rows, rows, Eigen::DontAlign>;

template <int rows>
SymmetricEigen<rows> jacobi(const Square<rows>& matrix) {
  Square<rows> a = matrix, v = Square<rows>::Identity();
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool turned = false;
    for (int p = 0; p < rows - 1; ++p)
      for (int q = p + 1; q < rows; ++q) {
        const double off = a(p, q), tiny = 1e-18 * (std::abs(a(p, p)) + std::abs(a(q, q)));
        if (!(std::abs(off) > tiny)) continue;
        turned = true;
        const double theta = (a(q, q) - a(p, p)) / (2 * off);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < rows; ++k) {
          const double x = a(k, p), y = a(k, q);
          a(k, p) = c * x - s * y;
          a(k, q) = s * x + c * y;
        }
        for (int k = 0; k < rows; ++k) {
          const double x = a(p, k), y = a(q, k);
          a(p, k) = c * x - s * y;
          a(q, k) = s * x + c * y;
        }
        for (int k = 0; k < rows; ++k) {
          const double x = v(k, p), y = v(k, q);
          v(k, p) = c * x - s * y;
          v(k, q) = s * x + c * y;
        }
      }
    if (!turned) break;
  }
  SymmetricEigen<rows> result;
  std::array<bool, rows> taken{};
  for (int place = 0; place < rows; ++place) {
    int best = -1;
    for (int k = 0; k < rows; ++k)
      if (!taken[static_cast<std::size_t>(k)] && (best < 0 || a(k, k) > a(best, best))) best = k;
    taken[static_cast<std::size_t>(best)] = true;
    result.values[place] = a(best, best);
    result.vectors.col(place) = v.col(best);
  }
  return result;
}

}  // namespace
}  // namespace math

SymmetricEigen<3> symmetric_eigen(const math::Square<3>& matrix) noexcept {
  return math::jacobi<3>(matrix);
}

SymmetricEigen<4> symmetric_eigen(const math::Square<4>& matrix) noexcept {
  return math::jacobi<4>(matrix);
}

}  // namespace tweenfall
