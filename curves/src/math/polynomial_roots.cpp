#include "math/polynomial_roots.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::math {

double polynomial_value(const std::vector<double>& c, double s) noexcept {
  double value = 0;
  for (auto i = c.rbegin(); i != c.rend(); ++i) value = value * s + *i;
  return value;
}

std::vector<double> polynomial_derivative(const std::vector<double>& c) {
  std::vector<double> result;
  for (std::size_t i = 1; i < c.size(); ++i) result.push_back(static_cast<double>(i) * c[i]);
  return result;
}

std::vector<double> polynomial_roots(const std::vector<double>& given, double low, double high) {
  std::vector<double> c = given;
  while (!c.empty() && c.back() == 0) c.pop_back();
  if (c.size() < 2) return {};
  if (c.size() == 2) {
    const double s = -c[0] / c[1];
    return s >= low && s <= high ? std::vector<double>{s} : std::vector<double>{};
  }
  double scale = 0;
  for (const double v : c) scale = std::max(scale, std::abs(v));
  // Rounding of Horner's rule; a value below it counts as touching.
  const double noise = 4e-16 * scale;
  std::vector<double> marks = {low};
  for (const double s : polynomial_roots(polynomial_derivative(c), low, high)) marks.push_back(s);
  marks.push_back(high);
  std::vector<double> roots;
  const auto add = [&roots](double s) {
    if (roots.empty() || s - roots.back() > 1e-12) roots.push_back(s);
  };
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const double at = polynomial_value(c, marks[i]);
    if (std::abs(at) <= noise) add(marks[i]);
    if (i + 1 == marks.size()) break;
    double a = marks[i], b = marks[i + 1];
    const double at_b = polynomial_value(c, b);
    if (std::abs(at) <= noise || std::abs(at_b) <= noise || (at > 0) == (at_b > 0)) continue;
    for (int n = 0; n < 200 && b - a > 0; ++n) {
      const double m = 0.5 * (a + b);
      if (m <= a || m >= b) break;
      ((polynomial_value(c, m) > 0) == (at > 0) ? a : b) = m;
    }
    add(0.5 * (a + b));
  }
  return roots;
}

}  // namespace tweenfall::math
