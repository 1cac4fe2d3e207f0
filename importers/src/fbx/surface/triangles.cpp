#include "fbx/surface/triangles.h"

#include <numeric>

namespace tweenfall::fbx {

namespace {

/// Beyond this many corners the search for ears, which takes quadratic time, would take too long.
constexpr std::size_t most_ears = 2000;

Vec3 newell_normal(std::span<const Vec3> polygon) {
  Vec3 normal(0, 0, 0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    normal += a.cross(b);
  }
  return normal;
}

class Cutter {
 public:
  Cutter(std::span<const Vec3> polygon, const Vec3& normal) : polygon_(polygon), normal_(normal) {}

  /// How far the path from a turns left at corner b; below 0 the corner is concave.
  [[nodiscard]] double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Vec3 to = polygon_[b] - polygon_[a], on = polygon_[c] - polygon_[b];
    return to.cross(on).dot(normal_);
  }

  [[nodiscard]] bool convex() const {
    const std::size_t n = polygon_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (turn(i, (i + 1) % n, (i + 2) % n) < 0) return false;
    return true;
  }

  [[nodiscard]] std::vector<std::array<std::size_t, 3>> ears() const {
    std::vector<std::array<std::size_t, 3>> cut;
    std::vector<std::size_t> left(polygon_.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    while (left.size() > 3) {
      std::size_t ear = 0;
      while (ear < left.size() && !is_ear(left, ear)) ++ear;
      // A polygon that crosses itself may have none: then the first corner is cut off anyway.
      if (ear == left.size()) ear = 0;
      const std::size_t n = left.size();
      cut.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    cut.push_back({left[0], left[1], left[2]});
    return cut;
  }

 private:
  [[nodiscard]] bool is_ear(const std::vector<std::size_t>& left, std::size_t at) const {
    const std::size_t n = left.size();
    const std::size_t a = left[(at + n - 1) % n], b = left[at], c = left[(at + 1) % n];
    if (turn(a, b, c) < 0) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t p = left[i];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::span<const Vec3> polygon_;
  Vec3 normal_;
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangles_of(std::span<const Vec3> polygon) {
  std::vector<std::array<std::size_t, 3>> fan;
  if (polygon.size() < 3) return fan;
  const Cutter cutter(polygon, newell_normal(polygon));
  if (polygon.size() > 3 && polygon.size() <= most_ears && !cutter.convex()) return cutter.ears();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) fan.push_back({0, i, i + 1});
  return fan;
}

}  // namespace tweenfall::fbx
