#pragma once

#include <vector>

#include "actors/soft/meetings/meetings.h"

namespace tweenfall::soft {

/// Whether a body is so thin somewhere that it could slip through between the nodes of a soft one.
[[nodiscard]] bool may_slip_between(const SoftSettings& made, const Shape& shape);

/// Keeps such bodies out of what lies between the nodes, at the end of a sub-step, after the solver: triangles,
/// or edges where there are none, as thick as the nodes. @param before  positions of the nodes at its start
/// @param push_out_speed  greatest speed of overlapping bodies, m/s @return whether any was met
bool meet_between(SubStep& step, const std::vector<Near>& near, const std::vector<state::Body>& bodies,
                  const std::vector<Vec3>& before, double push_out_speed);

}  // namespace tweenfall::soft
