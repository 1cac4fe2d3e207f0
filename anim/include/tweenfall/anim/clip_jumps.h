#pragma once

/// Where clips are not continuous: code that follows a clip must not mistake a jump for a movement.

#include <tweenfall/anim/clip.h>

#include <functional>
#include <vector>

namespace tweenfall {

/// Whether a track counts; an empty filter: all do.
using TrackFilter = std::function<bool(const Track&)>;

/// Whether the track moves its node: its position, rotation or scale, or a number of them.
[[nodiscard]] bool moves_its_node(const Track& track);

/// Clip times inside the clip, or at its end, at which the number, vector, color or rotation of a track jumps, in
/// order. Formulas are looked at 128 times per second (less often in a clip of more than an hour): a leap that is
/// undone between two looks goes unseen. Those of formulas in an endless clip are left out; `JumpSearch` finds them.
[[nodiscard]] std::vector<double> jumps_of(const Clip& clip, const TrackFilter& counts = {});

/// Whether a track has another value where a loop begins anew.
/// @param from, to  the section that is played, clip seconds
[[nodiscard]] bool jumps_at_seam(const Clip& clip, LoopMode mode, double from, double to,
                                 const TrackFilter& counts = {});

/// Times in (from, to] at which a number over time jumps: the first of them; infinity for none.
[[nodiscard]] double first_jump(const Curve<double>& curve, double from, double to);

}  // namespace tweenfall
