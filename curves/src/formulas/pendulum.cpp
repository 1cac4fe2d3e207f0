#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/functions.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "curve/components.h"
#include "math/elliptic.h"

namespace tweenfall::formulas {
namespace {

using std::numbers::pi;
constexpr double forever = std::numeric_limits<double>::infinity();

// With half the angle, h: h'^2 = w^2 (k^2 - sin^2 h), where k^2 is the energy over that of the top.
struct Swing {
  double frequency;     // w, of small swings, rad/s
  double turns;         // whole turns of the angle at t = 0, subtracted from it
  double sine, cosine;  // of half the angle at t = 0; the cosine is >= 0
  double rate;          // of half the angle over w, at t = 0
  double energy;        // k^2
  double missing;       // 1 - k^2, to its last digit

  explicit Swing(const Pendulum& p) {
    for (const double v : {p.angle, p.rate, p.length, p.gravity})
      if (!std::isfinite(v))
        throw std::invalid_argument("a pendulum needs finite numbers; one is " + spans::text_of(v));
    if (!(p.length > 0))
      throw std::invalid_argument("a pendulum's length must be > 0 m; it is " + spans::text_of(p.length));
    if (!(p.gravity > 0))
      throw std::invalid_argument("a pendulum's gravity must be > 0 m/s^2; it is " + spans::text_of(p.gravity));
    frequency = std::sqrt(p.gravity / p.length);
    turns = std::floor(p.angle / (2 * pi) + 0.5);
    const elementary::SinCos half = elementary::sin_cos(0.5 * (p.angle - turns * 2 * pi));
    sine = half.sin;
    cosine = std::abs(half.cos);
    rate = 0.5 * p.rate / frequency;
    energy = sine * sine + rate * rate;
    missing = (cosine - rate) * (cosine + rate);
  }
};

Curve<double> endless_curve(Curve<double>::Formula formula) {
  return Curve<double>(std::move(formula), -forever, forever);
}

Curve<double> swinging(const Swing& m) {
  const double k = std::sqrt(m.energy), w = m.frequency, offset = m.turns * 2 * pi;
  const math::Elliptic functions(m.energy, m.missing);
  const double begin = functions.argument(elementary::atan2(m.sine, m.rate));
  return endless_curve([=](double t, Side) {
    const elementary::SinCos phi = elementary::sin_cos(functions.amplitude(w * t + begin));
    const double sine = k * phi.sin, cosine = functions.delta(phi.cos);  // of half the angle
    return Sample<double>{offset + 2 * elementary::atan2(sine, cosine), 2 * w * k * phi.cos,
                          -2 * w * w * sine * cosine};
  });
}

Curve<double> turning(const Swing& m) {
  const double k = std::sqrt(m.energy), w = m.frequency, way = m.rate < 0 ? -1 : 1;
  const math::Elliptic functions(1 / m.energy, -m.missing / m.energy);
  const double begin = functions.argument(elementary::atan2(way * m.sine, m.cosine));
  const double offset = m.turns * 2 * pi;
  return endless_curve([=](double t, Side) {
    const double half = functions.amplitude(k * w * t + begin);
    const elementary::SinCos wave = elementary::sin_cos(half);
    return Sample<double>{offset + 2 * way * half, 2 * way * w * k * functions.delta(wave.cos),
                          -2 * way * w * w * wave.sin * wave.cos};
  });
}

// Just fast enough to approach the top without reaching it: half the angle is the Gudermannian function.
Curve<double> creeping(const Swing& m) {
  const double w = m.frequency, way = m.rate < 0 ? -1 : 1, offset = m.turns * 2 * pi;
  if (m.cosine == 0) return Curve<double>(offset + std::copysign(pi, m.sine));
  const double begin = elementary::asinh(way * m.sine / m.cosine);
  return endless_curve([=](double t, Side) {
    const double s = w * t + begin, half = 2 * elementary::atan(elementary::tanh(0.5 * s));
    const double cosine = 1 / elementary::cosh(s);
    return Sample<double>{offset + 2 * way * half, 2 * way * w * cosine,
                          -2 * way * w * w * elementary::tanh(s) * cosine};
  });
}

}  // namespace
}  // namespace tweenfall::formulas

namespace tweenfall {

Curve<double> pendulum(const Pendulum& settings) {
  const formulas::Swing m(settings);
  if (m.energy == 0) return Curve<double>(m.turns * 2 * formulas::pi);
  return m.missing > 0 ? formulas::swinging(m) : m.missing < 0 ? formulas::turning(m) : formulas::creeping(m);
}

double pendulum_period(const Pendulum& settings) {
  const formulas::Swing m(settings);
  if (m.missing == 0) return formulas::forever;
  if (m.missing > 0) return 4 * math::Elliptic(m.energy, m.missing).quarter_period() / m.frequency;
  return 2 * math::Elliptic(1 / m.energy, -m.missing / m.energy).quarter_period() / (m.frequency * std::sqrt(m.energy));
}

}  // namespace tweenfall
