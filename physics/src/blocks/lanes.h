#pragma once

/// Four doubles side by side. Each operation rounds as it does for one double, so that the bits are the same whatever
/// the processor does at once.

#include <cstdint>

namespace tweenfall::blocks {

constexpr int lane_count = 4;

using Lanes = double __attribute__((vector_size(32), aligned(32)));
using Mask = std::int64_t __attribute__((vector_size(32), aligned(32)));

/// What is inlined into a function takes that function's instruction set.
#define TWEENFALL_LANES [[gnu::always_inline]] inline

// How vectors would be passed to functions that are not inlined does not matter here: all are.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

TWEENFALL_LANES Lanes all(double value) {
  return Lanes{value, value, value, value};
}
TWEENFALL_LANES Lanes select(const Mask& which, const Lanes& yes, const Lanes& no) {
  return reinterpret_cast<Lanes>((which & reinterpret_cast<Mask>(yes)) | (~which & reinterpret_cast<Mask>(no)));
}
TWEENFALL_LANES Lanes greater(const Lanes& a, const Lanes& b) {
  return select(a > b, a, b);
}
TWEENFALL_LANES Lanes lesser(const Lanes& a, const Lanes& b) {
  return select(a < b, a, b);
}
TWEENFALL_LANES bool any(const Mask& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}
TWEENFALL_LANES Lanes root(const Lanes& value) {
  return Lanes{__builtin_sqrt(value[0]), __builtin_sqrt(value[1]), __builtin_sqrt(value[2]), __builtin_sqrt(value[3])};
}

/// Four vectors.
struct Lanes3 {
  Lanes x, y, z;
};

TWEENFALL_LANES Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TWEENFALL_LANES Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
TWEENFALL_LANES Lanes3 operator*(const Lanes& s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
TWEENFALL_LANES Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
TWEENFALL_LANES Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Four symmetric matrices.
struct LanesSymmetric {
  Lanes xx, yy, zz, xy, xz, yz;
};

TWEENFALL_LANES Lanes3 operator*(const LanesSymmetric& m, const Lanes3& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

#pragma GCC diagnostic pop

}  // namespace tweenfall::blocks
