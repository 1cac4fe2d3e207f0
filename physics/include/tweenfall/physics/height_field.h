#pragma once

/// Grounds given as heights over an even grid.

#include <tweenfall/curves/surface_mesh.h>

#include <memory>
#include <span>

namespace tweenfall {

namespace surfaces {
class Surface;
class GridSurface;
}  // namespace surfaces

/// An immutable value, cheap to copy: a ground over a grid in x and z, centered over the origin, that faces up along
/// y. Only for bodies that never move by themselves. Each cell is two triangles, which meet along the line from its
/// corner of least x and z to that of greatest x and z; otherwise it is like a `TriangleMesh`.
class HeightField {
 public:
  static constexpr std::size_t most_heights = 20'000'000;

  /// @param columns  heights along x; >= 2
  /// @param heights  row after row along z, each row along x; at least two whole rows, m
  /// @param spacing_x, spacing_z  from one height to the next, m; > 0
  /// @throws std::invalid_argument if these conditions are not met, or a height is not finite or beyond 1e30 m
  HeightField(std::size_t columns, std::span<const double> heights, double spacing_x, double spacing_z);
  // Moving copies, so that no field is ever without its data.
  HeightField(const HeightField&) noexcept = default;
  HeightField& operator=(const HeightField&) noexcept = default;

  [[nodiscard]] std::size_t columns() const noexcept;
  [[nodiscard]] std::size_t rows() const noexcept;
  [[nodiscard]] std::span<const double> heights() const noexcept;
  [[nodiscard]] double spacing_x() const noexcept;  ///< m
  [[nodiscard]] double spacing_z() const noexcept;  ///< m
  [[nodiscard]] SurfaceMesh surface() const;        ///< without normals

  [[nodiscard]] const surfaces::Surface& inside() const noexcept;  ///< for internal use by the physics

 private:
  std::shared_ptr<const surfaces::GridSurface> surface_;
};

}  // namespace tweenfall
