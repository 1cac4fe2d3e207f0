#pragma once

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// Triangles as cloth: masses by area, edges and hinges. @throws std::invalid_argument for triangles without area
[[nodiscard]] SoftSettings skin(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
                                const ClothMaterial& material);

[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles_of(const SurfaceMesh& mesh);

/// The mesh with one vertex at each place. @throws std::invalid_argument naming what is wrong with `what`
[[nodiscard]] SurfaceMesh checked_mesh(const SurfaceMesh& mesh, const char* what);

}  // namespace tweenfall::soft
