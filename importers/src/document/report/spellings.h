#pragma once

// Suggestions for values in the spelling of other programs and formats: what to write instead.

#include "json/json_tree.h"

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// All of these return `"; say ..."`, or empty where the meaning is not known.

// "1.5", "90deg"
// @param unit  what the number is in, or empty where that is not known
[[nodiscard]] std::string number_meant(std::string_view text, std::string_view unit);
[[nodiscard]] std::string step_meant(std::string_view text);                             // "4ms", "240hz"
[[nodiscard]] std::string member_said(std::string_view name, const json::Value& value);  // {"name": value}
[[nodiscard]] std::string list_of_equal(const json::Value& value);                       // 2, where three are needed
[[nodiscard]] std::string gravity_meant(const json::Value& value);                       // -9.81
[[nodiscard]] std::string loop_meant(const json::Value& value);                          // true, 3, -1
[[nodiscard]] std::string vector_meant(const json::Value& value);                        // {"x": 0, "y": 1, "z": 0}
[[nodiscard]] std::string time_meant(std::string_view text, bool share_of_duration);     // "500ms", "2s", "from"
// @param kind  the field by which rotations are spelled: "euler", "quat" or "angle"
[[nodiscard]] std::string rotation_meant(const json::Value& value, std::string_view kind);  // [0, 90, 0]
[[nodiscard]] std::string key_meant(const json::Value& value);                              // [0, 1, 2, 3]
[[nodiscard]] std::string event_meant(const json::Value& value);   // {"time": 1, "name": "bang"}
[[nodiscard]] std::string member_meant(const json::Value& value);  // [{"name": "ball", ...}], of what has names
// Of what says its kind by one of these fields: "sphere", {"type": "sphere", "radius": 1}
[[nodiscard]] std::string kind_meant(const json::Value& value, const std::vector<std::string>& kinds,
                                     const std::vector<std::string>& beside = {});
[[nodiscard]] std::string comparison_meant(const json::Value& value);  // "speed > 0.1"
// For a rotation {"x": 0, "y": 90, "z": 0}: the whole message, or empty
[[nodiscard]] std::string angles_meant(const json::Value& value);

}  // namespace tweenfall::document
