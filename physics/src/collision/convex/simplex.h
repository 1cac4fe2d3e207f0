#pragma once

#include <tweenfall/curves/values.h>

#include <array>

namespace tweenfall::convex {

/// Up to four differences of points of two bodies, and the convex combination of them that is nearest to zero.
struct Simplex {
  struct Corner {
    Vec3 difference;
    Vec3 on_a, on_b;
  };
  std::array<Corner, 4> corners;
  std::array<double, 4> weights{};
  int count = 0;

  [[nodiscard]] bool has(const Vec3& difference) const;
  void add(const Corner& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
  /// Computes the weights of the corners, and drops those with no weight.
  /// @return the combination; zero if the corners enclose it
  Vec3 reduce();
  [[nodiscard]] Vec3 on_a() const;
  [[nodiscard]] Vec3 on_b() const;
};

}  // namespace tweenfall::convex
