#pragma once

// What is asked too much of: bodies that lie deep in each other, joints that cannot hold what they are to hold.

#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Tells, once it has lasted, of bodies that lie deep in each other, and of joints that stand open, are beyond their
/// hard limits, or whose motors of any force do not reach their speed.
void report_strains(StageState& state, std::vector<Happening>& happenings);

}  // namespace tweenfall::staging
