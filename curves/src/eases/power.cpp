#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// u^e for any e > 0. A first or second derivative that is infinite at 0 is limited to a million.
Warp::Result powered(double u, const std::array<double, 4>& parameters) noexcept {
  const double e = parameters[0];
  constexpr double most = 1e6;
  if (u <= 0) return {0, e < 1 ? most : 0, e > 1 && e < 2 ? most : 0};
  const double s = elementary::pow(u, e), first = e * s / u, second = (e - 1) * first / u;
  if (e < 1 && first > most) return {s, most, 0};
  return {s, first, e < 2 ? std::min(second, most) : second};
}

}  // namespace

// Source: Penner, "Robert Penner's Programming Macromedia Flash MX", 2002, chapter 7.
static Pieces power(int degree, Flow flow) {
  std::vector<double> c(static_cast<std::size_t>(degree) + 1, 0.0);
  c.back() = 1;
  return flowing(WayIn{c}, flow);
}

static Pieces power(double exponent, Flow flow) {
  if (exponent == std::floor(exponent) && exponent <= max_degree) return power(static_cast<int>(exponent), flow);
  return flowing(WayIn{{0, 1}, {&powered, {exponent, 0, 0, 0}}, &reversed<&powered>}, flow);
}

// u^2 ((overshoot + 1) u - overshoot).
static Pieces back(double overshoot, Flow flow) {
  return flowing(WayIn{{0, 0, -overshoot, overshoot + 1}}, flow);
}

extern const FamilyRow quad_family{"quad", [](const Numbers&, Flow flow) { return power(2, flow); }};
extern const FamilyRow cubic_family{"cubic", [](const Numbers&, Flow flow) { return power(3, flow); }};
extern const FamilyRow quart_family{"quart", [](const Numbers&, Flow flow) { return power(4, flow); }};
extern const FamilyRow quint_family{"quint", [](const Numbers&, Flow flow) { return power(5, flow); }};
extern const FamilyRow poly_family{
    "poly", [](const Numbers& n, Flow flow) { return power(n[0], flow); }, {{{"exponent", 3, 1e-6, 1e6}}}};
extern const FamilyRow back_family{
    "back", [](const Numbers& n, Flow flow) { return back(n[0], flow); }, {{{"overshoot", 1.70158, -1e6, 1e6}}}};

}  // namespace tweenfall::eases
