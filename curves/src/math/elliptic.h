#pragma once

// Jacobi's elliptic functions of one modulus, by the arithmetic-geometric mean.
// Source: Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, 16.4 and 17.6.

#include <array>

namespace tweenfall::math {

class Elliptic {
 public:
  /// @param parameter   m = k^2, 0 to 1
  /// @param complement  1 - m, > 0; given separately, because close to m = 1 the difference would lose all digits
  Elliptic(double parameter, double complement) noexcept;

  [[nodiscard]] double quarter_period() const noexcept;            ///< K(m)
  [[nodiscard]] double amplitude(double u) const noexcept;         ///< am(u), grows by pi with every 2 K
  [[nodiscard]] double argument(double amplitude) const noexcept;  ///< F, the inverse of it

  /// dn where the amplitude has this cosine; > 0.
  [[nodiscard]] double delta(double cosine) const noexcept;

 private:
  // Even for complements of 1e-300 the means converge in 15 steps.
  static constexpr int most_steps = 20;
  struct Step {
    double a, b, c;
  };
  std::array<Step, most_steps + 1> steps_{};
  int last_ = 0;
  double parameter_, complement_;
};

}  // namespace tweenfall::math
