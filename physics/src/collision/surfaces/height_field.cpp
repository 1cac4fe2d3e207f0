#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/height_field.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "collision/surfaces/surface.h"
#include "state/countable.h"

namespace tweenfall {

namespace surfaces {

class GridSurface : public Surface {
 public:
  GridSurface(std::size_t columns, std::vector<double> heights, double spacing_x, double spacing_z)
      : Surface(2),
        columns_(static_cast<std::uint32_t>(columns)),
        rows_(static_cast<std::uint32_t>(heights.size() / columns)),
        spacing_x_(spacing_x),
        spacing_z_(spacing_z),
        heights_(std::move(heights)) {
    std::vector<Bounds> boxes;
    boxes.reserve(triangle_count() / 2);
    for (std::uint32_t i = 0; i < triangle_count(); i += 2)
      boxes.push_back(united(triangle(i).bounds(), triangle(i + 1).bounds()));
    plant(boxes);
  }

  [[nodiscard]] std::uint32_t triangle_count() const noexcept override { return 2 * (columns_ - 1) * (rows_ - 1); }
  [[nodiscard]] SurfaceTriangle triangle(std::uint32_t index) const noexcept override {
    const std::uint32_t cell = index / 2, row = cell / (columns_ - 1), column = cell % (columns_ - 1);
    const std::uint32_t first = row * columns_ + column, across_cell = first + columns_ + 1;
    const std::uint32_t other = index % 2 == 0 ? first + columns_ : first + 1;
    // Both triangles go once around the cell's corners, starting from the one of least x and z.
    const std::array<std::uint32_t, 3> its =
        index % 2 == 0 ? std::array{first, other, across_cell} : std::array{first, across_cell, other};
    return {{vertex(its[0]), vertex(its[1]), vertex(its[2])}, its};
  }
  [[nodiscard]] std::uint32_t across(std::uint32_t index, std::size_t side) const noexcept override {
    const std::uint32_t cell = index / 2, width = columns_ - 1, row = cell / width, column = cell % width;
    if (index % 2 == 0) {
      if (side == 0) return column > 0 ? 2 * (cell - 1) + 1 : none;
      if (side == 1) return row + 2 < rows_ ? 2 * (cell + width) + 1 : none;
      return index + 1;
    }
    if (side == 0) return index - 1;
    if (side == 1) return column + 2 < columns_ ? 2 * (cell + 1) : none;
    return row > 0 ? 2 * (cell - width) : none;
  }

  [[nodiscard]] Vec3 vertex(std::uint32_t index) const noexcept {
    const std::uint32_t column = index % columns_, row = index / columns_;
    return {(column - 0.5 * (columns_ - 1)) * spacing_x_, heights_[index], (row - 0.5 * (rows_ - 1)) * spacing_z_};
  }
  [[nodiscard]] std::uint32_t columns() const noexcept { return columns_; }
  [[nodiscard]] std::uint32_t rows() const noexcept { return rows_; }
  [[nodiscard]] double spacing_x() const noexcept { return spacing_x_; }
  [[nodiscard]] double spacing_z() const noexcept { return spacing_z_; }
  [[nodiscard]] const std::vector<double>& heights() const noexcept { return heights_; }

 private:
  std::uint32_t columns_, rows_;
  double spacing_x_, spacing_z_;
  std::vector<double> heights_;
};

namespace {

void require_field(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("a height field " + what);
}

std::vector<double> sound(std::size_t columns, std::span<const double> heights, double spacing_x, double spacing_z) {
  require_field(columns >= 2, "needs at least 2 columns, but has " + std::to_string(columns));
  require_field(heights.size() <= HeightField::most_heights, "can have " + std::to_string(HeightField::most_heights) +
                                                                 " heights, but has " + std::to_string(heights.size()));
  require_field(heights.size() % columns == 0, "needs whole rows of " + std::to_string(columns) + " heights, but has " +
                                                   std::to_string(heights.size()) + " heights in all");
  require_field(heights.size() / columns >= 2,
                "needs at least 2 rows, but has " + std::to_string(heights.size() / columns));
  for (const auto& [spacing, axis] : {std::pair(spacing_x, 'x'), std::pair(spacing_z, 'z')})
    require_field(spacing >= 1e-30 && spacing <= 1e22, std::string("needs a spacing along ") + axis +
                                                           " from 1e-30 m to 1e22 m, but has " + number_text(spacing));
  for (std::size_t i = 0; i < heights.size(); ++i)
    require_field(state::countable(heights[i]),
                  "has a height of " + number_text(heights[i]) + " m in column " + std::to_string(i % columns) +
                      " of row " + std::to_string(i / columns) + "; heights must be finite and at most 1e30 m");
  return {heights.begin(), heights.end()};
}

}  // namespace
}  // namespace surfaces

HeightField::HeightField(std::size_t columns, std::span<const double> heights, double spacing_x, double spacing_z)
    : surface_(std::make_shared<const surfaces::GridSurface>(
          columns, surfaces::sound(columns, heights, spacing_x, spacing_z), spacing_x, spacing_z)) {}

std::size_t HeightField::columns() const noexcept {
  return surface_->columns();
}
std::size_t HeightField::rows() const noexcept {
  return surface_->rows();
}
std::span<const double> HeightField::heights() const noexcept {
  return surface_->heights();
}
double HeightField::spacing_x() const noexcept {
  return surface_->spacing_x();
}
double HeightField::spacing_z() const noexcept {
  return surface_->spacing_z();
}
const surfaces::Surface& HeightField::inside() const noexcept {
  return *surface_;
}

SurfaceMesh HeightField::surface() const {
  SurfaceMesh mesh;
  mesh.positions.reserve(surface_->heights().size());
  for (std::uint32_t i = 0; i < surface_->heights().size(); ++i) mesh.positions.push_back(surface_->vertex(i));
  mesh.triangles.reserve(std::size_t{3} * surface_->triangle_count());
  for (std::uint32_t i = 0; i < surface_->triangle_count(); ++i)
    for (const std::uint32_t corner : surface_->triangle(i).vertices) mesh.triangles.push_back(corner);
  return mesh;
}

}  // namespace tweenfall
