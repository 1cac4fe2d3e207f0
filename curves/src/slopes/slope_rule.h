#pragma once

// Rules that choose slopes at keys from the neighboring spans, for any number of components at once.

#include <tweenfall/curves/keys.h>

#include <array>
#include <cstddef>

namespace tweenfall {

/// One run of consecutive spans whose slopes a rule has to choose, among all spans of a curve.
struct SlopeProblem {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t spans;        ///< of the whole curve; there is one more key
  std::size_t first, last;  ///< the run: spans first to last - 1
  std::size_t dimensions;
  const double* durations;  ///< s, one per span
  const double* secants;    ///< U/s, `dimensions` per span
  Ends ends;
  const Ease* const* eases;  ///< one per key
  double* leaving;           ///< result, U/s, `dimensions` per span: slope at its start
  double* arriving;          ///< result: slope at its end

  [[nodiscard]] double secant(std::size_t span, std::size_t c) const noexcept { return secants[span * dimensions + c]; }

  /// The span that arrives at a key and the one that leaves it, `none` at an end that does not wrap.
  [[nodiscard]] std::size_t before(std::size_t key) const noexcept {
    return key > 0 ? key - 1 : ends == Ends::wrap ? spans - 1 : none;
  }
  [[nodiscard]] std::size_t after(std::size_t key) const noexcept {
    return key < spans ? key : ends == Ends::wrap ? 0 : none;
  }

  /// For rules with one slope per key: `slope(key, component)`.
  template <class Slope>
  void for_each_key(const Slope& slope) const {
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t c = 0; c < dimensions; ++c) {
        leaving[i * dimensions + c] = i > first ? arriving[(i - 1) * dimensions + c] : slope(i, c);
        arriving[i * dimensions + c] = slope(i + 1, c);
      }
  }

  /// For rules that do not define the ends of the curve: flat, or with a second derivative of zero there.
  void finish_open_ends() const;
};

namespace slopes {

/// Other rules build on this one.
void catmull_rom(const SlopeProblem& problem);

}  // namespace slopes

}  // namespace tweenfall
