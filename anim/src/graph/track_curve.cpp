#include <tweenfall/anim/component.h>
#include <tweenfall/anim/graph.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/nearest_name.h>

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace graphs {
namespace {

bool is_number_of_users(const Track& track) {
  const bool number = std::holds_alternative<Curve<double>>(track.curve);
  return (number || std::holds_alternative<StepCurve<bool>>(track.curve)) &&
         property_named(track.property) == Property::user && !component_named(track.property);
}

Curve<double> numbers_of(const Track& track) {
  if (const auto* curve = std::get_if<Curve<double>>(&track.curve)) return *curve;
  std::vector<Key<double>> keys;
  for (const auto& [time, on] : std::get<StepCurve<bool>>(track.curve).steps())
    keys.push_back({.time = time, .value = on ? 1. : 0., .ease = Ease::hold()});
  return keyed_curve<double>(keys);
}

/// The curve as the clip plays it, from 0 on.
Curve<double> played(const Curve<double>& curve, const Clip& clip) {
  if (!std::isfinite(clip.duration) || !(clip.duration > 0)) return curve;
  const Loop& loop = clip.loop;
  const bool once = loop.mode == LoopMode::once || loop.count == 1;
  const double end = clip.duration * (loop.count > 0 && loop.count < 1 && !once ? loop.count : 1);
  const Curve<double> round = trimmed(curve, 0, end);
  if (once || (loop.count > 0 && loop.count < 1)) return round;
  const OutsideRule<double> after{.rule = loop.mode == LoopMode::pingpong ? Outside::pingpong : Outside::repeat,
                                  .plays = loop.count > 0 ? loop.count - 1 : 0};
  return round.with_outside({}, after);
}

}  // namespace
}  // namespace graphs

Curve<double> track_curve(std::span<const Clip> clips, std::string_view track, std::string_view clip) {
  const Clip* found = nullptr;
  const Track* numbers = nullptr;
  std::vector<std::string> names;
  bool clip_known = clip.empty(), other_kind = false;
  for (const Clip& each : clips) {
    if (!clip.empty() && each.name != clip) continue;
    clip_known = true;
    for (const Track& own : each.tracks) {
      if (graphs::is_number_of_users(own)) names.push_back(own.name());
      if (own.name() != track) continue;
      if (!graphs::is_number_of_users(own)) {
        other_kind = true;
        continue;
      }
      if (numbers)
        throw std::invalid_argument("the clips \"" + found->name + "\" and \"" + each.name + "\" both have a track \"" +
                                    std::string(track) + "\"; say which \"clip\" is meant");
      found = &each;
      numbers = &own;
    }
  }
  if (numbers) return graphs::played(graphs::numbers_of(*numbers), *found);
  if (!clip_known) {
    std::vector<std::string> all;
    for (const Clip& each : clips) all.push_back(each.name);
    const std::string nearest = nearest_name(clip, all);
    throw std::invalid_argument("there is no clip \"" + std::string(clip) + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  if (other_kind)
    throw std::invalid_argument("a parameter follows a track of the user's own, of numbers or a switch; \"" +
                                std::string(track) + "\" is another");
  const std::string nearest = nearest_name(track, names);
  throw std::invalid_argument("there is no track of numbers \"" + std::string(track) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace tweenfall
