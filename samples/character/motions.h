#pragma once

/// The figure's motions, each a pose for any time.

#include "skeleton.h"

namespace tweenfall::character {

inline constexpr double walk_cycle = 1.08;    ///< s; two steps
inline constexpr double walk_stride = 1.296;  ///< m per cycle, so 1.2 m/s
inline constexpr int walk_forward_cycles = 4;

/// Walking on the spot; repeats every `walk_cycle`. The left heel strikes at 0.
[[nodiscard]] FigurePose walk_pose(double time);
/// The same steps over the floor, towards +Z: standing feet do not slide.
[[nodiscard]] FigurePose walk_forward_pose(double time);

inline constexpr double wave_duration = 3;  ///< s
/// From standing: the right arm goes up, waves three times and comes down. The legs stay as they are.
[[nodiscard]] FigurePose wave_pose(double time);

inline constexpr double get_up_duration = 2.6;  ///< s
/// From lying on the back to standing at the origin.
[[nodiscard]] FigurePose get_up_pose(double time);

}  // namespace tweenfall::character
