#pragma once

/// How strong a force is over the world's time: a factor that is fixed, keyed or a formula.

#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/expression.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// A factor over the world's time. It can be saved with the world.
class Strength {
 public:
  Strength(double factor = 1);
  /// Keys. Eases that are not cubics (`elastic`, `bezier(...)`, ...) are replaced by cubics, within a billionth
  /// of the greatest value.
  /// @throws std::invalid_argument for a formula, which has no keys, and for values beyond 1e30
  Strength(const Curve<double>& keys);
  /// A formula of t, the world's time in s; where it has no finite value, it counts as 0. Where it jumps (floor, step,
  /// sign, mod, ...), times within a billionth of a second count as the time of the jump; a stage ends a step there.
  /// @throws ExpressionError
  [[nodiscard]] static Strength formula(const std::string& text);

  /// At a time of the world, s. Times within a billionth of a second of a key count as the key's.
  [[nodiscard]] double at(double time, Side side = Side::out) const noexcept;
  /// Whether it may vary anywhere from one time to the other, or jumps at either of them.
  [[nodiscard]] bool changes(double from, double to) const noexcept;

  [[nodiscard]] const std::optional<Curve<double>>& curve() const noexcept { return curve_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }  ///< of a formula
  /// The parts of a formula that leap from one value to another.
  [[nodiscard]] const std::vector<Expression>& leaping_parts() const noexcept { return leaping_; }

  [[nodiscard]] bool operator==(const Strength& other) const noexcept;

 private:
  double factor_ = 1;
  std::optional<Curve<double>> curve_{};
  std::string text_{};
  std::optional<Expression> formula_{};
  std::vector<Expression> leaping_{};  ///< parts of it that leap
};

}  // namespace tweenfall
