#pragma once

// The common form of all modifiers: a change of time, a change of value, or both.

#include <tweenfall/curves/modifiers.h>

#include <memory>

#include "math/jet.h"

namespace tweenfall::forms {

/// A time with its derivatives with respect to the time sampled, and the side of the limit: `in` is that from earlier
/// times, on this time's own axis.
struct Moment {
  math::Jet time;
  Side side;
};

class ModifierForm {
 public:
  virtual ~ModifierForm() = default;
  /// Replaces the time by that of the next layer inward. `memory` is passed on to `change` of the same modifier.
  virtual void retime(Moment& moment, double& memory) const noexcept;
  /// Changes the value; `moment` is in the curve's own time.
  virtual void change(math::Jet& value, const Moment& moment, double memory) const noexcept;
};

using FormPointer = std::unique_ptr<const ModifierForm>;

/// @throws std::invalid_argument saying what is wrong.
[[nodiscard]] FormPointer form_of(const modifiers::Cycles& cycles, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Noise& noise, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Generator& generator, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::BuiltIn& function, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Stepped& stepped, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Limits& limits, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Envelope& envelope, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::TimeWarp& warp, const Curve<double>& curve);
[[nodiscard]] FormPointer form_of(const modifiers::Placement& placement, const Curve<double>& curve);

/// @throws std::invalid_argument "NAME must be finite; it is ...".
void check_finite(double value, const char* name);

/// The other side, for time that runs backwards.
[[nodiscard]] inline Side opposite(Side side) noexcept {
  return side == Side::in ? Side::out : Side::in;
}

}  // namespace tweenfall::forms
