// A document becomes a stage, the stage a recording, the recording a page to look at.

#include <tweenfall/importers/document.h>
#include <tweenfall/importers/recording_file.h>
#include <tweenfall/physics/stage/recording.h>

#include <cstdio>

using namespace tweenfall;

int main() {
  const char* text = R"({
    "tweenfall": 1,
    "nodes": {
      "floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
      "ball":  {"position": [-1, 1, 0], "body": {"shape": {"sphere": {"radius": 0.1}}, "restitution": 0.7}}
    },
    "clips": {"throw": {"tracks": {"ball.position": [[0, [-1, 1, 0], "quad-in"], [0.5, [0, 1.5, 0]]]}}},
    "handoff": [{"body": "ball", "when": {"clip_end": true}, "to": "free"}]
  })";
  try {
    const Document document = Document::parse(text, "throw.json", ".");
    Stage stage(document.stage());
    const Recording recording = record(stage, 3.0, 60);
    save_recording(recording, document.stage(), "throw.html");
    std::printf("throw.html: %zu frames, %zu hand-off, %zu bounces\n", recording.times.size(),
                recording.handoffs.size(), recording.events.size());
    return recording.handoffs.size() == 1 && !recording.events.empty() ? 0 : 1;
  } catch (const DocumentError& error) {
    std::fputs(error.what(), stderr);  // every problem, with its line and column
    return 1;
  }
}
