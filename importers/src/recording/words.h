#pragma once

// The words for kinds of events in all files written; those for owners and causes are public.

#include <tweenfall/anim/clip.h>

namespace tweenfall::recordings {

/// Empty for a moment, the usual kind.
[[nodiscard]] const char* kind_word(EventKind kind) noexcept;

}  // namespace tweenfall::recordings
