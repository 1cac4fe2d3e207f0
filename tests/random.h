#pragma once

// Seeded random numbers, for tests and attacks.

#include <tweenfall/curves/values.h>

#include <cstdint>

namespace tweenfall::test {

/// The same numbers on every machine: splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< in [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Quat rotation() {
    // Braces, since the arguments of a call in parentheses are evaluated in an order of the compiler's choice.
    Quat q{between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
    if (q.norm() < 0.1) return rotation();
    q.normalize();
    return q;
  }

 private:
  std::uint64_t state_;
};

}  // namespace tweenfall::test
