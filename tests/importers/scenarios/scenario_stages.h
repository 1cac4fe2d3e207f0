#pragma once

// What the scenarios of the hand-off share: documents made of parts, and queries to a stage.

#include "importers/document/document_files.h"

#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <string>

namespace tweenfall::scenarios {

using namespace tweenfall::test;

inline constexpr double g = 9.81;

inline StageDescription described(const std::string& nodes, const std::string& clips, const std::string& rest) {
  return parsed("{\"tweenfall\": 1, \"nodes\": {" + nodes + "}" +
                (clips.empty() ? "" : ", \"clips\": {" + clips + "}") + (rest.empty() ? "" : ", " + rest) + "}")
      .stage();
}

inline std::string in_text(double value) {
  std::string text = std::to_string(value);
  return text;
}

inline Vec3 place(const Stage& stage, const std::string& node) {
  return stage.world(stage.node(node)).motion.pose.position;
}
inline Vec3 velocity(const Stage& stage, const std::string& node) {
  return stage.twist(stage.node(node)).linear;
}

inline std::size_t count_of(const Stage& stage, const std::string& event) {
  return static_cast<std::size_t>(std::ranges::count(stage.events(), event, &StageEvent::name));
}

inline const std::string floor_node =
    R"("floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}})";

}  // namespace tweenfall::scenarios
