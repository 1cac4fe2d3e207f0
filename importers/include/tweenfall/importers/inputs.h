#pragma once

/// Timed inputs as a JSON file: commands to a stage while it runs, each at its time.
///
///     {"tweenfall": 1, "inputs": [
///       {"at": 0.5, "start": {"play": "wave", "fade_in": 0.2}},
///       {"at": 1.2, "speed": {"play": "walk", "speed": 1.5, "seconds": 0.3}},
///       {"at": 1.5, "set": {"graph": "figure", "parameter": "speed", "value": 2}},
///       {"at": 1.8, "send": {"graph": "figure", "event": "jump"}},
///       {"at": 2, "push": {"body": "ball", "impulse": [0, 2, 0], "point": [0, 1, 0]}}]}

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/input.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

/// @param stage the stage whose plays, graphs and bodies the inputs name
/// @throws DocumentError with all problems
[[nodiscard]] std::vector<TimedInput> read_inputs(const std::filesystem::path& file, const StageDescription& stage);
/// @param name used for the file in problems
[[nodiscard]] std::vector<TimedInput> parse_inputs(std::string_view text, const std::string& name,
                                                   const StageDescription& stage);

/// The file's text. Read again it gives the same inputs, to the bit.
[[nodiscard]] std::string inputs_json(std::span<const TimedInput> inputs);

}  // namespace tweenfall
