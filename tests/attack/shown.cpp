#include "attack/shown.h"

#include "attack/written.h"

#include <tweenfall/importers/plot.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace tweenfall::attack {

std::string fault_of_run(const StageDescription& description, double seconds) {
  Recording recording;
  try {
    Stage stage(description);
    recording = record(stage, std::min(seconds, natural_length(description)), 30);
  } catch (const NodeNotFinite& fault) {
    // Said with node, time and cause: what a run may end with.
    return fault.cause.empty() || !is_utf8(fault.what()) ? "a run ends without a cause" : "";
  } catch (const std::invalid_argument& error) {
    // More than a recording may hold is no fault of the stage.
    if (std::string_view(error.what()).find("are allowed: end it earlier") != std::string_view::npos) return {};
    throw;
  }
  if (const std::string fault = fault_of_json(recording_json(recording)); !fault.empty()) {
    return "the recording: " + fault;
  }
  if (const std::string fault = fault_of_text(recording_csv(recording)); !fault.empty()) return "the table: " + fault;
  const std::pair<const char*, std::string> pictures[] = {
      {"the moving picture: ", written([&] { return recording_svg(recording, description); })},
      {"the plot: ", written([&] { return plot_svg(description, &recording); })},
      {"the page: ", written([&] { return recording_html(recording, description); }, false)}};
  for (const auto& [name, fault] : pictures) {
    if (!fault.empty()) return name + fault;
  }
  return {};
}

}  // namespace tweenfall::attack
