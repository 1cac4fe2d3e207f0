#pragma once

// What graphs did while a stage was recorded.

#include <tweenfall/physics/stage/recording.h>

namespace tweenfall::staging {

/// Of all graphs at the recording's frames; those that exceed a limit of memory are left out.
[[nodiscard]] std::vector<GraphRecord> graph_records(const Stage& stage, std::span<const double> times);

}  // namespace tweenfall::staging
