#include <tweenfall/curves/spring_response.h>

#include <algorithm>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

struct Response {
  double value, first, second;
};

// Step response of x'' + 2 z w x' + w^2 (x - 1) = 0 from rest at 0, at phase w t, derivatives with respect to it.
Response step_response(double phase, double z) noexcept {
  const SpringResponse r = spring_response(phase, z);
  return {1 - r.displaced, r.struck, r.displaced - 2 * z * r.struck};
}

// The response over the span, plus a smooth step that removes the remainder at its end.
// Parameters: frequency in radians per span, damping ratio, remainder.
Warp::Result sprung(double u, const std::array<double, 4>& parameters) noexcept {
  const double w = parameters[0], left = parameters[2];
  const Response r = step_response(w * u, parameters[1]);
  return {r.value + left * u * u * (3 - 2 * u), w * r.first + left * 6 * u * (1 - u),
          w * w * r.second + left * (6 - 12 * u)};
}

}  // namespace

static Pieces spring(double duration, const std::array<double, 4>& parameters) {
  constexpr double turn = 0x1.921fb54442d18p+2;
  // Beyond this no digit of the phase is left.
  const double w = std::min(turn * duration / parameters[0], 1e15);
  Span<double> p{};
  p.degree = 1;
  p.coefficients = {0, 1, 0, 0, 0, 0};
  p.end = 1;
  p.warp = {&sprung, {w, parameters[1], 1 - step_response(w, parameters[1]).value, 0}};
  return {p};
}

extern const Row spring_row{"spring", nullptr, "(period,damping)", [](const Call& call) {
                              call.expect(2, 2, "spring(period,damping), as spring(0.3s,0.5)");
                              return Ease::spring(call.number(0, "s"), call.number(1));
                            }};

}  // namespace tweenfall::eases

namespace tweenfall {

Ease Ease::spring(double period, double damping_ratio) {
  eases::check_range("a spring's period", period, 1e-6, 1e6);
  eases::check_range("a spring's damping ratio", damping_ratio, 0, 1e6);
  const std::array<double, 4> parameters = {period, damping_ratio, 0, 0};
  return Ease(Form{.rule = Rule::shape,
                   .name = "spring(" + number_text(period) + "s," + number_text(damping_ratio) + ")",
                   .parameters = parameters,
                   .shape = &eases::spring,
                   .pieces = eases::spring(1, parameters)});
}

}  // namespace tweenfall
