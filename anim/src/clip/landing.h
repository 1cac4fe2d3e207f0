#pragma once

#include <tweenfall/anim/clip.h>

namespace tweenfall::clips {

/// Whether a curve of the clip jumps to its last key where the clip ends, as one with held keys does. A play that ends
/// there then rests on that key instead of the value before it. If another curve restarts at that same time, all curves
/// rest on the values before: none is shown at its start again.
[[nodiscard]] bool lands_on_last_key(const Clip& clip) noexcept;

}  // namespace tweenfall::clips
