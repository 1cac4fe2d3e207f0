#pragma once

/// How strong a force is over the world's time: a factor that is fixed, keyed or a formula.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/expression.h>

#include <optional>
#include <string>

namespace tweenfall {

/// A factor over the world's time. A world that has it can be saved.
class Strength {
 public:
  Strength(double factor = 1);
  /// Keys. Where their eases are no cubics (`elastic`, `bezier(...)`, ...) cubics take their place, within a billionth
  /// of the greatest value.
  /// @throws std::invalid_argument for a formula, which has no keys, and for values beyond 1e30
  Strength(const Curve<double>& keys);
  /// A formula of t, the world's time in s; where it has no finite value, 0 stands in. Where it leaps (floor, step,
  /// sign, mod, ...) times within a billionth of a second are the leap's; a stage ends a step there.
  /// @throws ExpressionError
  [[nodiscard]] static Strength formula(const std::string& text);

  /// At a time of the world, s. What lies within a billionth of a key's time lies at the key.
  [[nodiscard]] double at(double time, Side side = Side::out) const noexcept;
  /// Whether it may be another somewhere from one time to the other, or jumps at one of them.
  [[nodiscard]] bool changes(double from, double to) const noexcept;

  [[nodiscard]] const std::optional<Curve<double>>& curve() const noexcept { return curve_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }  ///< of a formula

  [[nodiscard]] bool operator==(const Strength& other) const noexcept;

 private:
  double factor_ = 1;
  std::optional<Curve<double>> curve_{};
  std::string text_{};
  std::optional<Expression> formula_{};
};

}  // namespace tweenfall
