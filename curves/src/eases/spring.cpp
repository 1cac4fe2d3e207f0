#include "eases/shapes.h"
#include "formulas/spring_response.h"

namespace tweenfall::shapes {
namespace {

struct Response {
  double value, first, second;
};

// Step response of x'' + 2 z w x' + w^2 (x - 1) = 0 from rest at 0, at phase w t, derivatives with respect to it.
Response step_response(double phase, double z) noexcept {
  const SpringResponse r = spring_response(phase, z);
  return {1 - r.displaced, r.struck, r.displaced - 2 * z * r.struck};
}

// The response over the span, plus what is left at its end, taken away by a smooth step.
// Parameters: frequency in radians a span, damping ratio, what is left.
Warp::Result sprung(double u, const std::array<double, 4>& parameters) noexcept {
  const double w = parameters[0], left = parameters[2];
  const Response r = step_response(w * u, parameters[1]);
  return {r.value + left * u * u * (3 - 2 * u), w * r.first + left * 6 * u * (1 - u),
          w * w * r.second + left * (6 - 12 * u)};
}

}  // namespace

Pieces spring(double duration, const std::array<double, 4>& parameters) {
  constexpr double turn = 0x1.921fb54442d18p+2;
  const double w = turn * duration / parameters[0];
  Span<double> p{};
  p.degree = 1;
  p.coefficients = {0, 1, 0, 0, 0, 0};
  p.end = 1;
  p.warp = {&sprung, {w, parameters[1], 1 - step_response(w, parameters[1]).value, 0}};
  return {p};
}

}  // namespace tweenfall::shapes
