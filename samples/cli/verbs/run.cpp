// tweenfall run: the stage with physics, as a recording or a summary.

#include "files/output_file.h"
#include "motion/stage_run.h"
#include "report/table.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/inputs.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/importers/shown_text.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::cli {

namespace {

struct RunFileOptions : RunOptions {
  std::optional<std::string> output;
  std::optional<double> threads;
  std::optional<std::string> inputs_file;
  bool json = false;
};

std::string handoffs_table(const Recording& recording) {
  Table table("hand-offs", {">time, s", "body", "from", "to", "cause", "velocity before, m/s", "after, m/s"});
  for (const HandOff& handoff : recording.handoffs)
    table.row({brief_text(handoff.time), recording.nodes[handoff.node].name, owner_word(handoff.from),
               owner_word(handoff.to), cause_word(handoff.cause), brief_text(handoff.before.twist.linear),
               brief_text(handoff.after.twist.linear)});
  if (table.empty()) table.note("none");
  return table.text(styled_output());
}

std::string events_table(const Recording& recording) {
  constexpr std::size_t most = 40;
  Table table("events", {">time, s", "name", "nodes", ">impulse, N s"});
  for (std::size_t i = 0; i < recording.events.size() && i < most; ++i) {
    const StageEvent& event = recording.events[i];
    std::string nodes;
    for (const NodeId node : event.nodes) nodes += (nodes.empty() ? "" : ", ") + recording.nodes[node].name;
    const std::string kind = event.kind == EventKind::begin ? ": begin" : event.kind == EventKind::end ? ": end" : "";
    table.row({brief_text(event.time), event.name + kind, nodes, event.nodes.empty() ? "" : brief_text(event.impulse)});
  }
  if (table.empty()) table.note("none");
  if (recording.events.size() > most)
    table.note("and " + std::to_string(recording.events.size() - most) + " more; --json has them all");
  return table.text(styled_output());
}

std::string ends_table(const Recording& recording, const StageDescription& stage) {
  constexpr std::size_t most = 40;
  Table table("bodies at " + brief_text(recording.times.back()) + " s",
              {"body", "owner", "position, m", ">speed, m/s"});
  std::size_t bodies = 0;
  for (std::size_t i = 0; i < stage.nodes.size(); ++i) {
    if (!stage.nodes[i].body || stage.nodes[i].body->fixed || ++bodies > most) continue;
    const NodeRecord& node = recording.nodes[i];
    table.row({node.name, owner_word(node.owner.back()), brief_text(node.world.back().motion.pose.position),
               brief_text(node.twist.back().linear.norm())});
  }
  if (bodies > most) table.note("and " + std::to_string(bodies - most) + " more; --json has them all");
  return table.empty() ? "" : table.text(styled_output());
}

std::string joints_table(const Recording& recording) {
  constexpr std::size_t most = 40;
  Table table("joints at " + brief_text(recording.times.back()) + " s",
              {"joint", "between", ">force, N", ">torque, N m", "stands at, rad or m"});
  for (std::size_t i = 0; i < recording.joints.size() && i < most; ++i) {
    const JointRecord& joint = recording.joints[i];
    const std::string between =
        (joint.a == no_node ? "the world" : recording.nodes[joint.a].name) + ", " + recording.nodes[joint.b].name;
    const std::optional<JointReading>& reading = joint.reading.back();
    if (!reading) {
      table.row({joint.name, between, "", "", "gone"});
      continue;
    }
    std::string position;
    for (int k = 0; k < reading->coordinates; ++k)
      position += (k > 0 ? ", " : "") + brief_text(reading->position[static_cast<std::size_t>(k)]);
    table.row({joint.name, between, brief_text(reading->force.norm()), brief_text(reading->torque.norm()), position});
  }
  if (recording.joints.size() > most)
    table.note("and " + std::to_string(recording.joints.size() - most) + " more; --json has them all");
  return table.empty() ? "" : table.text(styled_output());
}

std::string complementarity_line(const Recording& recording) {
  if (recording.complementarity.empty()) return "";
  return "\ncomplementarity of contacts: residual of at most " + number_text(recording.complementarity.back()) +
         " m/s\n";
}

/// Says how many particles a .glb leaves out.
void say_thinned(const Recording& recording) {
  for (const ParticlesRecord& particles : recording.particles) {
    std::size_t most = 0;
    for (const StageParticles& there : particles.frame) most = std::max(most, there.numbers.size());
    if (most > most_particles_in_glb)
      say("of the particles \"" + terminal_text(particles.name) + "\", " + std::to_string(most) +
          " at a time, the .glb shows " + std::to_string(most_particles_in_glb) + " at most");
  }
}

int run_file(const RunFileOptions& options) {
  const std::vector<std::string> endings{".json", ".csv", ".svg", ".html", ".glb"};
  if (options.output) require_output(*options.output, options.file, endings);
  require_amount(options);
  if (options.threads &&
      !(*options.threads >= 1 && *options.threads <= 256 && std::floor(*options.threads) == *options.threads))
    throw UsageError("--threads must be a whole number from 1 to 256, not " + brief_text(*options.threads));
  StageFile read = read_stage_file(options.file);
  choose_play(read, options.clip, options.file);
  if (options.threads) read.stage.world.threads = static_cast<int>(*options.threads);
  RunOptions run = options;
  if (options.inputs_file) run.inputs = read_inputs(*options.inputs_file, read.stage);
  run.details = options.output && options.output->size() > 5 && options.output->ends_with(".html");
  const Recording recording = run_stage(read.stage, run);
  const bool to_stdout = options.json || options.output == "-";
  if (options.output && *options.output != "-") {
    save_recording(recording, read.stage, *options.output);
    say_written(*options.output, summary_of(recording), options.json);
    if (options.output->ends_with(".glb")) say_thinned(recording);
  }
  if (to_stdout) {
    print(recording_json(recording));
  } else if (!options.output) {
    print(terminal_text(read.stage.name + ": " + summary_of(recording)) + "\n" + handoffs_table(recording) +
          events_table(recording) + ends_table(recording, read.stage) + joints_table(recording) +
          complementarity_line(recording));
  }
  return 0;
}

Run declare_run(Arguments& arguments) {
  auto options = std::make_shared<RunFileOptions>();
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.text("--clip", "NAME", options->clip, "let this clip play alone");
  declare_amount(arguments, *options);
  arguments.text("-o,--output", "OUT", options->output,
                 "the recording: .json .csv .svg .html or .glb; - prints the JSON; without it a summary");
  arguments.text("--inputs", "FILE", options->inputs_file,
                 "JSON file of timed inputs to plays, graphs, vehicles and bodies");
  arguments.number("--threads", "N", options->threads,
                   "threads that share a step of physics; the recording is the same with any number");
  arguments.flag("--json", options->json, "print the recording as JSON");
  return [options] { return run_file(*options); };
}

}  // namespace

const Verb run_verb{"run", "advance the stage with physics: a summary, or a recording as .json .csv .svg .html .glb",
                    "tweenfall run swing.json --until 3 -o swing.glb", declare_run};

}  // namespace tweenfall::cli
