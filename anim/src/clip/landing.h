#pragma once

#include <tweenfall/anim/clip.h>

namespace tweenfall::clips {

/// Whether a curve of the clip jumps onto its last key where the clip ends, as one of held keys does. A play that ends
/// there then rests on that key and no longer on what it came from. Where another curve begins anew at that very time,
/// all of them rest on what they came from: none is shown at its start again.
[[nodiscard]] bool lands_on_last_key(const Clip& clip) noexcept;

}  // namespace tweenfall::clips
