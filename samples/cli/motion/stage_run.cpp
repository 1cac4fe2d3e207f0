#include "motion/stage_run.h"

#include "motion/frame_times.h"
#include "report/counted.h"
#include "report/faults.h"
#include "report/terminal.h"

#include <tweenfall/importers/number_text.h>

namespace tweenfall::cli {

Recording run_stage(const StageDescription& description, const RunOptions& options) {
  const double until = options.until.value_or(natural_length(description));
  require_frames(options.fps, until);
  const Progress progress("running " + options.file + " to " + brief_text(until) + " s");
  Stage stage = make_stage(description, options.file);
  try {
    return record(stage, until, options.fps);
  } catch (const std::invalid_argument& error) {
    throw Faults(faults_of(error, options.file));
  }
}

std::string summary_of(const Recording& recording, double fps) {
  std::string text = counted(recording.nodes.size(), "node") + " over " + brief_text(recording.times.back()) +
                     " s at " + brief_text(fps) + " frames a second";
  if (!recording.handoffs.empty()) text += ", " + counted(recording.handoffs.size(), "hand-off");
  if (!recording.events.empty()) text += ", " + counted(recording.events.size(), "event");
  return text;
}

}  // namespace tweenfall::cli
