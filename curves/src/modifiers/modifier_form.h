#pragma once

// What every kind of modifier comes down to: a change of time, a change of value, or both.

#include <tweenfall/curves/modifiers.h>

#include <memory>

#include "math/jet.h"

namespace tweenfall::forms {

/// A time with its derivatives by the time that was asked for, and from which side it is looked at: `in` from earlier
/// times, as they lie on this time's own axis.
struct Moment {
  math::Jet time;
  Side side;
};

class ModifierForm {
 public:
  virtual ~ModifierForm() = default;
  /// The time that lies further in. `memory` goes on to `change` of the same modifier.
  virtual void retime(Moment& moment, double& memory) const noexcept;
  /// The value at the curve's own time.
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

/// The other side, for time that runs the other way.
[[nodiscard]] inline Side opposite(Side side) noexcept {
  return side == Side::in ? Side::out : Side::in;
}

}  // namespace tweenfall::forms
