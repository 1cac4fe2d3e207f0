#pragma once

#include <tweenfall/curves/values.h>

#include <bit>
#include <cstdint>

namespace tweenfall::state {

/// Whether nothing is lost where it is taken for 0: a -0 is another number when it is saved.
[[nodiscard]] inline bool blank(double value) {
  return std::bit_cast<std::uint64_t>(value) == 0;
}
[[nodiscard]] inline bool blank(const Vec3& value) {
  return blank(value.x()) && blank(value.y()) && blank(value.z());
}

}  // namespace tweenfall::state
