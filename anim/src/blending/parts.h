#pragma once

// What is found in steps, the steps so short that they do not count.

namespace tweenfall::blending {

/// Romberg's scheme: what is wrong by even powers of the steps' length alone, without the first two of them.
/// @param in_parts  what comes out of so many equal steps
template <class InParts>
[[nodiscard]] double extrapolated(const InParts& in_parts) noexcept {
  const double one = in_parts(1), two = in_parts(2), four = in_parts(4);
  const double better = two + (two - one) / 3, best = four + (four - two) / 3;
  return best + (best - better) / 15;
}

}  // namespace tweenfall::blending
