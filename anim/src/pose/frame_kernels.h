#pragma once

// The walk from local to world, one version for each instruction set.

#include <tweenfall/anim/hierarchy.h>

namespace tweenfall::pose {

/// The parent number of a root.
inline constexpr std::uint32_t no_parent = 0xffffffff;

struct FrameKernels {
  /// @param parents  of `count` nodes, each before its children, or `no_parent`
  void (*frames)(const std::uint32_t* parents, std::size_t count, const Motion* local, WorldFrame* world);
  void (*motions)(const std::uint32_t* parents, std::size_t count, const Motion* local, WorldMotion* world);
  void (*child)(const WorldMotion& parent, const Motion& local, WorldMotion& world);
};

[[nodiscard]] const FrameKernels& plain_frame_kernels() noexcept;
[[nodiscard]] const FrameKernels& fastest_frame_kernels() noexcept;

}  // namespace tweenfall::pose
