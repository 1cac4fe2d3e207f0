#pragma once

#include "soft/sub_step.h"

namespace tweenfall::soft {

/// Keeps the nodes of a soft body apart by its thickness at the end of a sub-step that a solver has left, as balls that
/// neither bounce nor slide freely. @param before  where the nodes were at its start
/// @param push_out_speed  at most, of what lies in each other, m/s
void keep_apart(SubStep& step, const std::vector<Vec3>& before, double push_out_speed);

}  // namespace tweenfall::soft
