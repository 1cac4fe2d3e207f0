#pragma once

// How far along a curve of space each of its parameters is, and back.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall {

class ArcLengthTable {
 public:
  /// Of `curve` from its first to its last knot; parts are halved until that no longer changes a length by more than
  /// rounding.
  explicit ArcLengthTable(const Curve<Vec3>& curve);

  [[nodiscard]] double length() const noexcept { return parts_.back().length_before + parts_.back().length; }

  /// The parameter at which `length` is reached; the ends beyond them.
  [[nodiscard]] double parameter(double length) const noexcept;

 private:
  struct Part {
    double from, to;       // parameters
    double length_before;  // up to `from`
    double length;
  };
  void add(double from, double to, double whole, double allowed, double fault_before, int depth);
  [[nodiscard]] double length_between(double from, double to) const noexcept;

  Curve<Vec3> curve_;
  std::vector<Part> parts_;
};

}  // namespace tweenfall
