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
};

int view_file(ViewOptions options) {
  if (!options.output.empty()) require_output(options.output, options.file, std::vector<std::string>{".html"});
  require_amount(options);
  StageFile read = read_stage_file(options.file);
  if (options.output.empty()) options.output = read.name + ".html";
  choose_play(read, options.clip, options.file);
  const Recording recording = run_stage(read.stage, options);
  write_output(options.output, recording_html(recording, read.stage));
  const std::size_t frames = recording.times.size(), carried = page_frame_count(recording);
  if (carried < frames)
    say(options.file + ": note: too much for one page: of " + counted(frames, "frame") + " it carries " +
        std::to_string(carried) + ", with smooth motion between them; for all of them a shorter --until");
  say_written(options.output, summary_of(recording) + "; open it in a browser");
  return 0;
}

Run declare_view(Arguments& arguments) {
  auto options = std::make_shared<ViewOptions>();
  options->details = true;
  options->usual_limit = 128;  // browsers hold the page twice
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.output(options->output, "OUT.html", "where to write; FILE's name with .html in this folder without it");
  arguments.text("--clip", "NAME", options->clip, "let this clip play alone");
  declare_amount(arguments, *options);
  return [options] { return view_file(*options); };
}

}  // namespace

const Verb view_verb{"view", "write the moving picture as one HTML page", "tweenfall view swing.json -o swing.html",
                     declare_view};

}  // namespace tweenfall::cli
