#pragma once

// The words that stand for owners, causes and kinds of events in every file we write.

#include <tweenfall/anim/clip.h>
#include <tweenfall/physics/handoff/rule.h>

namespace tweenfall::recordings {

[[nodiscard]] const char* owner_word(Owner owner) noexcept;
[[nodiscard]] const char* cause_word(Cause cause) noexcept;
/// Of what happens at a moment it is empty: that goes without saying.
[[nodiscard]] const char* kind_word(EventKind kind) noexcept;

}  // namespace tweenfall::recordings
