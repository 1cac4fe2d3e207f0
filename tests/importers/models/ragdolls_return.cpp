// The sample character falls as a ragdoll and settles back to its walk, in one piece.

#include "support.h"

#include <tweenfall/importers/document.h>
#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double comes_back = 2.5;

StageDescription falling(const std::string& anchor, const std::string& settle) {
  const std::string text = R"({"tweenfall": 1, "import": {"figure": "character.glb"},
    "nodes": {"floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}}},
    "play": [{"clip": "figure/WalkForward", "loop": "repeat"}], "world": {"ragdolls": {"figure": {"mass": 60}}},
    "handoff": [{"body": "figure/*", "when": {"at": 0.7}, "to": "free"},
                {"body": "figure/*", "when": {"at": 2.5}, "to": "keyed",
                 "path": {"anchor": ")" +
                           anchor + R"("}, "settle": )" + settle + "}]}";
  return Document::parse(text, "falling.json", std::filesystem::path(TWEENFALL_SOURCE_DIR) / "samples/documents")
      .stage();
}

double bone(const Stage& stage, const JointDescription& joint) {
  return (stage.world(joint.a).motion.pose.position - stage.world(joint.b).motion.pose.position).norm();
}

}  // namespace

TEST_CASE("a ragdoll keeps the lengths of its bones while it settles back to its clip") {
  for (const std::string anchor : {"keep", "here", "ground"})
    for (const std::string settle : {R"({"quintic": 0.6})", R"({"half_life": 0.1})", R"({"dead_blend": 0.6})"}) {
      CAPTURE(anchor);
      CAPTURE(settle);
      const StageDescription description = falling(anchor, settle);
      REQUIRE(description.joints.size() >= 10);
      Stage stage(description);
      std::vector<double> lengths;
      for (const JointDescription& joint : description.joints) lengths.push_back(bone(stage, joint));
      stage.advance_to(comes_back - 1e-9);
      std::vector<Motion> before(stage.nodes().size());
      for (NodeId node = 0; node < before.size(); ++node) before[node] = stage.world(node).motion;
      double worst = 0, farthest = 0, jump = 0;
      for (int frame = 0; frame <= 90; ++frame) {
        stage.advance_to(comes_back + frame / 60.0);
        for (std::size_t i = 0; i < lengths.size(); ++i)
          worst = std::max(worst, std::abs(bone(stage, description.joints[i]) - lengths[i]));
        if (frame > 0) continue;
        for (const JointDescription& joint : description.joints) {
          const Motion now = stage.world(joint.b).motion;
          jump = std::max(jump, (now.pose.position - before[joint.b].pose.position).norm());
          farthest = std::max(
              farthest,
              (now.pose.position - stage.path(joint.b).animation().world(joint.b, comes_back).motion.pose.position)
                  .norm());
        }
      }
      if (anchor == "keep" && settle.find("half_life") == std::string::npos)
        for (const JointDescription& joint : description.joints) {
          const Motion shown = stage.world(joint.b).motion;
          const Motion wanted = stage.path(joint.b).animation().world(joint.b, stage.time()).motion;
          CHECK(near(shown.pose.position, wanted.pose.position, 1e-9));
          CHECK(near(shown.pose.rotation, wanted.pose.rotation, 1e-9));
          CHECK(near(shown.twist.linear, wanted.twist.linear, 1e-9));
        }
      MESSAGE(anchor, ", ", settle, ": bones change by at most ", 1e3 * worst, " mm");
      CHECK(farthest > 0.3);
      CHECK(jump < 1e-6);
      CHECK(worst < 1e-3);
    }
}
