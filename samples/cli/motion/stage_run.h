#pragma once

/// Running a stage the way `run`, `plot` and `view` do, and telling in a sentence what the recording shows.

#include "files/stage_file.h"
#include "line/arguments.h"

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// What the three verbs let people choose.
struct RunOptions {
  std::string file;
  std::optional<std::string> clip;
  std::optional<double> until;  ///< s; the stage's natural length when absent
  std::optional<double> fps;    ///< frames per second; where absent `usual_fps`, or fewer where those were too many
  double usual_fps = 60;
  std::optional<double> limit;  ///< megabytes of recording
  double usual_limit = 512;
  std::vector<TimedInput> inputs{};  ///< given on the way, in order of time
  bool details = false;              ///< whether what the steps worked with is recorded, too
};

/// The options that say how much is recorded.
void declare_amount(Arguments& arguments, RunOptions& options);

/// What was asked for, as far as it can be judged before a file is read. @throws UsageError
void require_amount(const RunOptions& options);

/// Runs from 0, with progress on a terminal. Where nobody said how many, there are fewer frames than usual when those
/// would take more than the limit; that is said, and so is an end that comes before what there is to show.
/// @throws UsageError for impossible times, or for more than the limit; Faults from the run.
[[nodiscard]] Recording run_stage(const StageDescription& description, const RunOptions& options);

/// "3 nodes over 3.5 s at 60 frames per second, 2 hand-offs, 4 events".
[[nodiscard]] std::string summary_of(const Recording& recording);

}  // namespace tweenfall::cli
