#pragma once

// Small states as bytes, least significant first, and back.

#include <tweenfall/curves/values.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall::chains {

struct StateWriter {
  std::vector<std::byte> bytes;

  void word(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<std::byte>(bits >> (8 * i) & 0xff));
  }
  void number(std::int64_t n) { word(static_cast<std::uint64_t>(n)); }
  void real(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof(bits));
    word(bits);
  }
  void vector(const Vec3& v) {
    for (int i = 0; i < 3; ++i) real(v[i]);
  }
};

struct StateReader {
  std::span<const std::byte> bytes;
  std::string what;
  std::size_t at = 0;

  void require_size(std::size_t wanted) const {
    if (bytes.size() != wanted)
      throw std::invalid_argument(what + ": there are " + std::to_string(bytes.size()) + " bytes where " +
                                  std::to_string(wanted) + " were expected");
  }
  std::uint64_t word() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(bytes[at++]) << (8 * i);
    return bits;
  }
  std::int64_t number() { return static_cast<std::int64_t>(word()); }
  double real() {
    const std::uint64_t bits = word();
    double x = 0;
    std::memcpy(&x, &bits, sizeof(x));
    if (!std::isfinite(x))
      throw std::invalid_argument(what + ": the number at byte " + std::to_string(at - 8) + " is not finite");
    return x;
  }
  Vec3 vector() {
    const double x = real(), y = real(), z = real();
    return {x, y, z};
  }
};

}  // namespace tweenfall::chains
