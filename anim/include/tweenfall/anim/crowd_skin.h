#pragma once

/// Skinning for crowds: what a pose makes of the vertices of a mesh, in float.
///
/// A mesh is made ready once; then each figure's joints give a palette of matrices, and the palette moves the vertices.
/// A vertex may have any number of influences; meshes with four or fewer for each are the quick ones. Results have the
/// same bits on every processor, however the vertices are shared out among threads: nothing is allocated, and each call
/// writes only the vertices it was asked for.

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

/// Which joints move a mesh, and from where.
class CrowdSkin {
 public:
  /// @throws std::invalid_argument listing all problems: joints and inverse binds that differ in number, numbers that
  ///         are not finite
  explicit CrowdSkin(const Skin& skin);

  [[nodiscard]] std::size_t joints() const noexcept { return joints_.size(); }

  /// For each joint of the skin the way from the mesh as it was bound to the world.
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
  /// @param joints  how many the palettes have
  /// @throws std::invalid_argument listing all problems: influences of another number than vertices, normals too; a
  ///         joint beyond the palette, numbers that are not finite
  CrowdMesh(const Mesh& mesh, std::size_t joints);

  [[nodiscard]] std::size_t vertices() const noexcept { return vertices_; }
  [[nodiscard]] bool has_normals() const noexcept { return has_normals_; }

  /// Positions of all vertices, and their normals: of unit length, turned as surfaces turn, by the cofactors of the
  /// blended matrix, so that they are right under unequal scales too; zero where that is flat.
  /// @param palette    from `CrowdSkin::palette`
  /// @param positions  written, one for each vertex, m
  /// @param normals    written, one for each vertex; empty for none
  void skin(std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
            std::span<CrowdPoint> normals = {}) const noexcept;

  /// The same of one part of the vertices, so that threads can share a mesh.
  /// @param part  less than `parts()`; each has `part_size` vertices but the last
  void skin_part(std::size_t part, std::span<const CrowdMatrix> palette, std::span<CrowdPoint> positions,
                 std::span<CrowdPoint> normals = {}) const noexcept;
  static constexpr std::size_t part_size = 1024;
  [[nodiscard]] std::size_t parts() const noexcept { return (vertices_ + part_size - 1) / part_size; }

  /// By given kernels; all give the same bits.
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
  std::vector<Influence4> influences_;  // of each vertex, to whole blocks: rows of four, the first of which is its own
  std::vector<std::uint32_t> more_;     // where its further rows begin, and after the last where they end; or empty
  std::vector<Influence4> more_influences_;
};

}  // namespace tweenfall
