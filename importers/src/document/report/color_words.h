#pragma once

// Converts colors in the spelling of other programs to ours.

#include "json/json_tree.h"

#include <string>

namespace tweenfall::document {

// `"; say \"#ff0000\""` for [1, 0, 0], [255, 0, 0], {"r": 1, "g": 0, "b": 0}, 16711680, "red" and "rgb(255, 0, 0)", or
// empty where the meaning is not known.
[[nodiscard]] std::string color_meant(const json::Value& value);
[[nodiscard]] std::string color_meant(std::string_view text);

}  // namespace tweenfall::document
