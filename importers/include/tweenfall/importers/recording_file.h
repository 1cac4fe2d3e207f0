#pragma once

/// Recordings as files: JSON, CSV, SVG, HTML and glTF, chosen by the name's ending.

#include <tweenfall/physics/stage/recording.h>

#include <filesystem>
#include <string>

namespace tweenfall {

[[nodiscard]] std::string recording_json(const Recording& recording);
[[nodiscard]] std::string recording_csv(const Recording& recording);

/// A moving picture of the recording as animated SVG, seen from the side.
[[nodiscard]] std::string recording_svg(const Recording& recording, const StageDescription& stage);

/// One self-contained page: 3-D view, play, scrub, step back, timeline with key lanes, curves of the chosen node,
/// owners in color.
[[nodiscard]] std::string recording_html(const Recording& recording, const StageDescription& stage);

/// By the ending of `file`: .json, .csv, .svg, .html or .glb. Written whole or not at all.
/// @throws std::invalid_argument for another ending, std::runtime_error when it cannot be written.
void save_recording(const Recording& recording, const StageDescription& stage, const std::filesystem::path& file);

}  // namespace tweenfall
