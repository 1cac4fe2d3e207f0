#pragma once

#include "collision/surfaces/triangle_tree.h"

namespace tweenfall::surfaces {

struct SurfaceTriangle {
  std::array<Vec3, 3> corners;  ///< counter-clockwise seen from the front
  std::array<std::uint32_t, 3> vertices;

  [[nodiscard]] Vec3 normal() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized(); }
  [[nodiscard]] Bounds bounds() const {
    return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]), corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
  }
};

/// Triangles with a tree over them.
class Surface {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  virtual ~Surface() = default;

  [[nodiscard]] virtual std::uint32_t triangle_count() const noexcept = 0;
  [[nodiscard]] virtual SurfaceTriangle triangle(std::uint32_t index) const noexcept = 0;
  /// The triangle that shares the side from corner `side` to the next; `none` at a border.
  [[nodiscard]] virtual std::uint32_t across(std::uint32_t index, std::size_t side) const noexcept = 0;

  [[nodiscard]] const Bounds& bounds() const noexcept { return tree_.bounds(); }
  /// The box around it on its path, which is at least its own box turned along.
  [[nodiscard]] Bounds bounds(const Vec3& center, const Mat3& axes) const noexcept {
    const Vec3 middle = 0.5 * (bounds().low + bounds().high), half = 0.5 * (bounds().high - bounds().low);
    const Vec3 at = center + axes * middle, reach = axes.cwiseAbs() * half;
    return {at - reach, at + reach};
  }
  /// No point of it is farther from the origin, m.
  [[nodiscard]] double reach() const noexcept {
    return bounds().low.cwiseAbs().cwiseMax(bounds().high.cwiseAbs()).norm();
  }

  /// Calls `see(triangle)` for triangles in boxes for which `enters(box)`, as `TriangleTree::walk` does.
  template <class Enters, class See, class LeftFirst>
  void walk(const Enters& enters, const See& see, const LeftFirst& left_first) const {
    tree_.walk(
        enters,
        [&](std::uint32_t item) {
          for (std::uint32_t i = 0; i < per_item_; ++i) see(per_item_ * item + i);
        },
        left_first);
  }
  template <class Enters, class See>
  void walk(const Enters& enters, const See& see) const {
    walk(enters, see, [](const Bounds&, const Bounds&) { return true; });
  }
  /// Visits first what is nearer to a point.
  template <class Enters, class See>
  void walk_near(const Vec3& point, const Enters& enters, const See& see) const {
    const auto away = [&](const Bounds& box) {
      return (box.low - point).cwiseMax(point - box.high).cwiseMax(0.0).squaredNorm();
    };
    walk(enters, see, [&](const Bounds& left, const Bounds& right) { return away(left) <= away(right); });
  }
  /// Visits first what comes first along a direction.
  template <class Enters, class See>
  void walk_along(const Vec3& direction, const Enters& enters, const See& see) const {
    walk(enters, see, [&](const Bounds& left, const Bounds& right) {
      return direction.dot(right.low - left.low) + direction.dot(right.high - left.high) >= 0;
    });
  }

 protected:
  explicit Surface(std::uint32_t per_item) : per_item_(per_item) {}
  void plant(std::span<const Bounds> items) { tree_ = TriangleTree(items); }

 private:
  TriangleTree tree_;
  std::uint32_t per_item_;
};

/// The surface that a solid is; null for solids with a volume.
[[nodiscard]] inline const Surface* surface_of(const Solid& solid) noexcept {
  if (const auto* mesh = std::get_if<TriangleMesh>(&solid)) return &mesh->inside();
  if (const auto* field = std::get_if<HeightField>(&solid)) return &field->inside();
  return nullptr;
}

}  // namespace tweenfall::surfaces
