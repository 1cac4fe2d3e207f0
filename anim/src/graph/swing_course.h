#pragma once

// The marks kept of the course of springs, from which it is continued.

#include "graph/log.h"

namespace tweenfall::graphs {

/// The furthest mark among those on clocks up to `instant` with times up to `time`; null for none.
[[nodiscard]] const SwingMark* furthest_mark(const SwingCourse& course, double instant, double time) noexcept;

/// The course since `start`; may be a new one that replaces another.
[[nodiscard]] SwingCourse& course_since(SwingMemory& memory, double start) noexcept;

/// What is known of the jumps after an instant: that nothing was searched, at first.
[[nodiscard]] JumpMark& jump_mark(SwingCourse& course, double instant) noexcept;

/// The place for the next mark, which replaces the oldest.
[[nodiscard]] SwingMark& next_mark(SwingCourse& course) noexcept;
/// Keeps a mark for later requests from far ahead back to near it.
void keep(SwingCourse& course, const SwingMark& mark) noexcept;

}  // namespace tweenfall::graphs
