#pragma once

#include <tweenfall/curves/values.h>

#include <bit>
#include <cstdint>

namespace tweenfall::state {

/// Whether a value may be replaced by 0: -0 may not, as it is saved as another number.
[[nodiscard]] inline bool blank(double value) {
  return std::bit_cast<std::uint64_t>(value) == 0;
}
[[nodiscard]] inline bool blank(const Vec3& value) {
  return blank(value.x()) && blank(value.y()) && blank(value.z());
}

}  // namespace tweenfall::state
