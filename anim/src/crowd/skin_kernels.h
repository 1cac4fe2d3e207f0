#pragma once

// The inner loop of skinning, one version for each instruction set.

#include <tweenfall/anim/crowd_skin.h>

#include <span>

namespace tweenfall::crowd {

/// What a kernel reads and writes; all positions are relative to the first vertex of a block.
struct SkinWork {
  const CrowdMesh::Block* blocks;
  const CrowdMesh::Influence4* influences;
  const std::uint32_t* more;  ///< null where no vertex has more than four
  const CrowdMesh::Influence4* more_influences;
  const CrowdMatrix* palette;
  CrowdPoint* positions;
  CrowdPoint* normals;  ///< null for none
  std::size_t vertices;
};

struct SkinKernels {
  void (*skin)(const SkinWork& work);
};

/// For all instruction sets that this processor has, the plainest first. All give the same bits.
[[nodiscard]] std::span<const SkinKernels* const> possible_skin_kernels();
/// The last of them.
[[nodiscard]] const SkinKernels& fastest_skin_kernels();

}  // namespace tweenfall::crowd
