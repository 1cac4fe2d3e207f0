#pragma once

#include <cstdint>

namespace tweenfall::chains {

/// A number from 0 to 1, the same for the same place among all that are drawn, and independent of the others.
/// Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014.
inline double drawn(std::uint64_t place) noexcept {
  std::uint64_t z = (place + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace tweenfall::chains
