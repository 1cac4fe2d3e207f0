// tweenfall view: the moving picture as one page.

#include "files/output_file.h"
#include "motion/stage_run.h"
#include "report/counted.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/importers/recording_file.h>

namespace tweenfall::cli {

namespace {

struct ViewOptions : RunOptions {
  std::string output;
  std::string other;  ///< a second file, shown beside the first
};

/// One of the files, after its run.
struct Viewed {
  StageFile read;
  Recording recording;
};

Viewed viewed(const RunOptions& options) {
  StageFile read = read_stage_file(options.file);
  choose_play(read, options.clip, options.file);
  Recording recording = run_stage(read.stage, options);
  const std::size_t frames = recording.times.size(), carried = page_frame_count(recording);
  if (carried < frames)
    say(options.file + ": note: too much for one page: of " + counted(frames, "frame") + " it carries " +
        std::to_string(carried) + ", with smooth motion between them; a shorter --until keeps all of them");
  return {std::move(read), std::move(recording)};
}

int view_both(ViewOptions options) {
  if (options.file == "-" && options.other == "-") throw UsageError("only one of two files can be standard input");
  options.usual_limit /= 2;
  const Viewed left = viewed(options);
  RunOptions of_other = options;
  of_other.file = options.other;
  const Viewed right = viewed(of_other);
  if (options.output.empty()) options.output = left.read.name + "_" + right.read.name + ".html";
  write_output(options.output,
               side_by_side_html({left.recording, left.read.stage}, {right.recording, right.read.stage}));
  say_written(options.output,
              summary_of(left.recording) + "; beside it " + summary_of(right.recording) + "; open it in a browser");
  return 0;
}

int view_file(ViewOptions options) {
  if (!options.output.empty()) require_output(options.output, options.file, std::vector<std::string>{".html"});
  require_amount(options);
  if (!options.other.empty()) return view_both(std::move(options));
  const Viewed shown = viewed(options);
  if (options.output.empty()) options.output = shown.read.name + ".html";
  write_output(options.output, recording_html(shown.recording, shown.read.stage));
  say_written(options.output, summary_of(shown.recording) + "; open it in a browser");
  return 0;
}

Run declare_view(Arguments& arguments) {
  auto options = std::make_shared<ViewOptions>();
  options->details = true;
  options->usual_limit = 128;  // browsers hold the page twice
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.optional_file("OTHER", options->other, "another one, shown beside it by the same clock");
  arguments.output(options->output, "OUT.html", "where to write; FILE's name with .html in this folder without it");
  arguments.text("--clip", "NAME", options->clip, "let this clip play alone");
  declare_amount(arguments, *options);
  return [options] { return view_file(*options); };
}

}  // namespace

const Verb view_verb{"view", "write the moving picture as one HTML page, or two side by side",
                     "tweenfall view swing.json -o swing.html", declare_view};

}  // namespace tweenfall::cli
