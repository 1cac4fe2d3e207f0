#pragma once

/// Running a stage the way `run`, `plot` and `view` do, and telling in a sentence what the recording shows.

#include "files/stage_file.h"

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>

namespace tweenfall::cli {

/// What the three verbs let people choose.
struct RunOptions {
  std::string file;
  std::optional<std::string> clip;
  std::optional<double> until;  ///< s; the stage's natural length when absent
  double fps = 60;
};

/// Runs from 0, with progress on a terminal. @throws UsageError for impossible times; Faults from the run.
[[nodiscard]] Recording run_stage(const StageDescription& description, const RunOptions& options);

/// "3 nodes over 3.5 s at 60 frames a second, 2 hand-offs, 4 events".
[[nodiscard]] std::string summary_of(const Recording& recording, double fps);

}  // namespace tweenfall::cli
