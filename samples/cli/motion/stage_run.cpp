#include "motion/stage_run.h"

#include "motion/frame_times.h"
#include "report/counted.h"
#include "report/faults.h"
#include "report/terminal.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/recording_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::cli {

namespace {

constexpr double megabyte = 1e6, most_steps = 2e7;

/// Particles and user tracks are counted as they come: without a limit, a recording ends with an error at this size,
/// bytes.
constexpr double most_without_limit = 4e9 / 3;

/// Size of one node in one frame.
constexpr double bytes_of_a_pose = sizeof(WorldMotion) + sizeof(Twist) + sizeof(Owner) + sizeof(Color);

double bytes_per_frame(const StageDescription& stage) {
  double weights = 0;
  for (const Mesh& mesh : stage.meshes) weights += static_cast<double>(mesh.morphs.size()) * sizeof(double);
  double softs = 0;
  for (const SoftDescription& soft : stage.softs)
    softs += static_cast<double>(soft.soft.positions.size()) * sizeof(Vec3);
  const double joints = static_cast<double>(stage.joints.size()) * sizeof(std::optional<JointReading>);
  return static_cast<double>(stage.nodes.size()) * bytes_of_a_pose + weights + softs + joints + sizeof(double);
}

/// @throws UsageError saying how large the recording would be.
double chosen_fps(const StageDescription& stage, const RunOptions& options, double until) {
  const double most_bytes = options.limit.value_or(options.usual_limit) * megabyte;
  const double fps = options.fps.value_or(options.usual_fps), bytes = bytes_per_frame(stage) * (until * fps + 1);
  if (bytes <= most_bytes) return fps;
  const std::string amount = brief_text(until) + " s at " + brief_text(fps) + " frames per second of " +
                             counted(stage.nodes.size(), "node") + " would be " + brief_text(bytes / megabyte) +
                             " MB of recording, above " + brief_text(most_bytes / megabyte);
  const double fewer = until > 0 ? std::floor(1e3 * (most_bytes / bytes_per_frame(stage) - 1) / until) / 1e3 : 0;
  if (options.fps || !(fewer > 0))
    throw UsageError(amount + "; ask for less with --until or --fps, or for more with --limit");
  say(options.file + ": note: " + amount + "; it is taken at " + brief_text(fewer) +
      " frames per second; a greater --limit or a shorter --until allows more");
  return fewer;
}

/// Nothing that a person wrote is silently skipped: rules that never fired say why.
void say_unfired(const Recording& recording, const std::string& file) {
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < recording.unfired.size() && i < most; ++i) {
    const UnfiredRule& unfired = recording.unfired[i];
    say(file + ": note: hand-off rule " + std::to_string(unfired.rule + 1) + " never took \"" +
        recording.nodes[unfired.node].name + "\": " + unfired.reason);
  }
  if (recording.unfired.size() > most)
    say(file + ": note: and " + std::to_string(recording.unfired.size() - most) + " more that never did");
}

}  // namespace

void declare_amount(Arguments& arguments, RunOptions& options) {
  arguments.number("--until", "T", options.until, "to stage time T, s; without it, until everything has been shown");
  arguments.number("--fps", "N", options.fps,
                   "frames per second; 60 without it, fewer for very long or large recordings");
  arguments.number("--limit", "MB", options.limit, "greatest size of the recording in memory, megabytes");
}

void require_amount(const RunOptions& options) {
  if (options.limit && !(*options.limit > 0))
    throw UsageError("--limit must be above 0, not " + brief_text(*options.limit));
  require_frames(options.fps.value_or(options.usual_fps), options.until.value_or(0));
}

Recording run_stage(const StageDescription& description, const RunOptions& options) {
  // What comes last stays visible for a while.
  constexpr double after_input = 3;
  const double last_input = options.inputs.empty() ? 0 : options.inputs.back().time + after_input;
  const double natural = std::max(natural_length(description), last_input), until = options.until.value_or(natural);
  if (until / description.step > most_steps)
    throw UsageError(brief_text(until) + " s are " + brief_text(until / description.step) + " steps of " +
                     brief_text(description.step) + " s, more than the limit of " + brief_text(most_steps) +
                     "; ask for less with --until");
  require_amount(options);
  const double fps = chosen_fps(description, options, until);
  if (!options.until)
    for (const Play& play : description.plays)
      if (const double end = end_time(play, description.clips[play.clip]); std::isfinite(end) && end > until) {
        say(options.file + ": note: \"" + description.clips[play.clip].name + "\" plays until " + brief_text(end) +
            " s, of which the first " + brief_text(until) + " s are shown; use --until for more");
        break;
      }
  const Progress progress("running " + options.file + " to " + brief_text(until) + " s");
  Stage stage = make_stage(description, options.file);
  try {
    Recording recording = record(stage, until, fps, options.limit ? *options.limit * megabyte : most_without_limit,
                                 options.details, options.inputs);
    check_recording(recording);
    say_unfired(recording, options.file);
    return recording;
  } catch (const std::invalid_argument& error) {
    throw Faults(faults_of(error, options.file));
  } catch (const std::runtime_error& error) {
    throw Faults(faults_of(error, options.file));
  }
}

std::string summary_of(const Recording& recording) {
  std::string text = counted(recording.nodes.size(), "node") + " over " + brief_text(recording.times.back()) + " s";
  if (recording.times.size() > 1)
    text += " at " + brief_text(1 / (recording.times[1] - recording.times[0])) + " frames per second";
  if (!recording.handoffs.empty()) text += ", " + counted(recording.handoffs.size(), "hand-off");
  if (!recording.events.empty()) text += ", " + counted(recording.events.size(), "event");
  return text;
}

}  // namespace tweenfall::cli
