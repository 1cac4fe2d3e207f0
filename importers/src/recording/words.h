#pragma once

// The words that stand for kinds of events in every file we write; those of owners and causes are public.

#include <tweenfall/anim/clip.h>

namespace tweenfall::recordings {

/// Of what happens at a moment it is empty: that goes without saying.
[[nodiscard]] const char* kind_word(EventKind kind) noexcept;

}  // namespace tweenfall::recordings
