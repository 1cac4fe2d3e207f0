// tweenfall view: the moving picture as one page.

#include "files/output_file.h"
#include "motion/frame_times.h"
#include "motion/stage_run.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/recording_file.h>

namespace tweenfall::cli {

namespace {

struct ViewOptions : RunOptions {
  std::string output;
  std::optional<double> frames_per_second;
};

int view_file(ViewOptions options) {
  if (!options.output.empty()) require_output(options.output, options.file, std::vector<std::string>{".html"});
  options.fps = options.frames_per_second.value_or(60);
  require_frames(options.fps, options.until.value_or(0));
  StageFile read = read_stage_file(options.file);
  if (options.output.empty()) options.output = read.name + ".html";
  choose_play(read, options.clip, options.file);
  const Recording recording = run_stage(read.stage, options);
  write_output(options.output, recording_html(recording, read.stage));
  say_written(options.output, summary_of(recording, options.fps) + "; open it in a browser");
  return 0;
}

Run declare_view(Arguments& arguments) {
  auto options = std::make_shared<ViewOptions>();
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.output(options->output, "OUT.html", "where to write; FILE's name with .html in this folder without it");
  arguments.text("--clip", "NAME", options->clip, "let this clip play alone");
  arguments.number("--until", "T", options->until, "to stage time T, s; else until it has shown what it has");
  arguments.number("--fps", "N", options->frames_per_second, "frames a second, 60 by default");
  return [options] { return view_file(*options); };
}

}  // namespace

const Verb view_verb{"view", "write the moving picture as one HTML page", "tweenfall view swing.json -o swing.html",
                     declare_view};

}  // namespace tweenfall::cli
