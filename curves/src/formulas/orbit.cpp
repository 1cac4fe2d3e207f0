#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/functions.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "curve/components.h"
#include "math/keplers_equation.h"

namespace tweenfall::formulas {
namespace {

constexpr double two_pi = 0x1.921fb54442d18p+2;

// In the plane of the orbit, with the center at the origin and the periapsis on the x axis.
struct Place {
  double x, y, x_rate, y_rate;
};

Place on_ellipse(const Orbit& o, double t) noexcept {
  const double a = o.periapsis / (1 - o.eccentricity), n = std::sqrt(o.gravitational_parameter / a) / a;
  const double anomaly = math::eccentric_anomaly(std::remainder(n * t, two_pi), o.eccentricity);
  const elementary::SinCos half = elementary::sin_cos(0.5 * anomaly);
  const double sine = 2 * half.sin * half.cos, fallen = 2 * half.sin * half.sin;  // fallen = 1 - cosine
  const double b = a * std::sqrt((1 - o.eccentricity) * (1 + o.eccentricity));
  const double rate = n * a / (o.periapsis + a * o.eccentricity * fallen);
  return {o.periapsis - a * fallen, b * sine, -a * sine * rate, b * (1 - fallen) * rate};
}

Place on_parabola(const Orbit& o, double t) noexcept {
  // Barker's equation s + s^3 / 3 = m for s, the tangent of half the true anomaly, in Cardano's way.
  const double q = o.periapsis, m = std::sqrt(o.gravitational_parameter / (2 * q)) / q * t;
  const double w = elementary::cbrt(1.5 * std::abs(m) + std::sqrt(2.25 * m * m + 1));
  // w - 1/w, which for small m would be a difference of nearly equal numbers.
  const double w2 = w * w, s = 3 * m / (w2 + 1 + 1 / w2);
  const double rate = std::sqrt(o.gravitational_parameter / (2 * q)) / q / (1 + s * s);
  return {q * (1 - s * s), 2 * q * s, -2 * q * s * rate, 2 * q * rate};
}

Place on_hyperbola(const Orbit& o, double t) noexcept {
  const double a = o.periapsis / (o.eccentricity - 1), n = std::sqrt(o.gravitational_parameter / a) / a;
  const double anomaly = math::hyperbolic_anomaly(n * t, o.eccentricity);
  const double half = elementary::sinh(0.5 * anomaly);
  const double sine = elementary::sinh(anomaly), risen = 2 * half * half;  // risen = hyperbolic cosine - 1
  const double b = a * std::sqrt((o.eccentricity - 1) * (o.eccentricity + 1));
  const double rate = n * a / (o.periapsis + a * o.eccentricity * risen);
  return {o.periapsis - a * risen, b * sine, -a * sine * rate, b * (1 + risen) * rate};
}

void check(const Orbit& o) {
  for (const double v : {o.periapsis, o.eccentricity, o.gravitational_parameter, o.passage})
    if (!std::isfinite(v)) throw std::invalid_argument("an orbit needs finite numbers; one is " + spans::text_of(v));
  if (!spans::all_finite(o.center))
    throw std::invalid_argument("an orbit's center must be finite; it is " + spans::text_of(o.center));
  if (!(o.periapsis > 0))
    throw std::invalid_argument("an orbit's periapsis must be > 0 m; it is " + spans::text_of(o.periapsis));
  if (!(o.eccentricity >= 0))
    throw std::invalid_argument("an orbit's eccentricity must be >= 0; it is " + spans::text_of(o.eccentricity));
  if (!(o.gravitational_parameter > 0))
    throw std::invalid_argument("an orbit's gravitational parameter must be > 0 m^3/s^2; it is " +
                                spans::text_of(o.gravitational_parameter));
}

}  // namespace
}  // namespace tweenfall::formulas

namespace tweenfall {

Orbit Orbit::with_period(double period) const {
  if (!(eccentricity >= 0 && eccentricity < 1))
    throw std::invalid_argument("only an orbit with an eccentricity of 0 to below 1 has a period; it is " +
                                spans::text_of(eccentricity));
  if (!(period > 0) || !std::isfinite(period))
    throw std::invalid_argument("an orbit's period must be finite and > 0 s; it is " + spans::text_of(period));
  const double a = periapsis / (1 - eccentricity), n = formulas::two_pi / period;
  Orbit result = *this;
  result.gravitational_parameter = n * n * a * a * a;
  return result;
}

Curve<Vec3> orbit(const Orbit& settings) {
  formulas::check(settings);
  constexpr double endless = std::numeric_limits<double>::infinity();
  const Mat3 axes = normalized(settings.rotation).toRotationMatrix();
  const auto place = settings.eccentricity < 1   ? formulas::on_ellipse
                     : settings.eccentricity > 1 ? formulas::on_hyperbola
                                                 : formulas::on_parabola;
  return Curve<Vec3>(
      [o = settings, place, x = Vec3(axes.col(0)), y = Vec3(axes.col(1))](double t, Side) {
        const formulas::Place p = place(o, t - o.passage);
        const double distance = std::sqrt(p.x * p.x + p.y * p.y);
        const Vec3 out = p.x * x + p.y * y;
        const double pull = o.gravitational_parameter / (distance * distance * distance);
        return Sample<Vec3>{o.center + out, p.x_rate * x + p.y_rate * y, -pull * out};
      },
      -endless, endless);
}

}  // namespace tweenfall
