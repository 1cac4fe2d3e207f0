#pragma once

// The limit of a result computed in steps as the steps become infinitely short.

namespace tweenfall::blending {

/// Romberg's scheme for results whose errors are in even powers of the step length: removes the first two.
/// @param in_parts the result for a given number of equal steps
template <class InParts>
[[nodiscard]] double extrapolated(const InParts& in_parts) noexcept {
  const double one = in_parts(1), two = in_parts(2), four = in_parts(4);
  const double better = two + (two - one) / 3, best = four + (four - two) / 3;
  return best + (best - better) / 15;
}

}  // namespace tweenfall::blending
