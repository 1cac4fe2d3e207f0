#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <numbers>

#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::BuiltIn;

using std::numbers::pi;

math::Jet sinc(const math::Jet& x) noexcept {
  const math::Jet y = pi * x;
  if (std::abs(y.v) < 1e-2) {
    // sin(y) / y and its derivatives as series; the first term left out is below 1e-16.
    const double s = y.v * y.v;
    return math::chained(y, 1 - s / 6 * (1 - s / 20 * (1 - s / 42)), -y.v / 3 * (1 - s / 10 * (1 - s / 28)),
                         -(1 - s * (3.0 / 10) * (1 - s * (5.0 / 84))) / 3);
  }
  const elementary::SinCos wave = elementary::sin_cos(y.v);
  return math::chained(y, wave.sin, wave.cos, -wave.sin) * math::reciprocal(y);
}

class BuiltInForm : public ModifierForm {
 public:
  explicit BuiltInForm(const BuiltIn& function) : f_(function) {}

  void change(math::Jet& value, const Moment& m, double) const noexcept override {
    const math::Jet x = f_.multiplier * m.time + f_.phase;
    math::Jet result;
    switch (f_.function) {
      case BuiltIn::Function::sin: {
        const elementary::SinCos w = elementary::sin_cos(x.v);
        result = math::chained(x, w.sin, w.cos, -w.sin);
        break;
      }
      case BuiltIn::Function::cos: {
        const elementary::SinCos w = elementary::sin_cos(x.v);
        result = math::chained(x, w.cos, -w.sin, -w.cos);
        break;
      }
      case BuiltIn::Function::tan: {
        if (elementary::cos(x.v) == 0) return;
        const double tan = elementary::tan(x.v), first = 1 + tan * tan;
        result = math::chained(x, tan, first, 2 * tan * first);
        break;
      }
      case BuiltIn::Function::sqrt: {
        if (!(x.v > 0)) return;
        const double root = std::sqrt(x.v);
        result = math::chained(x, root, 0.5 / root, -0.25 / (root * x.v));
        break;
      }
      case BuiltIn::Function::ln: {
        if (!(x.v > 0)) return;
        result = math::chained(x, elementary::log(x.v), 1 / x.v, -1 / (x.v * x.v));
        break;
      }
      case BuiltIn::Function::sinc:
        result = sinc(x);
        break;
    }
    result = f_.amplitude * result + f_.offset;
    value = f_.additive ? value + result : result;
  }

 private:
  BuiltIn f_;
};

}  // namespace

FormPointer form_of(const BuiltIn& function, const Curve<double>&) {
  check_finite(function.amplitude, "a function's amplitude");
  check_finite(function.multiplier, "a function's multiplier");
  check_finite(function.phase, "a function's phase");
  check_finite(function.offset, "a function's offset");
  return std::make_unique<const BuiltInForm>(function);
}

}  // namespace tweenfall::forms
