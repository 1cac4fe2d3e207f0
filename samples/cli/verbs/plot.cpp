// tweenfall plot: curves as SVG, including the motion that physics made of them.

#include "files/output_file.h"
#include "motion/clip_sampling.h"
#include "motion/stage_run.h"
#include "report/counted.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/graph_plot.h>
#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/portrait_plot.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::cli {

namespace {

struct PlotFileOptions : RunOptions {
  std::string output;
  std::vector<std::string> tracks;
  std::optional<double> columns;
  bool no_rates = false, graph = false, portrait = false;
};

constexpr int most_columns = 6;

/// The clips that a plot shows: the one asked for, or the only one, or all that play.
std::vector<std::size_t> shown_clips(const StageDescription& stage, const PlotFileOptions& options) {
  if (stage.clips.empty() && !options.clip) return {};
  if (options.clip || stage.clips.size() < 2 || stage.plays.empty())
    return {choose_clip(stage, options.clip, options.file)};
  std::vector<std::size_t> clips;
  for (const Play& play : stage.plays)
    if (std::find(clips.begin(), clips.end(), play.clip) == clips.end()) clips.push_back(play.clip);
  return clips;
}

/// Resolves patterns to names, so that an empty plot is refused here.
std::vector<std::string> chosen_tracks(const StageDescription& stage, const std::vector<std::size_t>& clips,
                                       const std::vector<std::string>& patterns) {
  std::vector<std::string> names;
  std::optional<UsageError> unknown;
  for (const std::string& pattern : patterns) {
    bool found = false;
    for (const std::size_t clip : clips) {
      try {
        for (const std::size_t track : choose_tracks(stage.clips[clip], {pattern})) {
          const std::string name = stage.clips[clip].tracks[track].name();
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
        found = true;
      } catch (const UsageError& error) {
        unknown = error;
      }
    }
    if (!found) throw *unknown;
  }
  return names;
}

int plot_graphs(const PlotFileOptions& options) {
  const StageFile read = read_stage_file(options.file);
  if (read.stage.graphs.empty()) throw UsageError(options.file + " has no graph to draw");
  write_output(options.output, graph_svg(read.stage.graphs));
  std::string names;
  for (const GraphDescription& graph : read.stage.graphs) names += (names.empty() ? "" : ", ") + graph.name;
  say_written(options.output, counted(read.stage.graphs.size(), "graph") + ": " + names);
  return 0;
}

int plot_portraits(const PlotFileOptions& options) {
  const StageFile read = read_stage_file(options.file);
  if (!read.document || read.document->systems().empty())
    throw UsageError(options.file + " has no system to draw a portrait of");
  write_output(options.output, portrait_svg(read.document->systems()));
  std::string names;
  for (const ExpressionSystem& system : read.document->systems()) names += (names.empty() ? "" : ", ") + system.name;
  say_written(options.output, counted(read.document->systems().size(), "portrait") + ": " + names);
  return 0;
}

int plot_file(const PlotFileOptions& options) {
  if (options.graph) return plot_graphs(options);
  if (options.portrait) return plot_portraits(options);
  require_amount(options);
  require_output(options.output, options.file, std::vector<std::string>{".svg"});
  const double columns = options.columns.value_or(1);
  if (!(columns >= 1 && columns <= most_columns && columns == std::floor(columns)))
    throw UsageError("--columns takes a whole number from 1 to " + std::to_string(most_columns) + ", not " +
                     brief_text(columns));
  const StageFile read = read_stage_file(options.file);
  const StageDescription& stage = read.stage;
  const std::vector<std::size_t> clips = shown_clips(stage, options);
  const PlotOptions plotted{.tracks = chosen_tracks(stage, clips, options.tracks),
                            .clip = options.clip.value_or(""),
                            .columns = static_cast<int>(columns),
                            .rates = !options.no_rates};

  // Only a clip that plays on a stage with bodies has a simulated continuation.
  const bool has_bodies =
      std::any_of(stage.nodes.begin(), stage.nodes.end(), [](const auto& node) { return !!node.body; });
  const bool plays = std::any_of(stage.plays.begin(), stage.plays.end(), [&](const Play& play) {
    return std::find(clips.begin(), clips.end(), play.clip) != clips.end();
  });
  // What several plays or graphs mix of user tracks is shown over the curves.
  const bool mixes = !stage.graphs.empty() || (plays && stage.plays.size() > 1);
  const auto is_user_track = [&](const Track& track) {
    const auto& names = plotted.tracks;
    return property_named(track.property) == Property::user &&
           (names.empty() || std::find(names.begin(), names.end(), track.name()) != names.end());
  };
  const bool has_mixed =
      mixes && std::any_of(clips.begin(), clips.end(), [&](std::size_t clip) {
        return std::any_of(stage.clips[clip].tracks.begin(), stage.clips[clip].tracks.end(), is_user_track);
      });
  std::optional<Recording> recording;
  if ((has_bodies && plays) || has_mixed) {
    // Particles move nothing that is plotted.
    StageDescription shown = stage;
    shown.particles.clear();
    recording = run_stage(shown, options);
  }

  write_output(options.output, plot_svg(stage, recording ? &*recording : nullptr, plotted));
  std::size_t tracks = plotted.tracks.size();
  std::string names;
  for (const std::size_t clip : clips) {
    if (plotted.tracks.empty()) tracks += stage.clips[clip].tracks.size();
    names += (names.empty() ? "" : ", ") + stage.clips[clip].name;
  }
  const bool is_cut = plotted.tracks.empty() && tracks > plotted.most;
  if (clips.empty()) names = "no clip";
  std::string shows = (is_cut ? std::to_string(plotted.most) + " of " : "") + counted(tracks, "track") + " of " +
                      names + ": values with keys and handles" + (plotted.rates ? ", rates below" : "");
  if (is_cut) shows += "; name others with --track";
  if (recording && !recording->handoffs.empty())
    shows += "; " + counted(recording->handoffs.size(), "hand-off") + " and the simulated motion after";
  say_written(options.output, shows);
  return 0;
}

Run declare_plot(Arguments& arguments) {
  auto options = std::make_shared<PlotFileOptions>();
  options->output = "-";
  options->usual_fps = 120;
  arguments.file("FILE", options->file, "a document or a model; - is a document on standard input");
  arguments.output(options->output, "OUT.svg", "where to write; standard output without it");
  arguments.texts("--track", "NAME", options->tracks,
                  "only this track, or those of a pattern like \"arm.*\"; may be repeated");
  arguments.text("--clip", "NAME", options->clip, "this clip; else the only one, or all that play");
  arguments.number("--until", "T", options->until, "simulate to stage time T, s");
  arguments.number("--columns", "N", options->columns, "plots side by side, 1 to 6; 1 without it");
  arguments.flag("--graph", options->graph,
                 "draw the graphs instead: how poses are made, and machines with their states");
  arguments.flag("--portrait", options->portrait,
                 "draw phase portraits of the systems instead, with directions and energy");
  arguments.flag("--no-rates", options->no_rates, "only values, without their rates below");
  return [options] { return plot_file(*options); };
}

}  // namespace

const Verb plot_verb{"plot", "draw curves with keys, tangents, rates, events and hand-offs as SVG",
                     "tweenfall plot swing.json -o swing.svg", declare_plot};

}  // namespace tweenfall::cli
