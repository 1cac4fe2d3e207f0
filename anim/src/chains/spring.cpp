#include <tweenfall/anim/spring.h>
#include <tweenfall/curves/spring_response.h>

#include "chains/problems.h"
#include "chains/spring_forcing.h"
#include "chains/state_bytes.h"

#include <numbers>

namespace tweenfall {
namespace chains {
namespace {

// The solution by power series, which converges quickly while the product of rates and seconds is small, without
// cancellation.
struct Series {
  double square, drag, s;  // w^2, 2 z w, seconds

  /// Value and rate at s of the motion from `value` and `rate` under the acceleration s^power, or none for -1.
  [[nodiscard]] std::pair<double, double> at(double value, double rate, int power) const noexcept {
    double before = value, last = rate, term = 1, sum = value + rate * s, slope = rate;
    for (int n = 0; n < 48; ++n) {
      const double next = ((n == power ? 1 : 0) - drag * (n + 1) * last - square * before) / ((n + 1.0) * (n + 2.0));
      before = last;
      last = next;
      term *= s;  // s^(n+1)
      slope += (n + 2) * next * term;
      sum += next * term * s;
    }
    return {sum, slope};
  }
};

// exp of a moving vector. With x = |r|^2, b = (1 - cos |r|) / x and c = (1 - sin |r| / |r|) / x, it turns with r' + b r
// x r' + c r x (r x r'): the left Jacobian, from the source of `right_jacobian`; the acceleration is its derivative.
Sample<Quat> exponential(const Sample<Vec3>& r) noexcept {
  const double x = r.value.squaredNorm(), x_rate = 2 * r.value.dot(r.rate);
  double b = 0, c = 0, b_slope = 0, c_slope = 0;
  double term = 0.5, before = 0;  // (-x)^n / (2n + 2)! and the one before without its x
  for (int n = 0; n < 26; ++n) {
    b += term;
    c += term / (2 * n + 3);
    b_slope += n * before;
    c_slope += n * before / (2 * n + 3);
    const double next = -1 / ((2 * n + 3.0) * (2 * n + 4.0));
    before = term * next;
    term *= next * x;
  }
  const Vec3 first = r.value.cross(r.rate), twice = r.value.cross(first);
  Sample<Quat> result;
  result.value = exp_map(r.value);
  result.rate = r.rate + b * first + c * twice;
  result.acceleration = r.acceleration + b * r.value.cross(r.acceleration) +
                        c * r.value.cross(r.value.cross(r.acceleration)) + (x_rate * b_slope) * first +
                        (x_rate * c_slope) * twice + c * r.rate.cross(first);
  return result;
}

// Acceleration of an offset, by the spring's equation.
Vec3 acceleration_of(const SpringFollower& spring, const Arrow& offset, const Forcing& driven, double s) noexcept {
  const double w = 2 * std::numbers::pi * spring.settings().hz;
  const Vec3 push = driven.parts[0] + s * (driven.parts[1] + s * (driven.parts[2] + s * driven.parts[3]));
  return push - (w * w) * offset.v - (2 * spring.settings().damping * w) * offset.d;
}

}  // namespace
}  // namespace chains

std::vector<std::byte> SpringState::bytes() const {
  chains::StateWriter out;
  out.number(step);
  out.vector(offset);
  out.vector(rate);
  return out.bytes;
}

SpringState SpringState::from_bytes(std::span<const std::byte> bytes) {
  chains::StateReader in{bytes, "spring state"};
  SpringState state;
  in.require_size(56);
  state.step = in.number();
  state.offset = in.vector();
  state.rate = in.vector();
  return state;
}

SpringFollower::SpringFollower(const SpringSettings& settings)
    : settings_(settings), frequency_(2 * std::numbers::pi * settings.hz) {
  chains::Problems problems("spring");
  problems.at({"hz"}).require_in(settings.hz, 0, 1e5, "hz");
  problems.at({"damping"}).require_in(settings.damping, 0, 100, "damping");
  problems.at({"gravity"}).require_finite(settings.gravity, "gravity");
  problems.at({"steps_per_second"}).require_in(settings.steps_per_second, 1, 1e5, "steps_per_second");
  problems.report();
  of_step_ = shares(1 / settings_.steps_per_second);
}

double SpringFollower::time_of(std::int64_t step) const noexcept {
  return static_cast<double>(step) / settings_.steps_per_second;
}

std::int64_t SpringFollower::step_at(double time) const noexcept {
  constexpr double most = 0x1p52;
  const double point = std::floor(time * settings_.steps_per_second);
  std::int64_t step = static_cast<std::int64_t>(std::clamp(point, -most, most));
  if (!(point == point)) return 0;
  // The product is rounded, so compare with the points themselves.
  if (time_of(step) > time) --step;
  if (time_of(step + 1) <= time && step < static_cast<std::int64_t>(most)) ++step;
  return step;
}

SpringShares SpringFollower::shares(double s) const noexcept {
  const double w = frequency_, z = settings_.damping, square = w * w, drag = 2 * z * w;
  SpringShares shares;
  if ((1 + 2 * z) * w * s < 2) {
    const chains::Series series{square, drag, s};
    std::tie(shares.offset, shares.offset_in_rate) = series.at(1, 0, -1);
    std::tie(shares.rate, shares.rate_in_rate) = series.at(0, 1, -1);
    for (int i = 0; i < 4; ++i) std::tie(shares.forced[i], shares.forced_in_rate[i]) = series.at(0, 0, i);
    return shares;
  }
  const SpringResponse response = spring_response(w * s, z);
  shares.offset = response.displaced;
  shares.offset_in_rate = -w * response.struck;
  shares.rate = response.struck / w;
  shares.rate_in_rate = response.displaced - 2 * z * response.struck;
  // The response to s^j is j times the integral of the response to s^(j-1); the spring's equation then gives its value.
  shares.forced[0] = (1 - shares.offset) / square;
  shares.forced_in_rate[0] = shares.rate;
  double power = 1;
  for (int j = 1; j < 4; ++j) {
    power *= s;
    shares.forced_in_rate[j] = j * shares.forced[j - 1];
    shares.forced[j] = (power - drag * shares.forced_in_rate[j] - j * shares.forced_in_rate[j - 1]) / square;
  }
  return shares;
}

SpringState SpringFollower::at_rest(double time) const noexcept {
  SpringState state;
  state.step = step_at(time);
  return state;
}

Sample<Vec3> SpringFollower::follow(SpringState& state, double time,
                                    const std::function<Sample<Vec3>(double)>& target) const noexcept {
  using namespace chains;
  Forcing driven;
  const Arrow offset = offset_at(*this, state, time, target, [&](const Sample<Vec3>& from, const Sample<Vec3>& to) {
    return driven = forcing(from, to, 1 / settings_.steps_per_second, settings_.gravity);
  });
  const Sample<Vec3> now = target(time);
  return {now.value + offset.v, now.rate + offset.d,
          now.acceleration + acceleration_of(*this, offset, driven, seconds_into(*this, state.step, time))};
}

Sample<Quat> SpringFollower::follow(SpringState& state, double time,
                                    const std::function<Sample<Quat>(double)>& target) const noexcept {
  using namespace chains;
  const Vec3 none(0, 0, 0);
  Forcing driven;
  const Arrow offset = offset_at(*this, state, time, target, [&](const Sample<Quat>& from, const Sample<Quat>& to) {
    const Vec3 way = log_map(to.value * from.value.conjugate());
    return driven = forcing(Sample<Vec3>{none, from.rate, from.acceleration},
                            Sample<Vec3>{way, to.rate, to.acceleration}, 1 / settings_.steps_per_second, none);
  });
  const Sample<Vec3> away{offset.v, offset.d,
                          acceleration_of(*this, offset, driven, seconds_into(*this, state.step, time))};
  return product(exponential(away), target(time));
}

}  // namespace tweenfall
