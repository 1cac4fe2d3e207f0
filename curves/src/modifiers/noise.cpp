#include <cmath>
#include <stdexcept>

#include "curve/components.h"
#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Noise;

// Source: Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014 (splitmix64).
std::uint64_t scrambled(std::uint64_t z) noexcept {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// A slope from -1 to 1 chosen by the whole number `cell`.
double slope_at(double cell, std::uint64_t seed) noexcept {
  const auto index = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
  return static_cast<double>(scrambled(seed ^ scrambled(index)) >> 11) * 0x1p-52 - 1;
}

// Zero at every whole number with a random slope there, joined with continuous second derivative; within -1 to 1.
// Source: Perlin, "Improving noise", 2002, in one dimension.
math::Jet gradient_noise(const math::Jet& x, std::uint64_t seed) noexcept {
  constexpr double most_cells = 4e18;
  const double cell = std::floor(x.v);
  if (!(std::abs(cell) < most_cells)) return {};
  const math::Jet f = x + -cell;
  const math::Jet fade = f * f * f * (f * (6.0 * f + -15.0) + 10.0);
  const math::Jet from = slope_at(cell, seed) * f, to = slope_at(cell + 1, seed) * (f + -1.0);
  return 2.0 * (from + fade * (to - from));
}

class NoiseForm : public ModifierForm {
 public:
  explicit NoiseForm(const Noise& noise) : noise_(noise) {
    double sum = 0, share = 1;
    for (int i = 0; i < noise.layers; ++i, share *= 0.5) sum += share;
    normal_ = noise.strength / sum;
  }

  void change(math::Jet& value, const Moment& m, double) const noexcept override {
    math::Jet x = (1 / noise_.scale) * (m.time + noise_.phase), sum;
    double share = normal_;
    for (int i = 0; i < noise_.layers; ++i, share *= 0.5) {
      sum = sum + share * gradient_noise(x, noise_.seed + static_cast<std::uint64_t>(i));
      x = 2.0 * x;
    }
    switch (noise_.mix) {
      case Noise::Mix::replace:
        value = sum;
        break;
      case Noise::Mix::add:
        value = value + sum;
        break;
      case Noise::Mix::multiply:
        value = value * sum;
        break;
    }
  }

 private:
  Noise noise_;
  double normal_;
};

}  // namespace

FormPointer form_of(const Noise& noise, const Curve<double>&) {
  check_finite(noise.strength, "the strength of noise");
  check_finite(noise.phase, "the phase of noise");
  if (!(noise.scale > 0) || !std::isfinite(noise.scale))
    throw std::invalid_argument("the scale of noise must be > 0 s; it is " + spans::text_of(noise.scale));
  if (noise.layers < 1 || noise.layers > 16)
    throw std::invalid_argument("noise must have 1 to 16 layers; it has " + std::to_string(noise.layers));
  return std::make_unique<const NoiseForm>(noise);
}

}  // namespace tweenfall::forms
