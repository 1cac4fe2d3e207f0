#include "motion/clip_sampling.h"

#include "line/arguments.h"
#include "report/did_you_mean.h"
#include "report/json_text.h"

#include <algorithm>
#include <limits>
#include <set>

namespace tweenfall::cli {

const char* kind_of(const TrackCurve& curve) noexcept {
  constexpr const char* kinds[] = {"number",   "vector",  "vector", "vector", "color",
                                   "rotation", "weights", "switch", "text"};
  static_assert(std::size(kinds) == std::variant_size_v<TrackCurve>);
  return kinds[curve.index()];
}

std::vector<std::size_t> choose_tracks(const Clip& clip, const std::vector<std::string>& patterns) {
  std::set<std::size_t> chosen;
  std::vector<std::string> names;
  for (const Track& track : clip.tracks) names.push_back(track.name());
  for (std::size_t i = 0; i < names.size() && patterns.empty(); ++i) chosen.insert(i);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != pattern && !matches(pattern, names[i])) continue;
      chosen.insert(i);
      any = true;
    }
    if (!any)
      throw UsageError("clip \"" + clip.name + "\" has no track \"" + pattern + "\"" + did_you_mean(pattern, names));
  }
  return {chosen.begin(), chosen.end()};
}

TrackSample sample_track(const Clip& clip, const Track& track, double time) {
  const double plays = clip.loop.mode == LoopMode::once ? 1 : clip.loop.count;
  const Side side = plays > 0 && time == plays * clip.duration ? Side::in : Side::out;
  if (clip.loop.mode == LoopMode::once)
    return sample_track(clip, track, ClipClock{.time = time, .rate = 1, .side = side});
  return sample_track(clip, track, clock_at(Play{}, clip, time, side));
}

std::string value_json(const TrackCurve& curve, const TrackSample& sample) {
  if (std::holds_alternative<StepCurve<std::string>>(curve)) return json_string(sample.text);
  if (std::holds_alternative<StepCurve<bool>>(curve)) return sample.value[0] != 0 ? "true" : "false";
  if (std::holds_alternative<Curve<double>>(curve)) return json_number(sample.value[0]);
  return json_array(sample.value);
}

std::string rate_json(const TrackCurve& curve, const TrackSample& sample) {
  return std::holds_alternative<Curve<double>>(curve) ? json_number(sample.rate[0]) : json_array(sample.rate);
}

std::vector<WorldMotion> sample_world(const Animation& animation, double time) {
  const std::size_t count = animation.nodes().size();
  std::vector<Motion> local(count);
  std::vector<WorldMotion> world(count);
  animation.sample(time, local);
  animation.nodes().world_motions(local, world);
  return world;
}

Animation animation_of(const StageDescription& stage, std::size_t clip) {
  auto nodes = std::make_shared<Hierarchy>();
  for (const NodeDescription& node : stage.nodes) nodes->add({node.name, node.parent, node.rest});
  Clip played = stage.clips[clip];
  // Without a loop nothing stops the clock, so that curves continue by the rules of their tracks.
  if (played.loop.mode == LoopMode::once) played.duration = std::numeric_limits<double>::infinity();
  return {std::move(nodes), {std::move(played)}, {Play{}}};
}

}  // namespace tweenfall::cli
