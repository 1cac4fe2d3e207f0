#include "math/symmetric_eigen.h"

#include <cmath>

namespace tweenfall::math {

SymmetricEigen symmetric_eigen(const Mat4& matrix) noexcept {
  Mat4 a = matrix, v = Mat4::Identity();
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool turned = false;
    for (int p = 0; p < 3; ++p)
      for (int q = p + 1; q < 4; ++q) {
        const double off = a(p, q), tiny = 1e-18 * (std::abs(a(p, p)) + std::abs(a(q, q)));
        if (!(std::abs(off) > tiny)) continue;
        turned = true;
        const double theta = (a(q, q) - a(p, p)) / (2 * off);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double x = a(k, p), y = a(k, q);
          a(k, p) = c * x - s * y;
          a(k, q) = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = a(p, k), y = a(q, k);
          a(p, k) = c * x - s * y;
          a(q, k) = s * x + c * y;
        }
        for (int k = 0; k < 4; ++k) {
          const double x = v(k, p), y = v(k, q);
          v(k, p) = c * x - s * y;
          v(k, q) = s * x + c * y;
        }
      }
    if (!turned) break;
  }
  SymmetricEigen result;
  bool taken[4] = {false, false, false, false};
  for (int place = 0; place < 4; ++place) {
    int best = -1;
    for (int k = 0; k < 4; ++k)
      if (!taken[k] && (best < 0 || a(k, k) > a(best, best))) best = k;
    taken[best] = true;
    result.values[place] = a(best, best);
    result.vectors.col(place) = v.col(best);
  }
  return result;
}

}  // namespace tweenfall::math
