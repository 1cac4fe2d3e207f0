#pragma once

/// Skinning for crowds: moves the vertices of a mesh by a pose, in float.
///
/// A mesh is prepared once; then each figure's joints give a palette of matrices, and the palette moves the vertices. A
/// vertex may have any number of influences; meshes with at most four per vertex are the fastest. Results have the same
/// bits on every processor, however the vertices are divided among threads: nothing is allocated, and each call writes
/// only its own vertices.

#include <tweenfall/anim/crowd_kernels.h>
#include <tweenfall/anim/mesh.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall {

namespace crowd {
struct SkinKernels;
}

/// The joints that move a mesh, and their inverse bind matrices.
class CrowdSkin {
 public:
  /// @throws std::invalid_argument listing all problems: different numbers of joints and inverse binds, numbers that
  ///         are not finite
  explicit CrowdSkin(const Skin& skin);

  [[nodiscard]] std::size_t joints() const noexcept { return joints_.size(); }

  /// For each joint of the skin the transform from the mesh as it was bound to the world.
  /// @param world    of the figure's nodes  @param palette  written; `joints()` of them
  void palette(std::span<const CrowdMatrix> world, std::span<CrowdMatrix> palette) const noexcept;

 private:
  std::vector<std::uint32_t> joints_;
  std::vector<CrowdMatrix> inverse_binds_;
};

/// A vertex as it is written, m, or a normal.
struct CrowdPoint {
  float x = 0, y = 0, z = 0;
};

/// The vertices of a skinned mesh: their positions, normals and influences.
class CrowdMesh {
 public:
  /// @param joints number of joints in the palettes
  /// @throws std::invalid_argument listing all problems: influences or normals whose number differs from that of the
  ///         vertices, a joint beyond the palette, numbers that are not finite
  CrowdMesh(const Mesh& mesh, std::size_t joints);

  [[nodiscard]] std::size_t vertices() const noexcept { return vertices_; }

  /// Positions of all vertices, and their normals: of unit length, transformed by the cofactors of the blended matrix,
  /// so that they are right under non-uniform scales too; zero where the matrix is singular.
  /// @param palette    from `CrowdSkin::palette`
  /// @param positions  written, one for each vertex, m
  /// @param normals    written, one for each vertex; empty for none
  void skin(std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
            std::span<CrowdPoint> normals = {}) const noexcept;

  /// The same for one part of the vertices, so that threads can share a mesh.
  /// @param part  less than `parts()`; each has `part_size` vertices, except the last
  void skin_part(std::size_t part, std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
                 std::span<CrowdPoint> normals = {}) const noexcept;
  static constexpr std::size_t part_size = 1024;
  [[nodiscard]] std::size_t parts() const noexcept { return (vertices_ + part_size - 1) / part_size; }

  /// The same with given kernels; all of them give the same bits.
  void skin_with(const crowd::SkinKernels& kernels, std::span<const CrowdMatrix> palette,
                 std::span<CrowdPoint> positions, std::span<CrowdPoint> normals) const noexcept;

  /// For kernels: eight vertices side by side, x, y and z of the position and then of the normal.
  struct alignas(32) Block {
    float numbers[6][8];
  };
  struct Influence4 {
    std::uint32_t offset[4];  ///< of the joint's matrix in the palette, bytes
    float weight[4];
  };

 private:
  void skin_part_with(const crowd::SkinKernels& kernels, std::size_t part, std::span<const CrowdMatrix> palette,
                      std::span<CrowdPoint> positions, std::span<CrowdPoint> normals) const noexcept;

  std::size_t vertices_ = 0;
  bool has_normals_ = false;
  std::vector<Block> blocks_;
  std::vector<Influence4> influences_;  // the first four of each vertex, padded to whole blocks
  std::vector<std::uint32_t> more_;     // where each vertex's further rows begin, then the end of all; or empty
  std::vector<Influence4> more_influences_;
};

}  // namespace tweenfall
