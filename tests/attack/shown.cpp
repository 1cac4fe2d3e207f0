#include "attack/shown.h"

#include "attack/written.h"

#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace tweenfall::attack {

namespace {

/// All words that a picture or a table may show: names may be anything, including words for numbers such as nan.
std::string names_in(const StageDescription& stage) {
  std::string names = stage.name;
  for (const NodeDescription& node : stage.nodes) names += "\n" + node.name;
  for (const JointDescription& joint : stage.joints) names += "\n" + joint.name;
  for (const Clip& clip : stage.clips) {
    names += "\n" + clip.name;
    for (const Track& track : clip.tracks) names += "\n" + track.name();
    for (const ClipEvent& event : clip.events) names += "\n" + event.name;
  }
  return names;
}

/// A step of very many nodes of springs may take a second, and many times that under sanitizers.
bool takes_seconds(const StageDescription& description) {
  constexpr std::size_t many_nodes = 2000;
  return std::ranges::any_of(description.softs, [](const SoftDescription& soft) {
    return soft.soft.solver == SoftSolver::springs && soft.soft.positions.size() > many_nodes;
  });
}

}  // namespace

std::string fault_of_run(const StageDescription& description, double seconds, std::span<const TimedInput> inputs) {
  Recording recording;
  try {
    Stage stage(description);
    if (takes_seconds(description)) return {};
    const double until = inputs.empty() ? std::min(seconds, natural_length(description)) : seconds;
    recording = record(stage, until, 30, 1e9, false, inputs);
  } catch (const NodeNotFinite& fault) {
    // A run may end with this if it names node, time and cause.
    return fault.cause.empty() || !is_utf8(fault.what()) ? "a run ends without a cause" : "";
  } catch (const std::invalid_argument& error) {
    // A recording that would be too large is not the stage's fault.
    if (std::string_view(error.what()).find("are allowed: end it earlier") != std::string_view::npos) return {};
    if (!inputs.empty()) return is_utf8(error.what()) ? "" : "an input is refused in what is not UTF-8";
    throw;
  }
  if (const std::string fault = fault_of_json(recording_json(recording)); !fault.empty()) {
    return "the recording: " + fault;
  }
  const std::string names = names_in(description);
  const auto numbers = [&](const std::string& text) { return fault_of_text(text, names); };
  const auto letters = [](const std::string& text) { return std::string(is_utf8(text) ? "" : "not UTF-8"); };
  const std::pair<const char*, std::string> pictures[] = {
      {"the table: ", numbers(recording_csv(recording))},
      {"the moving picture: ", written([&] { return recording_svg(recording, description); }, numbers)},
      {"the plot: ", written([&] { return plot_svg(description, &recording); }, numbers)},
      {"the page: ", written([&] { return recording_html(recording, description); }, letters)}};
  for (const auto& [name, fault] : pictures) {
    if (!fault.empty()) return name + fault;
  }
  return {};
}

}  // namespace tweenfall::attack
