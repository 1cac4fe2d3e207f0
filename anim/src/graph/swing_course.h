#pragma once

// What is marked of the way of springs, and from where they go on.

#include "graph/log.h"

namespace tweenfall::graphs {

/// The mark that has come the furthest of those on clocks up to `instant` at times up to `time`; null for none.
[[nodiscard]] const SwingMark* furthest_mark(const SwingCourse& course, double instant, double time) noexcept;

/// The course since `start`, which may be a fresh one in the place of another.
[[nodiscard]] SwingCourse& course_since(SwingMemory& memory, double start) noexcept;

/// Where to write down the next mark, and what remembers the way to it.
[[nodiscard]] SwingMark& next_mark(SwingCourse& course) noexcept;
/// Keeps a mark for those who come back from far ahead.
void keep(SwingCourse& course, const SwingMark& mark) noexcept;

}  // namespace tweenfall::graphs
