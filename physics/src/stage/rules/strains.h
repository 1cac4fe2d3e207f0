#pragma once

// What is strained too much: bodies that overlap deeply, and joints that cannot hold what they should hold.

#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Reports bodies that overlap deeply for some time, and joints that for some time are open, are beyond their
/// hard limits, or whose motors of unlimited force do not reach their speed.
void report_strains(StageState& state, std::vector<Happening>& happenings);

}  // namespace tweenfall::staging
