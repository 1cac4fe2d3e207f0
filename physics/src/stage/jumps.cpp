#include "stage/stage_data.h"

#include <tweenfall/curves/rotation.h>

#include <cmath>

namespace tweenfall {

namespace {

bool differ(const Vec3& a, const Vec3& b) {
  return (a - b).squaredNorm() > 1e-18 * (1 + a.squaredNorm());
}
bool differ(const Quat& a, const Quat& b) {
  return (hemisphere_aligned(a, b).coeffs() - b.coeffs()).squaredNorm() > 1e-18;
}

/// Clip times at which a curve is not continuous; 0 stands for the seam of a loop.
template <class T>
void collect(const Curve<T>& curve, const Clip& clip, bool accumulates, std::vector<ClipEvent>& jumps) {
  const auto add = [&](double time) { jumps.push_back({.from = time, .to = time, .name = {}, .data = {}}); };
  for (const double knot : curve.knots())
    if (knot > 0 && knot < clip.duration && differ(curve.value(knot, Side::in), curve.value(knot, Side::out)))
      add(knot);
  // A track that repeats within its clip jumps at each of its own seams.
  const double length = curve.duration();
  if (std::isfinite(length) && length > 0 && differ(curve.value(curve.end(), Side::in), curve.value(curve.start()))) {
    constexpr int most = 1000;
    const auto plays = [](const auto& rule, int k) {
      return rule.rule == Outside::repeat && k < most && (rule.plays == 0 || k < rule.plays);
    };
    for (int k = 0; plays(curve.rule_after(), k) && curve.end() + k * length < clip.duration; ++k)
      add(curve.end() + k * length);
    for (int k = 0; plays(curve.rule_before(), k) && curve.start() - k * length > 0; ++k)
      add(curve.start() - k * length);
  }
  const bool wraps = clip.loop.mode == LoopMode::repeat || (clip.loop.mode == LoopMode::repeat_offset && !accumulates);
  if (wraps && std::isfinite(clip.duration) &&
      differ(curve.value(clip.duration, Side::in), curve.value(0.0, Side::out)))
    add(0);
}

/// A clip without tracks whose events are the jumps of the given one.
Clip jumps_of(const Clip& clip) {
  Clip shadow;
  shadow.duration = clip.duration;
  shadow.loop = clip.loop;
  for (const Track& track : clip.tracks) {
    const Property property = property_named(track.property);
    if (property == Property::position) {
      if (const auto* curve = std::get_if<Curve<Vec3>>(&track.curve)) collect(*curve, clip, true, shadow.events);
    } else if (property == Property::rotation) {
      if (const auto* curve = std::get_if<Curve<Quat>>(&track.curve)) collect(*curve, clip, true, shadow.events);
    } else if (property == Property::scale) {
      // A parent's scale moves its children.
      if (const auto* curve = std::get_if<Curve<Vec3>>(&track.curve)) collect(*curve, clip, false, shadow.events);
    }
  }
  return shadow;
}

}  // namespace

std::shared_ptr<const std::vector<Clip>> clip_jumps(std::span<const Clip> clips) {
  auto jumps = std::make_shared<std::vector<Clip>>();
  for (const Clip& clip : clips) jumps->push_back(jumps_of(clip));
  return jumps;
}

double next_jump(const StageState& state, const Animation& animation, double from, double to) {
  double first = infinity;
  for (const Play& play : animation.plays()) {
    // Where a play begins it may replace what was below it.
    if (play.at > from && play.at <= to) first = std::min(first, play.at);
    for (const double knot : play.weight.knots())
      if (knot > from && knot <= to && play.weight.value(knot, Side::in) != play.weight.value(knot))
        first = std::min(first, knot);
    const std::vector<FiredEvent> jumps = events_between(play, (*state.jumps)[play.clip], from, to);
    if (!jumps.empty()) first = std::min(first, jumps.front().time);
  }
  return first;
}

}  // namespace tweenfall
