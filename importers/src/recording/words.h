#pragma once

// The words that stand for owners and causes in every file we write.

#include <tweenfall/physics/handoff/rule.h>

namespace tweenfall::recordings {

[[nodiscard]] const char* owner_word(Owner owner) noexcept;
[[nodiscard]] const char* cause_word(Cause cause) noexcept;

}  // namespace tweenfall::recordings
