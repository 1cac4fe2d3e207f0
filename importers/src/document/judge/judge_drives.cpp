#include <tweenfall/curves/number_text.h>

#include "document/judge/judge.h"

#include <algorithm>
#include <optional>

namespace tweenfall::document::judging {

namespace {

/// The body that a track drives, or null where nothing can drive it.
const BodyDescription* driven_body(const StageDescription& stage, const std::string& name) {
  const auto node = std::ranges::find(stage.nodes, name, &NodeDescription::name);
  return node != stage.nodes.end() && node->body && !node->body->fixed ? &*node->body : nullptr;
}

/// The first negative number among the keys, with its time.
std::optional<std::pair<double, double>> first_negative(const Curve<double>& curve) {
  for (const double time : curve.knots())
    for (const Side side : {Side::in, Side::out})
      if (const double value = curve.value(time, side); value < 0) return std::pair(time, value);
  return std::nullopt;
}

}  // namespace

void judge_drives(Building& building) {
  for (const Clip& clip : building.stage.clips)
    for (const Track& track : clip.tracks) {
      if (track.property != "drive_hz") continue;
      const auto* curve = std::get_if<Curve<double>>(&track.curve);
      if (!curve) continue;
      if (!driven_body(building.stage, track.node)) {
        building.problems.add(
            place_of_track(building, clip, track),
            json::in_quotes(track.node) + " has no body that could be driven; it needs one that is " + "not static");
      } else if (const auto negative = first_negative(*curve)) {
        building.problems.add(place_of_track(building, clip, track),
                              "the frequency of a drive is 0 for free, or more; at " + brief_text(negative->first) +
                                  " s it is " + brief_text(negative->second) + " Hz");
      }
    }
}

}  // namespace tweenfall::document::judging
