#pragma once

/// Runs a stage the way `run`, `plot` and `view` do, and says in a sentence what the recording shows.

#include "files/stage_file.h"
#include "line/arguments.h"

#include <tweenfall/physics/stage/recording.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// Options that the three verbs share.
struct RunOptions {
  std::string file;
  std::optional<std::string> clip;
  std::optional<double> until;  ///< s; if absent, the stage's natural length
  std::optional<double> fps;    ///< frames per second; if absent `usual_fps`, or fewer if those would be too many
  double usual_fps = 60;
  std::optional<double> limit;  ///< megabytes of recording
  double usual_limit = 512;
  std::vector<TimedInput> inputs{};  ///< given during the run, in order of time
  bool details = false;              ///< whether the internal data of the steps is recorded, too
};

/// Declares the options that say how much is recorded.
void declare_amount(Arguments& arguments, RunOptions& options);

/// Checks the options as far as possible before a file is read. @throws UsageError
void require_amount(const RunOptions& options);

/// Runs from 0, with progress on a terminal. If no frame rate was asked for, there are fewer frames when the usual ones
/// would exceed the limit; a note says so, and another one if the run ends before everything has been shown.
/// @throws UsageError for impossible times, or for more than the limit; Faults from the run.
[[nodiscard]] Recording run_stage(const StageDescription& description, const RunOptions& options);

/// "3 nodes over 3.5 s at 60 frames per second, 2 hand-offs, 4 events".
[[nodiscard]] std::string summary_of(const Recording& recording);

}  // namespace tweenfall::cli
