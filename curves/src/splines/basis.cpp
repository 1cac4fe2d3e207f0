#include <tweenfall/curves/basis.h>
#include <tweenfall/curves/span.h>

#include <stdexcept>
#include <string>

namespace tweenfall::splines {
namespace {

void check_degree(int degree) {
  if (degree < 0 || degree > max_degree)
    throw std::invalid_argument("a basis has a degree from 0 to " + std::to_string(max_degree) + "; it is " +
                                std::to_string(degree));
}

// A polynomial whose index lies outside the basis is zero.
double bernstein_value(int degree, int index, double u) noexcept {
  if (index < 0 || index > degree || degree < 0) return 0;
  double weight = 1;
  for (int i = 0; i < index; ++i) weight *= u * (degree - i) / (i + 1);
  for (int i = index; i < degree; ++i) weight *= 1 - u;
  return weight;
}

struct Basis {
  std::span<const double> knots;
  double t;
  bool arriving;

  [[nodiscard]] double value(int degree, std::size_t i) const noexcept {
    if (degree == 0) {
      if (arriving) return knots[i] < t && t <= knots[i + 1] ? 1 : 0;
      return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
    }
    const std::size_t p = static_cast<std::size_t>(degree);
    double result = 0;
    if (knots[i + p] > knots[i]) result += (t - knots[i]) / (knots[i + p] - knots[i]) * value(degree - 1, i);
    if (knots[i + p + 1] > knots[i + 1])
      result += (knots[i + p + 1] - t) / (knots[i + p + 1] - knots[i + 1]) * value(degree - 1, i + 1);
    return result;
  }

  [[nodiscard]] double derivative(int degree, std::size_t i, int order) const noexcept {
    if (order == 0) return value(degree, i);
    if (degree == 0) return 0;
    const std::size_t p = static_cast<std::size_t>(degree);
    double result = 0;
    if (knots[i + p] > knots[i]) result += degree / (knots[i + p] - knots[i]) * derivative(degree - 1, i, order - 1);
    if (knots[i + p + 1] > knots[i + 1])
      result -= degree / (knots[i + p + 1] - knots[i + 1]) * derivative(degree - 1, i + 1, order - 1);
    return result;
  }
};

}  // namespace
}  // namespace tweenfall::splines

namespace tweenfall {

Sample<double> bernstein(int degree, int index, double u) {
  splines::check_degree(degree);
  if (index < 0 || index > degree)
    throw std::invalid_argument("Bernstein polynomials of degree " + std::to_string(degree) +
                                " are numbered from 0 to " + std::to_string(degree) + "; there is no number " +
                                std::to_string(index));
  const auto lower = [index, u](int lower_degree, int by) {
    return splines::bernstein_value(lower_degree, index - by, u);
  };
  return {lower(degree, 0), degree * (lower(degree - 1, 1) - lower(degree - 1, 0)),
          degree * (degree - 1) * (lower(degree - 2, 2) - 2 * lower(degree - 2, 1) + lower(degree - 2, 0))};
}

Sample<double> b_spline_basis(std::span<const double> knots, int degree, std::size_t index, double t, Side side) {
  splines::check_degree(degree);
  const std::size_t needed = index + static_cast<std::size_t>(degree) + 2;
  if (knots.size() < needed)
    throw std::invalid_argument("basis function " + std::to_string(index) + " of degree " + std::to_string(degree) +
                                " needs " + std::to_string(needed) + " knots; " + std::to_string(knots.size()) +
                                " were given");
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (!(knots[i] >= knots[i - 1]))
      throw std::invalid_argument("knots must not decrease; number " + std::to_string(i) + " does");
  const splines::Basis basis{knots, t, side == Side::in || t == knots.back()};
  return {basis.value(degree, index), basis.derivative(degree, index, 1), basis.derivative(degree, index, 2)};
}

}  // namespace tweenfall
