#include "graph/swing_course.h"

#include <algorithm>

namespace tweenfall::graphs {

const SwingMark* furthest_mark(const SwingCourse& course, double instant, double time) noexcept {
  const SwingMark* found = nullptr;
  const auto consider = [&](const SwingMark& mark) {
    if (mark.time < 0 || mark.instant > instant || mark.time > time) return;
    if (!found || mark.instant > found->instant || (mark.instant == found->instant && mark.time > found->time))
      found = &mark;
  };
  for (const SwingMark& mark : course.latest) consider(mark);
  for (std::size_t i = 0; i < course.marked; ++i) consider(course.markers[i]);
  return found;
}

SwingCourse& course_since(SwingMemory& memory, double start) noexcept {
  ++memory.asked;
  auto found = std::ranges::find(memory.courses, start, &SwingCourse::start);
  if (found == memory.courses.end()) {
    found = std::ranges::min_element(memory.courses, {}, &SwingCourse::asked);
    for (SwingMark& mark : found->latest) mark.instant = mark.time = -1;
    found->start = start;
    found->marked = 0;
    found->gap = SwingCourse{}.gap;
    found->jumps = {};
  }
  found->asked = memory.asked;
  return *found;
}

JumpMark& jump_mark(SwingCourse& course, double instant) noexcept {
  const auto found = std::ranges::find(course.jumps, instant, &JumpMark::instant);
  if (found != course.jumps.end()) return *found;
  JumpMark& mark = course.jumps[course.next_jump];
  course.next_jump = (course.next_jump + 1) % course.jumps.size();
  mark = {.instant = instant, .searched = instant};
  return mark;
}

SwingMark& next_mark(SwingCourse& course) noexcept {
  // A look ahead leaves nothing, and takes the place of nothing.
  if (const auto empty = std::ranges::find_if(course.latest, [](const SwingMark& mark) { return mark.time < 0; });
      empty != course.latest.end())
    return *empty;
  SwingMark& mark = course.latest[course.oldest];
  course.oldest = (course.oldest + 1) % course.latest.size();
  return mark;
}

void keep(SwingCourse& course, const SwingMark& mark) noexcept {
  if (course.marked > 0 && mark.time < course.markers[course.marked - 1].time + course.gap) return;
  if (course.marked == course.markers.size()) {
    // Every other one is dropped, and the distance between marks doubles.
    for (std::size_t i = 0; 2 * i + 1 < course.markers.size(); ++i)
      std::swap(course.markers[i], course.markers[2 * i + 1]);
    course.marked /= 2;
    course.gap *= 2;
  }
  course.markers[course.marked++] = mark;
}

}  // namespace tweenfall::graphs
