#pragma once

namespace tweenfall::eases {

/// 2^(-10 x), shifted and scaled so that it leads from exactly 1 at 0 to exactly 0 at 1, with its derivatives.
struct Decay {
  double value, first, second;
};
[[nodiscard]] Decay decay(double x) noexcept;

}  // namespace tweenfall::eases
