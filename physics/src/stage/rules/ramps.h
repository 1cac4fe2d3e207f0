#pragma once

// What happens to a body some time after a change: its drive moves along its ramp, and the next change comes.

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Softer than the first of these counts as free, and stiffer than the second as keyed, Hz.
inline constexpr double softest_hz = 0.01, stiffest_hz = 1000;

/// The frequency between two, evenly in the logarithm. @param share  of the second, 0 to 1
[[nodiscard]] double hz_between(double from, double to, double share);

/// The drive with which a ramp starts: finite, so that the body is driven.
[[nodiscard]] Drive drive_at_start(const Ramp& ramp);
/// @param time  between the ramp's start and end
[[nodiscard]] Drive drive_on(const Ramp& ramp, double time);

/// Gives bodies on a ramp the drive of the state's time.
void follow_ramps(StageState& state);

/// Schedules the change of the rule after this one, if there is one. @param place  index in the rule's `then`
void wait_for_next(const StageState& state, StagedBody& body, std::size_t rule, std::size_t place, double began);

/// First moment in (from, to] at which a ramp ends or a later change is due; infinity for none.
[[nodiscard]] double next_change(const StageState& state, double from, double to);

/// When a ramp of the body ends or its next change comes; infinity for none.
[[nodiscard]] double change_due(const StagedBody& body);

/// Calls `visit(body, instant)` for what is due in (from, state.handled], in order of bodies.
template <class Visit>
void for_each_change_due(const StageState& state, double from, const Visit& visit) {
  for (std::size_t body = 0; body < state.bodies.size(); ++body)
    if (const double due = change_due(state.bodies[body]); due > from && due <= state.handled) visit(body, due);
}

/// Makes the changes of a body that are due until `instant`.
void change_when_due(StageState& state, std::size_t body, double instant, double step,
                     std::vector<Happening>& happenings);

}  // namespace tweenfall::staging
